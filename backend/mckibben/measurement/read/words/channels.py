"""Words of laboratories for the channels, by language."""

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
