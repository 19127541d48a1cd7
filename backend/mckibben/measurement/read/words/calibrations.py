"""Words of sentences on the calibration of a sensor, folded, parted by blanks."""

from __future__ import annotations

#: What a quantity beside it is: the range of a sensor, its rated value.
RANGE = (
    "fs fso range span capacity rated nominal fullscale endwert messbereich nennbereich nennlast nennkraft "
    "nenndruck nennwert etendue calibre echelle fondoscala portata campo alcance capacidad rango capacidade "
    "gama zakres rozsah bereik meetbereik matomrade matomradet alue meroalue diapazon диапазон предел "
    "レンジ 定格 量程 额定 정격 범위 mertartomany"
)
#: The same in several words.
PHRASES = (
    "full scale",
    "full-scale",
    "pleine echelle",
    "fondo scala",
    "fondo de escala",
    "fundo de escala",
    "100 %",
)
#: What a reading beside it is: that at no load.
ZERO = (
    "zero offset null nullpunkt nullwert nullabgleich balance tare tara bias decalage desplazamiento "
    "cero intercept nulpunt nollpunkt"
)
#: Symbols and words for the signal itself.
SIGNAL = (
    "u v x adc raw count counts reading readings voltage volt volts signal spannung code digit digits output "
    "mv ma tension tensione tensao uout vout i"
)
#: A sensor was set to zero before the test.
BALANCED = (
    "balanced nulled zeroed tared autozero autozeroed rezeroed abgeglichen genullt nullabgleich tariert "
    "tarata azzerato azzerata tarado zerado genuld nollad nollstalld"
)
