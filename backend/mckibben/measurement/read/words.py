"""The words of laboratories by what they mean and by language: one table for heads, preambles and remarks.

Written as people write them, compared without case and accents. A word of five letters or more also counts
as the beginning or end of a longer one; ``*`` says the same of a shorter one (``*weg``, ``усил*``). Chinese,
Japanese and Korean words of two characters or more count wherever they stand.
"""

from __future__ import annotations

#: Channel -> language -> words for it.
CHANNELS = {
    "time": {
        "en": "time timestamp ts datetime seconds clock elapsed",
        "de": "*zeit sekunden uhrzeit zeitstempel dauer", "fr": "temps heure horodatage", "it": "tempo ora",
        "es": "tiempo hora", "pt": "tempo hora", "pl": "czas czasu", "cs": "čas času",
        "ru": "время времени", "tr": "zaman süre", "nl": "tijd tijdstip", "sv": "tid tidpunkt",
        "ja": "時刻 時間 経過時間 日時", "zh": "时间 時間 时刻", "ko": "시간",
    },
    "pressure": {
        "en": "pressure press", "de": "druck", "fr": "pression", "it": "pressione", "es": "presión",
        "pt": "pressão", "pl": "ciśnienie ciśnienia nadciśnienie", "cs": "*tlak tlaku přetlak",
        "ru": "давление давления", "tr": "basınç basıncı", "nl": "*druk", "sv": "tryck",
        "ja": "圧力 ゲージ圧 内圧 空気圧", "zh": "压力 气压 压强 壓力 氣壓 表压", "ko": "압력",
    },
    "force": {
        "en": "force load weight tension traction pull", "de": "kraft *last gewicht", "fr": "effort charge",
        "it": "forza carico", "es": "fuerza carga", "pt": "força tração carga", "pl": "siła siły",
        "cs": "síla síly", "ru": "усил* сила силы нагрузка тяга", "tr": "kuvvet kuvveti yük",
        "nl": "kracht belasting", "sv": "kraft belastning", "ja": "荷重 力 張力 引張力 発生力",
        "zh": "力 拉力 载荷 负载 推力 张力 拉伸力 載荷", "ko": "하중 장력",
    },
    "length": {
        "en": "length", "de": "länge laenge", "fr": "longueur", "it": "lunghezza", "es": "longitud",
        "pt": "comprimento", "pl": "długość długości", "cs": "délka délky", "ru": "длина длины",
        "tr": "uzunluk boy", "nl": "lengte", "sv": "längd", "ja": "長さ 全長", "zh": "长度 全长 長度",
        "ko": "길이",
    },
    "displacement": {
        "en": "displacement displ disp stroke travel position shortening",
        "de": "*weg *hub verschiebung verkürzung verkuerzung auslenkung verfahrweg",
        "fr": "course déplacement raccourcissement", "it": "corsa spostamento posizione accorciamento",
        "es": "carrera desplazamiento posición acortamiento",
        "pt": "encurtamento deslocamento curso posição", "pl": "skrócenie przemieszczenie skok",
        "cs": "zkrácení zdvih dráha posunutí", "ru": "ход укорочение укорочения перемещение смещение",
        "tr": "kısalma strok konum", "nl": "slag verplaatsing verkorting",
        "sv": "förkortning förskjutning läge slag", "ja": "変位 収縮量 縮み ストローク",
        "zh": "位移 行程 收缩量 缩短量 縮短量", "ko": "변위 행정 수축량",
    },
    "extension": {
        "en": "extension elongation", "de": "längenänderung dehnung verlängerung verlaengerung",
        "fr": "allongement", "it": "allungamento", "es": "alargamiento", "pt": "alongamento",
        "pl": "wydłużenie", "cs": "prodloužení", "ru": "удлинение", "tr": "uzama", "nl": "verlenging",
        "sv": "förlängning", "ja": "伸び", "zh": "伸长 伸长量",
    },
    "contraction": {
        "en": "contraction strain kappa eps epsilon", "de": "kontraktion", "it": "contrazione",
        "es": "contracción", "pt": "contração", "pl": "kontrakcja", "cs": "kontrakce", "ru": "сокращение",
        "tr": "kasılma büzülme", "nl": "contractie", "ja": "収縮率 ひずみ", "zh": "收缩率 应变 收缩比",
        "ko": "수축률",
    },
    "diameter": {
        "en": "diameter", "de": "durchmesser", "fr": "diamètre", "it": "diametro", "pl": "średnica",
        "cs": "průměr", "ru": "диаметр", "nl": "doorsnede", "ja": "直径 外径", "zh": "直径 外径",
    },
    "velocity": {
        "en": "velocity speed", "de": "geschwindigkeit", "fr": "vitesse", "it": "velocità",
        "es": "velocidad", "pt": "velocidade", "pl": "prędkość", "cs": "rychlost", "ru": "скорость",
        "nl": "snelheid", "sv": "hastighet", "ja": "速度", "zh": "速度",
    },
    "command": {
        "en": "command valve", "de": "ventil stellgröße stellgroesse stell", "fr": "vanne", "it": "valvola",
        "es": "comando válvula", "pl": "zawór", "ru": "клапан", "tr": "valf vana",
        "nl": "klep stuursignaal", "sv": "styrsignal", "ja": "弁開度 バルブ", "zh": "阀 阀门 阀开度",
    },
    "temperature": {
        "en": "temperature temp", "de": "temperatur", "it": "temperatura", "cs": "teplota",
        "ru": "температура", "tr": "sıcaklık", "nl": "temperatuur", "ja": "温度", "zh": "温度",
        "ko": "온도",
    },
    "group": {
        "en": "cycle sweep", "de": "zyklus versuch lauf", "fr": "essai", "it": "prova", "es": "ciclo",
        "pl": "cykl", "cs": "cyklus", "ru": "цикл", "tr": "döngü", "nl": "cyclus", "sv": "cykel",
        "ja": "試験番号", "zh": "循环 试验编号",
    },
}  # fmt: skip

