"""Words for the conditions of a test, and for what a pressure counts from, by language."""

from __future__ import annotations

#: Words of the texts around a table -> language -> words.
REMARKS = {
    "at rest": {
        "en": (
            "l0 rest resting unloaded relaxed free initial nominal gauge start sample specimen original "
            "undeformed natural neutral slack unpressurized unpressurised "
            "depressurized depressurised uninflated deflated vented "
            "unstretched unactuated"
        ),
        "de": (
            "ruhe ruhezustand ruhelage anfang anfangs nenn einspann ausgangs ungedehnt drucklos unbelastet "
            "entlüftet entspannt entspannten spannungslos ursprüngliche"
        ),
        "fr": "vide repos initiale libre origine dépressurisé",
        "it": "riposo iniziale libera nominale", "es": "reposo inicial libre original nominal despresurizado",
        "pt": "repouso inicial livre original despressurizado",
        "pl": "spoczynkowa początkowa swobodna", "cs": "klidová počáteční volná výchozí",
        "ru": "свободном свободная начальная исходная", "tr": "serbest başlangıç ilk",
        "nl": "rust begin vrije", "sv": "vila ursprunglig fri", "da": "hvile fri oprindelig",
        "fi": "lepo alku vapaa", "hu": "nyugalmi kezdeti szabad", "ro": "inițială repaus liberă",
        "el": "ηρεμίας αρχικό", "uk": "початкова вільна", "bg": "начална свободна",
        "hr": "početna pocetna slobodna mirovanja nazivna", "sl": "začetna prosta mirovanju",
        "sk": "počiatočná pokojová voľná", "ko": "초기 자연 무부하", "ja": "自然 初期 無負荷",
        "zh": "初始 自由 自然",
    },
    "rest length": {
        "de": "ruhelänge anfangslänge nennlänge ausgangslänge einspannlänge probenlänge",
        "nl": "rustlengte beginlengte uitgangslengte", "sv": "vilolängd ursprungslängd",
        "ja": "自然長 初期長 自由長 基準長 初期長さ 自然長さ 無加圧長 無加圧時長さ 非加圧長",
        "zh": "初始长度 原长 自由长度 自然长度 自然长 初始长 原始长度 静息长度 静止长度",
        "ko": "초기길이 자연길이 자유길이 자유장 자연장 초기장", "da": "hvilelængde startlængde",
        "fi": "lepopituus alkupituus", "hu": "nyugalmihossz",
    },
    "whole length": {
        "en": "active effective working useful usable braided",
        "de": "aktiv aktive aktiven wirksam wirksame nutzbar nutz nutzlänge",
        "fr": "utile active", "it": "attiva utile", "es": "activa útil efectiva",
        "pt": "ativo útil efetivo", "pl": "czynna robocza aktywna", "cs": "aktivní činná užitečná",
        "sk": "aktívna činná účinná", "ru": "рабочая активная рабочей активной",
        "uk": "робоча активна", "nl": "actieve werkzame effectieve", "sv": "aktiv effektiv",
        "da": "aktiv", "fi": "aktiivinen tehollinen", "hu": "aktív hasznos", "ro": "activă utilă",
        "tr": "etkin aktif", "ja": "有効長", "zh": "有效长度 有效长 工作长度", "ko": "유효 유효길이",
    },
    "between": {
        "en": "between from", "de": "zwischen zw", "fr": "entre", "it": "tra fra", "pl": "między pomiędzy",
        "cs": "mezi", "sk": "medzi", "ru": "между", "uk": "між", "nl": "tussen", "sv": "mellan",
        "da": "mellem", "fi": "välillä", "hu": "között", "ro": "între", "hr": "između",
        "tr": "arası arasında", "ja": "間", "zh": "之间 间", "ko": "사이",
    },
    "ends": {
        "en": "fitting fittings clamp clamps end ends endcap endcaps cap caps nipple nipples ferrule "
        "ferrules crimp crimps plug plugs flange flanges terminals ties wraps connectors",
        "de": "armatur armaturen einspannung einspannungen klemmen enden anschlüssen anschlussstücken "
        "endstücken endkappen schellen verpressungen stopfen nippeln",
        "fr": "embouts raccords extrémités colliers mors sertissages bouchons",
        "it": "raccordi estremità morsetti fascette tappi terminali",
        "es": "racores extremos mordazas abrazaderas terminales tapones",
        "pt": "terminais extremidades abraçadeiras conexões tampões",
        "pl": "końcówkami końcówki zaciskami końcami", "cs": "koncovkami koncovky svorkami konci",
        "sk": "koncovkami koncovky svorkami koncami", "ru": "заделками заделки наконечниками зажимами "
        "концами штуцерами", "uk": "наконечниками затискачами", "nl": "klemmen uiteinden fittingen",
        "sv": "ändar ändstycken klämmor kopplingar", "da": "ender klemmer fittings",
        "fi": "päiden liittimien", "hu": "csatlakozók végek",
        "ro": "capete racorduri", "hr": "krajeva spojnica",
        "tr": "uçlar bağlantı", "ja": "金具 両端", "zh": "接头 两端 端头 夹具", "ko": "피팅 양단",
    },
    "other length": {
        "en": "tube tubing hose line pipe cable wire rope stroke travel step steps marks markers "
        "contracted shortened inflated pressurized pressurised stretched sensor laser crosshead carriage "
        "reading reads",
        "de": "schlauch leitung rohr kabel seil hub weg schritt marken kontrahiert verkürzt gefüllt",
        "fr": "tuyau câble course pas repères contracté gonflé", "it": "tubo cavo corsa passo contratto",
        "es": "tubo manguera cable carrera paso marcas contraído", "pt": "mangueira cabo curso passo marcas",
        "pl": "wąż przewód skok znacznikami", "cs": "hadice lanko zdvih značkami",
        "sk": "hadica lanko zdvih značkami", "ru": "шланг трубка трос ход метками меток шаг",
        "nl": "slang kabel slag markeringen", "sv": "slang kabel slag märken", "ja": "標点 チューブ",
        "zh": "标距 气管 行程", "ko": "표점 호스",
    },
    "load": {
        "en": "load mass weight hanging hung hangs deadweight dead suspended attached "
        "lifts lifting lifted carries carrying",
        "de": "last masse gewicht gehängt angehängt hängt hängend gewichtsstück hebt gehoben trägt",
        "fr": "charge poids masse suspendu suspendue accroché soulève porte",
        "it": "carico massa peso appesa appeso sospeso", "es": "carga masa peso colgado suspendido",
        "pt": "carga peso massa suspenso pendurado",
        "pl": "masa obciążenie ciężar obciążnik zawieszony podwieszony",
        "cs": "hmotnost závaží zátěž břemeno",
        "ru": "масса груз нагрузка вес гиря груза", "tr": "yük kütle ağırlık", "nl": "massa gewicht",
        "sv": "massa vikt last", "ja": "質量 おもり 荷重 錘 重り 重錘 分銅 負荷",
        "zh": "质量 负载 砝码 载荷 重物 配重 重量 悬挂 负荷",
        "hr": "teret uteg opterećenje opterecenje utega", "sl": "breme utež",
        "sk": "bremeno závažie hmotnosť", "hu": "tömeg teher terhelés súly", "ro": "masă sarcină greutate",
        "fi": "kuorma massa paino", "da": "masse vægt belastning lod lodd vekt", "el": "φορτίο μάζα βάρος",
        "uk": "маса вантаж навантаження вага", "bg": "маса товар тежест",
        "ko": "하중 질량 무게 추 부하 중량",
    },
    "supply": {
        "en": "supply shop compressor",
        "de": "versorgung versorgungsdruck speisedruck vordruck netzdruck druckversorgung",
        "fr": "alimentation réseau", "it": "alimentazione", "es": "alimentación", "pt": "alimentação",
        "pl": "zasilanie zasilania", "cs": "napájecí napájení",
        "ru": "питания питание магистрали магистраль", "tr": "besleme",
        "nl": "voedingsdruk toevoerdruk voeding toevoer",
        "sv": "matningstryck matning matningstrycket försörjning", "ja": "供給圧 供給圧力 元圧 供給",
        "zh": "供气压力 气源压力 供气 供给 供压 气源", "da": "forsyning forsyningstryk",
        "fi": "syöttöpaine syöttö", "hu": "tápnyomás táp hálózati",
        "ro": "alimentare", "el": "τροφοδοσία τροφοδοσίας", "uk": "живлення", "bg": "захранване захранващо",
        "hr": "dovod dovodni napajanje opskrba dobava", "sl": "napajanje napajalni",
        "sk": "napájací napájanie", "ko": "공급 공급압 공급압력",
    },
    "ambient": {
        "en": "ambient amb pamb patm atm baro barometer barometric atmospheric atmosphere",
        "de": "luftdruck umgebungsdruck umgebung", "fr": "atmosphérique ambiante baromètre",
        "it": "atmosferica ambiente barometro", "es": "atmosférica barómetro", "pt": "atmosférica barômetro",
        "pl": "atmosferyczne otoczenia barometr", "cs": "barometrický okolí atmosférický",
        "ru": "атмосферное барометрическое барометр барометра",
        "tr": "atmosfer ortam", "nl": "omgevingsdruk luchtdruk",
        "sv": "lufttryck omgivningstryck atmosfärstryck", "ja": "大気圧 気圧",
        "zh": "大气压 环境压力 气压计", "ko": "대기압", "da": "lufttryk atmosfæretryk omgivelse",
        "fi": "ilmanpaine ympäristö", "hu": "légköri légnyomás környezeti", "ro": "atmosferică",
        "el": "ατμοσφαιρική", "uk": "атмосферний барометричний", "bg": "атмосферно",
        "hr": "atmosferski okoline", "sl": "atmosferski",
    },
    "barometer": {
        "en": "baro barometer barometric patm pamb", "de": "luftdruck barometer", "fr": "baromètre",
        "it": "barometro", "es": "barómetro", "pt": "barômetro", "pl": "barometr", "cs": "barometrický",
        "ru": "барометр", "ja": "大気圧 気圧計", "zh": "大气压 气压计", "ko": "대기압", "sv": "lufttryck",
        "da": "lufttryk", "fi": "ilmanpaine", "hu": "légnyomás", "nl": "luchtdruk barometer",
    },
    "sample": {
        "en": "specimen sample dut", "de": "probe prüfling prüfgegenstand", "fr": "éprouvette",
        "it": "provino campione", "es": "probeta muestra", "pt": "amostra provete", "pl": "próbka",
        "cs": "vzorek", "ru": "образец", "tr": "numune", "nl": "monster proefstuk", "sv": "prov provstycke",
        "ja": "試料 試験片", "zh": "试样 样品", "da": "prøve emne",
        "fi": "näyte koekappale", "hu": "minta próbatest", "ro": "probă epruvetă", "el": "δείγμα δοκίμιο",
        "uk": "зразок", "hr": "uzorak", "sl": "vzorec", "sk": "vzorka", "ko": "시편 시료",
    },
    "date": {
        "en": "date", "de": "datum", "fr": "date", "es": "fecha", "it": "data giorno", "ru": "дата",
        "tr": "tarih", "ja": "日付", "zh": "日期", "pt": "data", "pl": "data", "cs": "datum", "nl": "datum",
        "sv": "datum", "da": "dato", "fi": "päivämäärä pvm", "hu": "dátum", "ro": "data",
        "el": "ημερομηνία", "uk": "дата", "ko": "날짜 일자", "hr": "datum",
    },
    "loadless": {
        "en": (
            "preload max maximum maximal cell capacity limit range pre sensor moving rated accuracy "
            "resolution transducer loadcell"
        ),
        "de": "vorkraft vorlast zelle grenze messbereich sensor kraftmessdose", "ru": "датчик макс",
        "tr": "sensör", "zh": "传感器 量程", "fr": "capteur précharge maxi",
        "it": "sensore cella precarico massimo", "es": "sensor célula precarga máxima máximo",
        "pt": "sensor célula máximo máxima", "pl": "czujnik wstępne", "cs": "snímač předpětí",
        "nl": "sensor voorspanning", "sv": "givare förspänning", "fi": "anturi", "da": "måler føler",
        "hu": "érzékelő szenzor cella", "ro": "senzor", "el": "αισθητήρας", "hr": "senzor",
        "ko": "센서 로드셀 정격", "ja": "センサ 定格 容量",
    },
    "without": {
        "en": "no zero without", "de": "ohne kein null", "fr": "sans nulle", "it": "senza nulla",
        "es": "sin nula", "pt": "sem nula", "pl": "bez", "cs": "bez", "ru": "без",
        "nl": "zonder geen", "sv": "utan",
        "da": "uden", "fi": "ilman", "hu": "nulla", "ro": "fără", "el": "χωρίς", "uk": "без",
        "bg": "без", "hr": "bez", "sl": "brez", "sk": "bez",
    },
    "unit": {
        "en": "unit units uom", "de": "einheit einheiten", "fr": "unité unités", "it": "unità",
        "es": "unidad unidades", "pt": "unidade unidades", "pl": "jednostka jednostki",
        "cs": "jednotka jednotky", "ru": "единица единицы", "tr": "birim birimi birimler",
        "nl": "eenheid eenheden", "sv": "enhet enheter", "da": "enhed enheder", "fi": "yksikkö yksiköt",
        "hu": "egység mértékegység", "ro": "unitate unități", "el": "μονάδα μονάδες", "uk": "одиниця одиниці",
        "hr": "jedinica jedinice", "sl": "enota enote", "ja": "単位", "zh": "单位 單位", "ko": "단위",
    },
    "constant": {
        "en": "constant held fixed", "de": "konstant konstante", "fr": "constant", "it": "costante",
        "es": "constante", "pt": "constante", "pl": "stałe stała", "cs": "konstantní", "nl": "constant",
        "sv": "konstant", "da": "konstant", "fi": "vakio", "hu": "állandó", "ro": "constant constantă",
        "hr": "konstantno stalni", "ja": "一定", "zh": "恒定", "ko": "일정", "ru": "постоянная",
    },
}  # fmt: skip

