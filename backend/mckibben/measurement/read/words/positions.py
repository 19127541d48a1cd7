"""Words on the position of a sensor, a stage, a crosshead, folded, parted by blanks."""

from __future__ import annotations

#: What has or shows a position.
POSITION = (
    "position laser reading reads read shows showed "
    "indicates sensor encoder stage carriage crosshead traverse "
    "slide slider ruler lvdt probe coordinate traversenposition stellung "
    "zeigt anzeige schlitten abstand distance ablesung ablesewert "
    "wegsensor seilzug lineal nullpunkt lecture indique "
    "capteur chariot posizione lettura legge segna slitta "
    "sensore posicion lectura marca indica carro posicao "
    "leitura pozycja odczyt czujnik poloha odectet положение датчик показание konum okuma positie avlast "
    "asento lukema laserabstand lasersensor"
)
#: What may name one as well.
POSITION_TOO = "pos actuator scale zero reference lage stand"
#: The number becomes larger.
GROWS = (
    "grows grow growing increases increase increasing rises rise "
    "rising larger up steigt wachst zunehmend zunimmt "
    "grosser augmente croit augmentant aumenta cresce crescente "
    "creciente crece rosnie roste возрастает растет artar "
    "neemt_toe stijgt okar stiger kasvaa positive positiv"
)
#: The number becomes smaller.
FALLS = (
    "falls fall falling decreases decrease decreasing drops "
    "smaller down sinkt fallt abnehmend abnimmt kleiner "
    "diminue diminuant decroit diminuisce cala decrescente disminuye decrece diminui decresce maleje klesa "
    "убывает уменьшается azalir daalt minskar sjunker falder laskee vahenee negative negativ"
)
#: The length between the ends that hold a muscle.
SEPARATION = "separation einspannlange klemmenabstand mordazas"
#: The reading is nothing.
ZERO = "zero null nul nulle nullpunkt cero nulo nulla nullo noll nolla nula ноль нуле нулевой sifir 零"
#: The muscle becomes shorter.
SHORTENS = (
    "shortens shorten shortening contracts contract contracting contraction verkurzt zusammenzieht kurzer "
    "inflates inflated"
)
#: What a wire from the muscle turns.
PULLEY = (
    "pulley pulleys drum wheel sheave spool capstan rolle seilrolle seilscheibe scheibe trommel umlenkrolle "
    "poulie tambour puleggia tamburo carrucola polea tambor polia krazek kolo kladka blok trissa "
    "шкив ролик 滑车 滑轮"
)
RADIUS = "radius radii rayon raggio radio raio promien polomer straal radie радиус 半径 반지름"
DIAMETER = "diameter durchmesser diametre diametro srednica prumer halfsalja halkaisija диаметр 直径 직경 dia"
