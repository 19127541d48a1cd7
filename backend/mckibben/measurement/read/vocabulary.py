"""Words of table heads and preambles in eight languages of Europe and Japan.

Words are compared without case and accents. A word of four letters or "
"more also counts as the beginning or
end of a longer one, as German builds them ("Muskeldruck", "
""Wegaufnehmer"); a shorter one as its end only.
"""

from __future__ import annotations

import re
import unicodedata
from functools import lru_cache


def word_set(text: str) -> frozenset[str]:
    """The words of a text, parted by blanks."""
    return frozenset(text.split())


_CHANNEL_TEXTS = {
    "time": "time zeit sekunden seconds temps tiempo tempo timestamp uhrzeit "
    "heure hora ora clock elapsed "
    "dauer czas czasu hora zaman 時刻 時間 経過時間 日時",
    "pressure": "pressure druck pression presion pressione press cisnienie "
    "cisnienia nadcisnienie pressao 圧力 ゲージ圧 内圧 空気圧",
    "force": "force kraft effort forza fuerza load last charge carga carico "
    "weight gewicht tension traction sila sily forca tracao 荷重 力 張力 引張力 発生力",
    "length": "length laenge lange longueur longitud lunghezza dlugosc dlugosci comprimento 長さ 全長",
    "displacement": "displacement displ disp weg hub stroke course corsa "
    "carrera verschiebung deplacement "
    "desplazamiento spostamento position posicion posizione travel verkuerzung verkurzung "
    "raccourcissement accorciamento acortamiento shortening auslenkung "
    "verfahrweg skrocenie przemieszczenie skok encurtamento deslocamento curso 変位 "
    "収縮量 縮み ストローク",
    "extension": "extension elongation langenanderung dehnung verlaengerung verlangerung allongement "
    "allungamento alargamiento wydluzenie alongamento 伸び",
    "contraction": "contraction kontraktion contrazione contraccion strain "
    "kappa eps epsilon kontrakcja contracao 収縮率 ひずみ",
    "diameter": "diameter durchmesser diametre diametro srednica 直径 外径",
    "velocity": "velocity speed geschwindigkeit vitesse velocidad velocita predkosc velocidade 速度",
    "command": "command ventil valve stellgroesse stellgrosse comando vanne valvola",
    "temperature": "temperature temperatur temperatura temp 温度",
    "group": "cycle zyklus ciclo versuch essai prova lauf sweep",
}
#: Channel -> words for it.
CHANNEL_WORDS = {channel: tuple(words.split()) for channel, words in _CHANNEL_TEXTS.items()}
#: Letters that stand for a channel where their unit agrees.
LETTERS = {
    "t": "time", "p": "pressure", "f": "force", "l": "length", "x": "displacement", "s": "displacement",
    "d": "diameter", "v": "velocity", "u": "command",
}  # fmt: skip

