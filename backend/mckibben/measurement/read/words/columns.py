"""Words for columns and rows beside the readings, and for the way of the muscle, by language."""

from __future__ import annotations

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