#: What makes a column something else -> language -> words.
OTHERS = {
    "a set value": {
        "en": "set setpoint target desired demand demanded reference ref sp",
        "de": "soll sollwert fuehrung führung", "fr": "consigne", "it": "riferimento", "es": "consigna",
        "pt": "alvo", "pl": "zadane zadana", "cs": "žádaný žádaná", "ru": "заданное задание уставка",
        "tr": "hedef", "nl": "gewenst gewenste", "sv": "börvärde", "ja": "目標 設定 指令",
        "zh": "设定 目标 给定",
    },
    "the supply": {
        "en": "supply line tank reservoir inlet source",
        "de": "versorgung versorgungs speise vordruck kessel", "fr": "alimentation", "it": "alimentazione",
        "es": "alimentación", "pt": "alimentação", "pl": "zasilanie zasilania", "cs": "napájecí napájení",
        "ru": "питание питания магистраль магистрали", "tr": "besleme", "nl": "toevoer voeding",
        "sv": "matning matningstryck", "ja": "供給圧", "zh": "供气 气源 供给",
    },
    "the surrounding air": {
        "en": "ambient atmosphere atmospheric baro barometer barometric",
        "de": "umgebung umgebungs luftdruck", "fr": "ambiante atmosphérique", "it": "ambiente atmosferica",
        "es": "atmosférica", "pl": "otoczenia otoczenie atmosferyczne", "cs": "okolí barometrický",
        "ru": "атмосферное атмосферы барометр", "tr": "ortam atmosfer", "nl": "omgeving omgevingsdruk",
        "sv": "omgivning lufttryck", "ja": "大気圧", "zh": "大气压 环境",
    },
    "a length at rest": {
        "en": "rest initial nominal l0", "de": "ruhe ruhelänge ruhelaenge anfang anfangs nenn nennlänge",
        "pt": "inicial repouso", "pl": "spoczynkowa początkowa", "cs": "klidová počáteční",
        "ru": "исходная начальная свободная", "tr": "serbest başlangıç", "nl": "rustlengte beginlengte",
        "sv": "vilolängd", "ja": "自然長 初期長", "zh": "初始长度 原长 自由长度",
    },
    "a preload": {
        "en": "preload", "de": "vorkraft vorlast", "it": "precarico", "es": "precarga", "ru": "преднатяг",
    },
    "a deviation": {
        "en": "dev stdev error vs versus std sigma residual rms uncertainty",
        "de": "fehler abweichung messunsicherheit unsicherheit", "fr": "incertitude", "ru": "погрешность",
        "ja": "誤差", "zh": "误差",
    },
    "a size of the tube": {
        "en": "inside inner outside outer wall bore", "de": "innen aussen",
    },
}  # fmt: skip

