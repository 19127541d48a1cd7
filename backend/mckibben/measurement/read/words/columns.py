"""Words for columns and rows that are no channel of the muscle, by language."""

from __future__ import annotations

from mckibben.measurement.read.left_out import Reason

#: What makes a column something else -> language -> words.
OTHERS = {
    Reason.SET_VALUE: {
        "en": "set setpoint target desired demand demanded commanded cmd reference ref sp",
        "de": "soll sollwert fuehrung führung vorgabe", "fr": "consigne désirée cible",
        "it": "riferimento impostata impostato", "es": "consigna objetivo deseado",
        "pt": "alvo referência desejado", "pl": "zadane zadana", "cs": "žádaný žádaná",
        "ru": "заданное задание уставка", "tr": "hedef", "nl": "gewenst gewenste setpunt",
        "sv": "börvärde önskat", "ja": "目標 設定 指令 設定値", "zh": "设定 目标 给定",
        "da": "ønsket sætpunkt", "fi": "asetus asetusarvo tavoite ohje", "hu": "cél célérték előírt",
        "ro": "referință impusă", "el": "επιθυμητή στόχος", "uk": "задане завдання",
        "hr": "zadani zadana željeni", "sl": "želeni", "sk": "žiadaný", "ko": "목표 설정 지령",
    },
    Reason.SUPPLY: {
        "en": "supply line tank reservoir inlet source",
        "de": "versorgung versorgungs speise vordruck kessel", "fr": "alimentation réseau",
        "it": "alimentazione", "es": "alimentación", "pt": "alimentação", "pl": "zasilanie zasilania",
        "cs": "napájecí napájení", "ru": "питание питания магистраль магистрали", "tr": "besleme",
        "nl": "toevoer voeding", "sv": "matning matningstryck", "ja": "供給圧 供給 元圧",
        "zh": "供气 气源 供给 供压", "da": "forsyning forsynings", "fi": "syöttö",
        "hu": "táp tápnyomás hálózati", "ro": "alimentare", "el": "τροφοδοσίας τροφοδοσία",
        "uk": "живлення", "bg": "захранване захранващо", "hr": "dovod dovodni napajanje opskrba",
        "sl": "napajanje napajalni", "sk": "napájací napájanie", "ko": "공급 공급압",
    },
    Reason.AIR: {
        "en": "ambient atmosphere atmospheric baro barometer barometric",
        "de": "umgebung umgebungs luftdruck", "fr": "ambiante atmosphérique atmosphère",
        "it": "ambiente atmosferica", "es": "atmosférica ambiental",
        "pl": "otoczenia otoczenie atmosferyczne", "cs": "okolí barometrický",
        "ru": "атмосферное атмосферы барометр", "tr": "ortam atmosfer", "nl": "omgeving omgevingsdruk",
        "sv": "omgivning lufttryck", "ja": "大気圧", "zh": "大气压 环境",
        "da": "omgivelse omgivelser lufttryk", "fi": "ilmanpaine ympäristö", "hu": "környezeti légköri",
        "ro": "atmosferică ambiantă", "el": "ατμοσφαιρική περιβάλλοντος", "uk": "атмосферний навколишнього",
        "hr": "atmosferski okoline", "ko": "대기압 주위",
    },
    Reason.AT_REST: {
        "en": "rest initial nominal l0", "de": "ruhe ruhelänge ruhelaenge anfang anfangs nenn nennlänge",
        "pt": "inicial repouso", "pl": "spoczynkowa początkowa", "cs": "klidová počáteční",
        "ru": "исходная начальная свободная", "tr": "serbest başlangıç", "nl": "rustlengte beginlengte",
        "sv": "vilolängd vila", "ja": "自然長 初期長", "zh": "初始长度 原长 自由长度",
        "fr": "initiale repos", "it": "iniziale riposo", "es": "inicial reposo", "da": "hvilelængde hvile",
        "fi": "lepopituus lepo alkupituus", "hu": "nyugalmi kezdeti", "ro": "inițială repaus",
        "el": "αρχικό ηρεμίας", "uk": "початкова", "hr": "početna pocetna slobodna", "sl": "začetna",
        "sk": "počiatočná pokojová", "ko": "초기길이 자연길이",
    },
    Reason.PRELOAD: {
        "en": "preload pretension prestress", "de": "vorkraft vorlast", "it": "precarico", "es": "precarga",
        "ru": "преднатяг", "fr": "précharge", "nl": "voorspanning voorlast", "sv": "förspänning förlast",
        "pl": "naprężenie wstępne", "cs": "předpětí", "ja": "予荷重 初期荷重", "zh": "预载 预紧",
        "ko": "예하중",
    },
    Reason.DEVIATION: {
        "en": "dev stdev error vs versus std sigma residual rms uncertainty",
        "de": "fehler abweichung messunsicherheit unsicherheit stdabw standardabweichung",
        "fr": "incertitude écart erreur", "ru": "погрешность", "ja": "誤差", "zh": "误差",
        "it": "errore scarto", "es": "error incertidumbre desviación", "pt": "erro desvio incerteza",
        "pl": "błąd odchylenie", "cs": "chyba odchylka", "nl": "fout afwijking", "sv": "fel avvikelse",
        "fi": "virhe", "tr": "hata", "ko": "오차",
    },
    Reason.TUBE_SIZE: {
        "en": "inside inner outside outer wall bore", "de": "innen aussen",
    },
}  # fmt: skip

