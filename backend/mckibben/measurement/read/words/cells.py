"""Units in other letters and words, and what stands instead of a number."""

from __future__ import annotations

#: Units in other letters and words -> the spelling of the unit library; lower case.
UNITS = {
    "s": (
        "sek seg sekunden sekundy secondes secondi segundos saniye sn sec secs с сек 秒 초 seconden "
        "sekunder сек. sek. seg. segundo seconde sekunda sekunde sekunti másodperc δευτ"
    ),
    "ms": "msek msec мс 毫秒", "min": "мин dk dakika 分 minuten minutes", "h": "ч saat",
    "ns": "nsec nsecs nanoseconds нс", "µs": "usec µsec мкс",
    "N": "newton newtons н 牛 牛顿 ニュートン 뉴턴 нютон ньютон н.", "kN": "kn кн 千牛",
    "kgf": "kp kg-force kg(f) кгс 公斤力 公斤 kilopond кгс.", "gf": "гс", "ozf": "oz-f ounce-force",
    "lbf": "lbs lb lbs. pounds", "kgf/cm2": "kp/cm2 kg/cm2 kg/cm² kgf/cm² кгс/см2 кгс/см²",
    "bar": "бар 巴 バール bari", "mbar": "мбар", "Pa": "па 帕", "kPa": "кпа 千帕 kilopascal",
    "MPa": "мпа 兆帕", "torr": "mmhg torr", "mm": "мм 毫米 ミリ millimeter millimetre milímetro 밀리미터",
    "cm": "см 厘米", "m": "м 米 meter metre", "in": "zoll \" inch inches pouces pollici",
    "%": "percent prozent procent процент проц ％ pct", "permille": "promille promil permil per-mille",
    "V": "vol volt volts в", "kg": "кг 千克 公斤",
    "g": "г gram grams", "µm": "um мкм", "degC": "°с ℃ c° celsius °c. grad", "degF": "℉ fahrenheit",
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
#: Numbers in words, as remarks have them beside a unit, by language.
NUMBER_WORDS = {
    "en": "one two three four five six seven eight nine ten twelve twenty",
    "de": "ein eins zwei drei vier fünf sechs sieben acht neun zehn zwölf zwanzig",
    "fr": "un deux trois quatre cinq sept huit neuf dix douze vingt",
    "it": "uno due tre quattro cinque sei sette otto nove dieci venti",
    "es": "dos tres cuatro cinco seis siete ocho nueve diez veinte", "pt": "dois três quatro sete oito dez",
    "nl": "een twee drie vijf zes zeven acht negen tien", "sv": "två tre fyra fem sex sju åtta nio tio",
    "pl": "dwa trzy cztery pięć sześć", "cs": "dva tři čtyři pět šest",
    "ru": "два три четыре пять шесть семь восемь девять десять", "tr": "iki üç dört beş altı",
}  # fmt: skip
#: Words that a number stands for no reading, folded, parted by blanks.
NO_READING = (
    "missing lost invalid error fault faulty dropout dropouts overload failed failure unavailable nodata gap "
    "fehlend fehlende fehlt fehlerhaft fehler ungultig "
    "ungultige ausfall sensorausfall messausfall ausgefallen "
    "manquant manquante manquantes perdu perdue invalide erreur "
    "mancante mancanti perso errore assente non_valido "
    "faltante faltantes perdido invalido ausente falha blad "
    "brakujace chybi chyba ontbreekt ongeldig fout saknas "
    "ogiltig puuttuu virhe eksik gecersiz hata пропуск ошибка потеря 欠測 无效 缺失 결측"
)