#: Words of the texts around a table -> language -> words.
REMARKS = {
    "at rest": {
        "en": "l0 rest unloaded relaxed free initial nominal gauge start sample specimen",
        "de": "ruhe anfang anfangs nenn einspann ausgangs", "fr": "vide repos initiale libre",
        "it": "riposo iniziale libera", "es": "reposo inicial", "pt": "repouso",
        "pl": "spoczynkowa początkowa", "cs": "klidová počáteční volná",
        "ru": "свободном свободная начальная исходная", "tr": "serbest başlangıç ilk",
        "nl": "rust begin vrije", "sv": "vila ursprunglig fri",
    },
    "rest length": {
        "de": "ruhelänge anfangslänge nennlänge ausgangslänge einspannlänge probenlänge",
        "nl": "rustlengte", "sv": "vilolängd", "ja": "自然長 初期長",
        "zh": "初始长度 原长 自由长度 自然长度", "ko": "초기길이",
    },
    "load": {
        "en": "load mass weight hanging deadweight dead", "de": "last masse gewicht", "fr": "charge poids",
        "it": "carico massa peso", "es": "carga masa", "pt": "carga peso", "pl": "masa obciążenie ciężar",
        "cs": "hmotnost závaží zátěž", "ru": "масса груз нагрузка", "tr": "yük kütle ağırlık",
        "nl": "massa gewicht", "sv": "massa vikt last", "ja": "質量 おもり 荷重",
        "zh": "质量 负载 砝码 载荷",
    },
    "supply": {
        "en": "supply", "de": "versorgung versorgungsdruck speisedruck vordruck netzdruck",
        "fr": "alimentation", "it": "alimentazione", "es": "alimentación", "pt": "alimentação",
        "pl": "zasilanie zasilania", "cs": "napájecí napájení",
        "ru": "питания питание магистрали магистраль", "tr": "besleme",
        "nl": "voedingsdruk toevoerdruk voeding toevoer", "sv": "matningstryck matning",
        "ja": "供給圧 供給圧力", "zh": "供气压力 气源压力 供气",
    },
    "ambient": {
        "en": "ambient baro barometer barometric atmospheric atmosphere",
        "de": "luftdruck umgebungsdruck umgebung", "fr": "atmosphérique ambiante",
        "it": "atmosferica ambiente", "es": "atmosférica", "pt": "atmosférica",
        "pl": "atmosferyczne otoczenia", "cs": "barometrický okolí atmosférický",
        "ru": "атмосферное барометрическое", "tr": "atmosfer ortam", "nl": "omgevingsdruk luchtdruk",
        "sv": "lufttryck", "ja": "大気圧", "zh": "大气压", "ko": "대기압",
    },
    "sample": {
        "en": "specimen sample dut", "de": "probe prüfling prüfgegenstand", "fr": "éprouvette",
        "it": "provino campione", "es": "probeta muestra", "pt": "amostra", "pl": "próbka", "cs": "vzorek",
        "ru": "образец", "tr": "numune", "nl": "monster proefstuk", "sv": "prov provstycke",
        "ja": "試料 試験片", "zh": "试样 样品", "id": "muster",
    },
    "date": {
        "en": "date", "de": "datum", "fr": "date", "es": "fecha", "it": "data giorno", "ru": "дата",
        "tr": "tarih", "ja": "日付", "zh": "日期",
    },
    "loadless": {
        "en": "preload max maximum maximal cell capacity limit range pre sensor moving",
        "de": "vorkraft vorlast zelle grenze", "ru": "датчик макс", "tr": "sensör", "zh": "传感器 量程",
    },
    "constant": {
        "en": "constant held fixed", "de": "konstant konstante", "fr": "constant", "it": "costante",
    },
}  # fmt: skip

