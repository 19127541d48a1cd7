"""Words with which texts say what counts positive, by language."""

from __future__ import annotations

#: What a sign is of, and the signs -> language -> words.
SIGNS = {
    "positive": {
        "en": "positive positively plus", "de": "positiv positive", "fr": "positif positive positivement",
        "it": "positivo positiva positivi", "es": "positivo positiva", "pt": "positivo positiva",
        "pl": "dodatni dodatnie dodatnia", "cs": "kladný kladná kladné kladně",
        "ru": "положительный положительное положительная положительно", "uk": "додатний додатне додатна",
        "nl": "positief positieve", "sv": "positiv positivt", "fi": "positiivinen", "hu": "pozitív",
        "ro": "pozitiv pozitivă", "tr": "pozitif artı", "el": "θετική θετικό",
        "hr": "pozitivno pozitivan pozitivna", "ja": "正 は正 が正 を正 プラス", "zh": "正 为正 為正",
        "ko": "양수 양의",
    },
    "negative": {
        "en": "negative negatively minus", "de": "negativ negative", "fr": "négatif négative",
        "it": "negativo negativa", "es": "negativo negativa", "pt": "negativo negativa",
        "pl": "ujemny ujemne ujemna", "cs": "záporný záporná záporné záporně",
        "ru": "отрицательный отрицательное отрицательная отрицательно", "uk": "від'ємний від'ємне",
        "nl": "negatief negatieve", "sv": "negativ negativt", "fi": "negatiivinen", "hu": "negatív",
        "ro": "negativ negativă", "tr": "negatif eksi", "el": "αρνητική αρνητικό",
        "hr": "negativno negativan negativna", "ja": "負 は負 が負 を負 マイナス", "zh": "负 为负 為負",
        "ko": "음수 음의",
    },
    "tension": {
        "en": "tension tensile pull pulling traction", "de": "zug zugkraft zugkräfte zugbelastung",
        "fr": "traction", "it": "trazione", "es": "tracción", "pt": "tração",
        "pl": "rozciąganie ciągnięcie", "cs": "tah tahu", "ru": "растяжение", "uk": "розтяг",
        "nl": "trek trekkracht", "sv": "drag dragkraft", "da": "træk", "fi": "veto", "hu": "húzás húzóerő",
        "ro": "tracțiune", "tr": "çekme", "hr": "vlak", "ja": "引張", "zh": "拉力 拉伸", "ko": "인장",
    },
    "compression": {
        "en": "compression compressive", "de": "druckkraft druckkräfte druckbelastung stauchung",
        "fr": "compression", "it": "compressione", "es": "compresión", "pt": "compressão",
        "pl": "ściskanie", "ru": "сжатие", "uk": "стиск", "nl": "drukkracht", "sv": "tryckkraft",
        "fi": "puristus", "hu": "nyomóerő", "ro": "compresiune", "tr": "basma", "ja": "圧縮", "zh": "压缩",
        "ko": "압축",
    },
    "extension": {
        "en": "extension elongation lengthening stretch stretching", "de": "verlängerung dehnung längung",
        "fr": "allongement", "it": "allungamento", "es": "alargamiento estiramiento", "pt": "alongamento",
        "ja": "伸び 伸長", "zh": "伸长", "ko": "신장",
    },
    "shortening": {
        "en": "shortening contraction contracting retraction", "de": "verkürzung kontraktion",
        "fr": "raccourcissement contraction", "it": "accorciamento contrazione",
        "es": "acortamiento contracción", "pt": "encurtamento contração",
        "pl": "skrócenie skracanie kontrakcja", "cs": "zkrácení kontrakce", "ru": "укорочение сокращение",
        "uk": "укорочення скорочення вкорочення", "nl": "verkorting contractie",
        "sv": "förkortning kontraktion", "da": "forkortning forkortelse",
        "fi": "lyhenemä lyheneminen supistuma", "hu": "rövidülés összehúzódás", "ro": "scurtare contracție",
        "tr": "kısalma kasılma", "el": "βράχυνση συστολή", "hr": "skraćenje kontrakcija", "ja": "収縮 短縮",
        "zh": "收缩 缩短", "ko": "수축 단축",
    },
    "longer": {
        "en": "longer lengthens extends elongates stretches stretched",
        "de": "länger verlängert gedehnt", "fr": "allonge allongé",
        "it": "allunga", "es": "alarga", "pt": "alonga", "pl": "wydłuża dłuższy", "cs": "prodlužuje delší",
        "ru": "удлиняется длиннее", "nl": "langer verlengt", "sv": "längre förlängs", "da": "længere",
        "fi": "pitenee", "tr": "uzar uzadığında", "ja": "伸びる", "zh": "变长",
    },
    "shorter": {
        "en": "shorter shortens contracts", "de": "kürzer verkürzt kontrahiert",
        "fr": "raccourcit", "it": "accorcia contrae", "es": "acorta contrae", "pt": "encurta contrai",
        "pl": "skraca krótszy", "cs": "zkracuje kratší", "ru": "укорачивается короче",
        "nl": "korter verkort", "sv": "kortare förkortas", "da": "kortere", "fi": "lyhenee",
        "tr": "kısalır kısaldığında", "ja": "縮む", "zh": "变短",
    },
}  # fmt: skip
