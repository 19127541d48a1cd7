"""Words for what is no channel of the muscle, and for the conditions of a test, by language."""

from __future__ import annotations

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
