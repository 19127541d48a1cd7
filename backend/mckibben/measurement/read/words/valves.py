"""Words for the states of a valve that a text gives voltages for, by language."""

from __future__ import annotations

#: State of a valve -> language -> words, beside those for the ways of the muscle.
VALVES = {
    "closed": {
        "en": "closed close shut neutral middle mid centre center zero blocked stop",
        "de": "zu geschlossen neutral mitte mittelstellung gesperrt", "fr": "fermé fermée neutre milieu",
        "it": "chiusa chiuso neutra centro", "es": "cerrada cerrado neutro centro",
        "pt": "fechada fechado neutro", "pl": "zamknięty zamknięta neutralne",
        "cs": "zavřeno zavřený uzavřeno střed", "sk": "zatvorený", "ru": "закрыт закрыто нейтраль",
        "uk": "закрито закритий", "nl": "dicht gesloten midden", "sv": "stängd mitten", "da": "lukket midt",
        "fi": "kiinni suljettu keskiasento", "hu": "zárt zárva közép", "ro": "închis închisă neutru",
        "tr": "kapalı orta nötr", "el": "κλειστή κλειστό", "hr": "zatvoreno zatvoren sredina",
        "sl": "zaprto zaprt", "ja": "閉 中立 中央", "zh": "关 关闭 中位", "ko": "닫힘 중립",
    },
    "open": {
        "en": "open opened fully full supply", "de": "offen auf geöffnet voll", "fr": "ouvert ouverte",
        "it": "aperta aperto", "es": "abierta abierto", "pt": "aberta aberto", "pl": "otwarty otwarta",
        "cs": "otevřeno otevřený", "sk": "otvorený", "ru": "открыт открыто", "uk": "відкрито відкритий",
        "nl": "open", "sv": "öppen", "da": "åben", "fi": "auki", "hu": "nyitva nyitott",
        "ro": "deschis deschisă", "tr": "açık", "el": "ανοιχτή", "hr": "otvoreno otvoren",
        "sl": "odprto odprt", "ja": "開 全開", "zh": "开 全开", "ko": "열림",
    },
    "exhaust": {
        "en": "exhausting bleed dump", "fr": "purge", "it": "scarico", "es": "escape", "pt": "exaustão",
        "nl": "afblazen", "fi": "purku", "ja": "排出",
    },
}  # fmt: skip

#: Words for a command that name no valve, by language.
COMMANDED = {
    "en": "command", "de": "stellgröße stellgroesse stellsignal befehl", "fr": "commande", "es": "comando",
    "nl": "stuursignaal", "sv": "styrsignal", "da": "styresignal", "fi": "ohjaus", "hr": "upravljanje",
}  # fmt: skip

#: Words with which a text says that a pressure was measured, not set, by language.
MEASURED = {
    "en": "measured outlet output downstream behind sensor transducer transmitter actual",
    "de": "gemessen gemessene ausgang auslass hinter sensor aufnehmer druckaufnehmer istdruck istwert",
    "fr": "mesurée mesuré sortie aval capteur", "it": "misurata misurato uscita valle sensore trasduttore",
    "es": "medida medido salida sensor transductor", "pt": "medida medido saída sensor transdutor",
    "pl": "zmierzone wyjście wyjściu czujnik", "cs": "měřený výstup výstupu snímač",
    "ru": "измеренное выход выходе датчик", "tr": "ölçülen çıkış çıkışı sensör",
    "nl": "gemeten uitgang sensor opnemer", "sv": "uppmätt utlopp utgång givare",
    "ja": "実測 測定 出口 センサ", "zh": "实测 测量 出口 传感器", "ko": "실측 측정 출구 센서",
}  # fmt: skip