#: Words that say what a pressure counts from -> language -> words.
REFERENCES = {
    "absolute": {
        "en": "abs absolute", "de": "absolut absolutdruck", "fr": "absolue absolu",
        "it": "assoluta assoluto", "es": "absoluta absoluto", "pl": "bezwzględne", "cs": "absolutní",
        "ru": "абс абсолютное абсолютных", "tr": "mutlak", "ja": "絶対圧 絶対", "zh": "绝压 绝对压力 绝对",
    },
    "gauge": {
        "en": "gauge gage rel relative", "de": "überdruck ueberdruck relativ",
        "fr": "effective manométrique relative", "it": "relativa relativo", "es": "manométrica",
        "pt": "manométrica", "pl": "nadciśnienie relatywne", "cs": "přetlak přetlaku",
        "ru": "изб избыточное избыточных манометрическое", "tr": "bağıl gösterge",
        "nl": "overdruk relatief", "sv": "övertryck", "ja": "ゲージ圧", "zh": "表压 表压力",
    },
}  # fmt: skip

#: Words with which the statistics below a table begin, by language.
STATISTIC = {
    "en": (
        "mean average avg max maximum maxi min minimum mini std stdev sigma sd sum total count median "
        "range end statistics statistic"
    ),
    "de": "mittel mittelwert durchschnitt stdabw summe anzahl spannweite ende statistik",
    "fr": "moyenne somme fin",
    "it": "media somma totale fine",
    "es": "promedio suma",
    "pl": "średnia",
    "cs": "průměr",
    "ru": "среднее макс мин максимум минимум сумма ско",
    "tr": "ortalama",
    "nl": "gemiddelde",
    "sv": "medelvärde",
    "ja": "平均 最大 最小",
    "zh": "平均 平均值 最大 最大值 最小 最小值",
    "ko": "평균",
}  # fmt: skip

#: Columns that are no channel -> language -> words.
NO_CHANNELS = {
    "a running number": {
        "en": "no number index idx point id scan sample row row# n i # unnamed seq sequence record frame",
        "de": "nr nummer lfd punkt zeile", "pl": "lp", "cs": "poř", "ru": "№", "tr": "sıra", "ja": "番号",
        "zh": "序号 编号",
    },
    "a remark": {
        "en": "remark remarks comment comments note notes status state flag quality",
        "de": "bemerkung kommentar anmerkung", "fr": "remarque", "es": "observaciones",
        "it": "osservazioni nota", "pl": "uwagi", "cs": "poznámka", "ru": "примечание", "tr": "not",
        "nl": "opmerking", "sv": "anmärkning", "ja": "備考", "zh": "备注",
    },
}  # fmt: skip

#: Words that say which way a muscle moves -> language -> words.
DIRECTIONS = {
    "shortening": {
        "en": "up u p positive fill filling inflation inflating shortening", "de": "füllen verkürzen",
        "tr": "gidiş", "ru": "прямой", "nl": "vullen",
    },
    "lengthening": {
        "en": "down d n negative vent venting deflation deflating lengthening",
        "de": "entlüften verlängern", "tr": "dönüş", "ru": "обратный", "nl": "legen",
    },
}  # fmt: skip