#: Words with which the statistics below a table begin, by language.
STATISTIC = {
    "en": (
        "mean average avg max maximum maxi min minimum mini std stdev sigma sd sum total count median "
        "range end statistics statistic"
    ),
    "de": "mittel mittelwert durchschnitt stdabw summe anzahl spannweite ende statistik",
    "fr": "moyenne somme fin écart", "it": "media somma totale fine medio massimo minimo",
    "es": "promedio suma media máximo mínimo total", "pl": "średnia średni maksimum minimum",
    "cs": "průměr", "ru": "среднее макс мин максимум минимум сумма ско", "tr": "ortalama",
    "nl": "gemiddelde som maximum", "sv": "medelvärde medel max", "ja": "平均 最大 最小",
    "zh": "平均 平均值 最大 最大值 最小 最小值 合计", "ko": "평균 최대 최소 합계",
    "pt": "média máximo mínimo", "da": "middel gennemsnit", "fi": "keskiarvo maksimi minimi",
    "hu": "átlag összeg", "ro": "medie", "el": "μέσος", "uk": "середнє", "hr": "prosjek srednja",
}  # fmt: skip

#: Columns that are no channel -> language -> words.
NO_CHANNELS = {
    Reason.NUMBER: {
        "en": "no number index idx point id scan sample row row# n i # unnamed seq sequence record frame",
        "de": "nr nummer lfd punkt zeile", "pl": "lp", "cs": "poř číslo", "ru": "№", "tr": "sıra",
        "ja": "番号 No", "zh": "序号 编号", "fr": "numéro num", "es": "núm número", "it": "numero",
        "pt": "número", "nl": "volgnummer", "sv": "nr", "da": "nr", "fi": "nro", "hu": "sorszám",
        "ro": "nr", "el": "α/α", "hr": "rbr br", "ko": "번호 순번",
    },
    Reason.REMARK: {
        "en": (
            "remark remarks comment comments note notes status state flag quality alarm alarms event "
            "marker validity error_code mode"
        ),
        "de": "bemerkung kommentar anmerkung status zustand hinweis ereignis",
        "fr": "remarque commentaire état statut alarme", "es": "observaciones estado comentario alarma",
        "it": "osservazioni nota stato allarme commento", "pl": "uwagi stan alarm", "cs": "poznámka stav",
        "ru": "примечание", "tr": "not durum", "nl": "opmerking toestand status",
        "sv": "anmärkning kommentar", "ja": "備考 アラーム 警報 状態 ロジック", "zh": "备注 状态 报警",
        "pt": "observação estado", "da": "bemærkning", "fi": "huomautus huom tila",
        "hu": "megjegyzés állapot", "ro": "observații", "el": "σχόλια", "uk": "примітка", "hr": "napomena",
        "ko": "비고 상태 알람",
    },
}  # fmt: skip

#: Words for the counts of an encoder, by language.
COUNTERS = {
    "en": "encoder enc counts count pulses ticks quadrature resolver",
    "de": "drehgeber inkremente impulse geber",
    "fr": "codeur impulsions", "it": "impulsi", "es": "codificador pulsos", "pt": "codificador pulsos",
    "pl": "enkoder impulsy", "cs": "enkodér", "ru": "энкодер импульсы", "tr": "enkoder", "nl": "pulsen",
    "sv": "pulser pulsgivare", "ja": "エンコーダ パルス", "zh": "编码器 脉冲", "ko": "엔코더 펄스",
}  # fmt: skip
#: Words for the column of values in a table with one value per line, by language.
VALUES = {
    "en": "value values val reading readings measurement", "de": "wert werte messwert", "fr": "valeur",
    "it": "valore", "es": "valor", "pt": "valor", "pl": "wartość", "cs": "hodnota", "ru": "значение",
    "tr": "değer", "nl": "waarde", "sv": "värde", "da": "værdi", "fi": "arvo", "hu": "érték",
    "ro": "valoare", "el": "τιμή", "uk": "значення", "hr": "vrijednost", "ja": "値 測定値", "zh": "值 数值",
    "ko": "값",
}  # fmt: skip