#: Words that say what a pressure counts from -> language -> words.
REFERENCES = {
    "absolute": {
        "en": "abs absolute", "de": "absolut absolutdruck", "fr": "absolue absolu",
        "it": "assoluta assoluto", "es": "absoluta absoluto", "pl": "bezwzględne absolutne",
        "cs": "absolutní absolutně", "ru": "абс абсолютное абсолютных", "tr": "mutlak", "ja": "絶対圧 絶対",
        "zh": "绝压 绝对压力 绝对", "nl": "absoluut", "sv": "absoluttryck", "da": "absolut",
        "fi": "absoluuttinen", "hu": "abszolút", "ro": "absolută absolut", "el": "απόλυτη",
        "uk": "абсолютний абсолютна", "hr": "apsolutni apsolutno", "sl": "absolutni", "sk": "absolútny",
        "ko": "절대압 절대", "pt": "absoluta absoluto absolutas",
    },
    "gauge": {
        "en": "gauge gage rel relative", "de": "überdruck ueberdruck relativ",
        "fr": "effective manométrique relative relatif", "it": "relativa relativo manometrica",
        "es": "manométrica relativa", "pt": "manométrica relativa",
        "pl": "nadciśnienie relatywne nadciśnienia", "cs": "přetlak přetlaku relativní",
        "ru": "изб избыточное избыточных манометрическое", "tr": "bağıl gösterge",
        "nl": "overdruk relatief", "sv": "övertryck relativt", "ja": "ゲージ圧 ゲージ",
        "zh": "表压 表压力 相对压力", "da": "overtryk", "fi": "ylipaine",
        "hu": "túlnyomás relatív", "ro": "relativă manometrică", "el": "σχετική μανομετρική",
        "uk": "надлишковий надлишкова манометричний", "bg": "манометрично",
        "hr": "pretlak pretlaku pretlaka predtlak", "sl": "nadtlak", "sk": "pretlak relatívny",
        "ko": "게이지압 게이지",
    },
}  # fmt: skip