#: Words that tell the way there from the way back, in heads of columns of one quantity.
WAYS = {
    "en": (
        "up down loading unloading load unload inflation deflation inflating deflating forward backward "
        "return there back increasing decreasing rising falling filling venting"
    ),
    "de": (
        "auf ab aufwärts abwärts hin rück hinweg rückweg belasten entlasten belastung entlastung füllen "
        "entlüften"
    ),
    "fr": "montée descente aller retour",
    "it": "salita discesa andata ritorno",
    "es": "subida bajada ida vuelta",
    "pt": "subida descida ida volta",
    "pl": "góra dół",
    "cs": "nahoru dolů tam zpět",
    "ru": "вверх вниз прямой обратный нагружение разгрузка",
    "tr": "gidiş dönüş artan azalan yükleme boşaltma",
    "nl": "heen terug op neer",
    "sv": "upp ner fram tillbaka",
    "ja": "加圧 減圧 往路 復路",
    "zh": "加压 减压 上升 下降 加载 卸载",
}  # fmt: skip

#: Units in other letters and words -> the spelling of the unit library; lower case.
UNITS = {
    "s": (
        "sek seg sekunden sekundy secondes secondi segundos saniye sn sec secs с сек 秒 초 seconden "
        "sekunder"
    ),
    "ms": "msek msec мс 毫秒",
    "min": "мин dk dakika 分 minuten minutes",
    "h": "ч saat",
    "ns": "nsec nsecs nanoseconds нс",
    "µs": "usec µsec мкс",
    "N": "newton newtons н 牛 牛顿 ニュートン 뉴턴",
    "kN": "kn кн 千牛",
    "kgf": "kp kg-force kg(f) кгс 公斤力",
    "gf": "гс",
    "ozf": "oz-f ounce-force",
    "lbf": "lbs lb lbs. pounds",
    "kgf/cm2": "kp/cm2 kg/cm2 kg/cm² kgf/cm² кгс/см2 кгс/см²",
    "bar": "бар 巴 バール",
    "mbar": "мбар",
    "Pa": "па 帕",
    "kPa": "кпа 千帕",
    "MPa": "мпа 兆帕",
    "torr": "mmhg torr",
    "mm": "мм 毫米 ミリ",
    "cm": "см 厘米",
    "m": "м 米 meter metre",
    "in": "zoll \" inch inches pouces pollici",
    "%": "percent prozent procent процент проц ％ pct",
    "V": "vol volt volts в",
    "kg": "кг 千克 公斤",
    "g": "г gram grams",
    "µm": "um мкм",
    "degC": "°с ℃ c° celsius",
    "degF": "℉ fahrenheit",
}  # fmt: skip

#: What instruments and programs write instead of a number -> texts, lower case; repeated signs say the same.
MARKERS = {
    "not a finite number": (
        "nan", "+nan", "-nan", "na", "<na>", "n/a", "#n/a", "#na", "null", "none", "nil", "#nv",
        "#div/0!", "#value!", "#ref!", "#num!", "1.#qnan", "-1.#ind", "1.#ind", "inf", "+inf", "-inf",
        "infinity", "+infinity", "-infinity", "∞", "+∞", "-∞", "1.#inf", "-1.#inf",
    ),
    "no reading": (
        "no data", "nodata", "no value", "missing", "bad", "invalid", "error", "err", "fail", "timeout",
        "n.a.", "n.d.", "k.a.", "k. a.", "brak", "нет", "нет данных", "无", "欠測", "dnf", "*", "?", "-",
        "–", "—", "/",
    ),
    "out of range": (
        "ol", "+ol", "-ol", "o.l", "o.l.", "0.l", "ovl", "ovld", "ovr", "ovf", "over", "over range",
        "overrange", "overload", "overflow", "under", "underrange", "under range", "udr", "sat",
        "saturated", "burnout", "b.o.", "open", "hi", "lo", "hihi", "lolo",
    ),
}  # fmt: skip