#: Words that make a column something else -> what it is.
OTHER_QUANTITIES = {
    word: reason
    for reason, words in {
        "a set value": "set setpoint soll sollwert target desired demand demanded consigne consigna "
        "riferimento fuehrung reference ref",
        "the supply": "zasilanie zasilania alimentacao 供給圧 supply versorgung "
        "versorgungs speise vordruck alimentation alimentazione "
        "alimentacion line tank reservoir kessel inlet source",
        "the surrounding air": "otoczenia otoczenie ambiente 大気圧 ambient umgebung "
        "umgebungs atmosphere atmospheric baro barometer luftdruck",
        "a length at rest": "rest ruhe ruhelaenge ruhelange initial anfang anfangs "
        "nominal nenn nennlange l0 "
        "spoczynkowa poczatkowa inicial repouso 自然長 初期長",
        "a preload": "vorkraft preload vorlast precarga precarico precharge",
        "a deviation": "dev stdev error fehler vs versus std sigma residual abweichung rms",
        "a size of the tube": "inside inner innen outside outer aussen wall bore",
    }.items()
    for word in words.split()
}
#: These leave a pressure or a time what it is, but not a diameter.
_ONLY_OF_DIAMETERS = word_set("inside inner innen outside outer aussen wall bore")
#: A column with one of these is wanted less than one without.
LESS_WANTED = {
    **dict.fromkeys(word_set("raw roh brut grezzo crudo adc counts digits uncalibrated unkalibriert"), 3),
    **dict.fromkeys(
        word_set("filtered gefiltert smoothed geglaettet filtre filtrato filtrado mean mittel"), 2
    ),
}
#: Words for a running number, a remark: columns of these names are no channel.
NO_CHANNEL = {
    **dict.fromkeys(
        word_set("nr no number nummer lfd index idx punkt point id scan sample zeile row row# n i #"),
        "a running number",
    ),
    **dict.fromkeys(
        word_set(
            "bemerkung remark remarks comment comments note notes kommentar remarque observaciones "
            "osservazioni nota anmerkung status state flag"
        ),
        "a remark",
    ),
}
#: Words before a force or mass that is not the load of the muscle.
LOADLESS = word_set(
    "preload vorkraft vorlast max maximum maximal cell zelle capacity grenze limit range pre sensor moving"
)
#: Words with which the statistics below a table begin.
STATISTICS = word_set(
    "mean mittel mittelwert average avg moyenne media promedio durchschnitt "
    "max maximum maxi min minimum "
    "mini std stdev stdabw sigma sd sum summe total totale somme suma count "
    "anzahl median range spannweite "
    "end ende fin fine statistics statistik"
)


def folded(text: str) -> str:
    """Lower case without accents; ``ß`` as ``ss``.

    >>> folded("Prüfzeit")
    'prufzeit'
    """
    plain = unicodedata.normalize("NFKD", text.casefold().replace("ł", "l"))
    bare = "".join(character for character in plain if not unicodedata.combining(character))
    return bare if bare.isascii() else unicodedata.normalize("NFC", bare)


def words_of(text: str) -> list[str]:
    """The words of a name, folded: parted at blanks, signs, and where small letters turn into capitals.

    >>> words_of("AI 1/MuscleForce_N")
    ['ai', '1', 'muscle', 'force', 'n']
    """
    spaced = re.sub(r"(?<=[a-zäöüß])(?=[A-ZÄÖÜ])", " ", text)
    return [folded(word) for word in re.findall(r"[^\W_]+|#", spaced)]


@lru_cache(maxsize=4096)
def channel_of_word(word: str) -> str | None:
    """The channel that a folded word stands for, alone or as a part of it."""
    for channel, stems in CHANNEL_WORDS.items():
        if word in stems:
            return channel
    best, length = None, 0
    for channel, stems in CHANNEL_WORDS.items():
        for stem in stems:
            long_enough = len(stem) >= 5 or (len(stem) >= 3 and stem in _COMPOUNDS)
            if long_enough and len(stem) > length and (word.startswith(stem) or word.endswith(stem)):
                # The last part of a compound says what it is: a "Kraftweg" is a distance.
                best, length = channel, len(stem)
    return best


#: Short words that German compounds are made of.
_COMPOUNDS = word_set("zeit weg hub last")


@lru_cache(maxsize=4096)
def other_quantity(word: str, channel: str | None) -> str | None:
    """What a folded word makes of a column, where that is not the channel itself."""
    if word in OTHER_QUANTITIES:
        reason = OTHER_QUANTITIES[word]
        return None if word in _ONLY_OF_DIAMETERS and channel not in (None, "diameter") else reason
    if channel is None:
        return None
    for part, reason in OTHER_QUANTITIES.items():
        if part in _ONLY_OF_DIAMETERS and channel != "diameter":
            continue
        if len(part) >= 4 and word.startswith(part) and word != part:
            rest = word[len(part) :]
            if channel_of_word(rest) or channel_of_word(rest.lstrip("s")):
                return reason
    return None
