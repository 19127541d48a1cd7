"""Words for the way a muscle goes, in cells and heads, by language."""

from __future__ import annotations

#: Words that say which way a muscle moves -> language -> words.
DIRECTIONS = {
    "shortening": {
        "en": (
            "up u p positive fill filling filled inflate inflating inflation inflated pressurize "
            "pressurizing pressurising pressurization shortening contracting contraction contract "
            "pressurise charging"
        ),
        "de": (
            "füllen befüllen verkürzen verkürzung kontraktion belüften belüftung druckaufbau "
            "aufpumpen druckbeaufschlagung"
        ),
        "fr": "gonflage gonflement gonfler remplissage contraction raccourcissement",
        "it": "gonfiaggio gonfia riempimento contrazione accorciamento",
        "es": "inflado inflar llenado contracción acortamiento presurización",
        "pt": "inflar inflação enchimento insuflação contração encurtamento pressurização",
        "pl": "napełnianie pompowanie skracanie", "cs": "plnění nafukování zkracování napouštění",
        "sk": "plnenie nafukovanie skracovanie", "hr": "punjenje napuhavanje skraćivanje",
        "sl": "polnjenje napihovanje krajšanje", "ru": "наполнение надув накачка накачивание сокращение",
        "uk": "наповнення накачування скорочення", "bg": "пълнене", "tr": "şişirme dolum doldurma kısalma",
        "nl": "vullen verkorten oppompen", "sv": "fyllning fyllning fylla uppblåsning förkortning",
        "da": "fyldning fylling oppumpning forkortning", "fi": "täyttö paineistus lyheneminen",
        "hu": "feltöltés töltés felfújás rövidülés", "ro": "umflare umplere contracție",
        "el": "πλήρωση φούσκωμα συστολή", "ja": "加圧 昇圧 給気 充填 収縮",
        "zh": "加压 充气 升压 收缩 充压 进气", "ko": "가압 충전 급기 수축 팽창가압",
    },
    "lengthening": {
        "en": (
            "down d n negative vent venting vented deflate deflating deflation deflated exhaust "
            "exhausting depressurize depressurizing depressurising depressurization lengthening "
            "extending extension elongation relaxing releasing discharging"
        ),
        "de": "entlüften entlüftung entleeren verlängern verlängerung druckabbau abbau ablassen",
        "fr": "dégonflage dégonflement dégonfler vidange échappement allongement",
        "it": "sgonfiaggio sgonfia scarico svuotamento allungamento",
        "es": "desinflado desinflar vaciado despresurización alargamiento",
        "pt": "desinflar esvaziamento despressurização alongamento",
        "pl": "opróżnianie odpowietrzanie wydłużanie",
        "cs": "vyprazdňování vypouštění odvzdušnění prodlužování vyfukování",
        "sk": "vyprázdňovanie vypúšťanie predlžovanie",
        "hr": "pražnjenje praznjenje ispuhivanje produljivanje", "sl": "praznjenje podaljševanje",
        "ru": "сброс стравливание спуск выпуск опорожнение удлинение",
        "uk": "спорожнення спускання видовження", "bg": "изпразване",
        "tr": "boşaltma tahliye söndürme uzama", "nl": "legen ontluchten leeglopen verlengen",
        "sv": "tömning tömma avluftning förlängning", "da": "tømning tømming udluftning forlængelse",
        "fi": "tyhjennys paineenpoisto piteneminen", "hu": "leeresztés ürítés leengedés",
        "ro": "dezumflare golire", "el": "εκκένωση ξεφούσκωμα επιμήκυνση", "ja": "減圧 排気 降圧 伸長",
        "zh": "减压 放气 降压 伸长 泄压 排气", "ko": "감압 배기 신장",
    },
}  # fmt: skip

#: Words that say which way the test goes; the readings tell what it does to the muscle.
MOVES = {
    "pressure rises": {
        "en": "increasing increase rising rise ascending",
        "de": "steigend aufwärts aufsteigend druckanstieg", "fr": "montée croissant croissante",
        "it": "salita crescente aumento", "es": "subida creciente aumento ascendente",
        "pt": "subida crescente", "pl": "rosnąco wzrost", "cs": "nahoru stoupání růst",
        "ru": "рост подъём повышение вверх", "uk": "зростання", "tr": "artan artış", "nl": "stijgend op",
        "sv": "upp stigande ökande", "da": "op stigende økende", "fi": "nouseva", "hu": "növekvő",
        "ro": "creștere crescător", "hr": "rastuće porast", "ja": "上昇 昇", "zh": "上升 升", "ko": "상승",
    },
    "pressure falls": {
        "en": "decreasing decrease falling fall descending", "de": "fallend abwärts absteigend druckabfall",
        "fr": "descente décroissant décroissante", "it": "discesa decrescente",
        "es": "bajada decreciente descendente", "pt": "descida decrescente", "pl": "malejąco spadek",
        "cs": "dolů klesání pokles", "ru": "снижение спад понижение вниз", "uk": "спадання",
        "tr": "azalan azalış", "nl": "dalend neer", "sv": "ner fallande minskande",
        "da": "ned faldende synkende", "fi": "laskeva", "hu": "csökkenő", "ro": "scădere descrescător",
        "hr": "padajuće pad", "ja": "下降", "zh": "下降", "ko": "하강",
    },
    "one way": {
        "en": "load loading loaded forward out outward there",
        "de": "hin hinweg hinlauf vorlauf belasten belastung auf", "fr": "aller charge chargement",
        "it": "andata carico", "es": "ida carga", "pt": "ida carga carregamento", "pl": "obciążanie tam",
        "cs": "tam zatěžování", "ru": "прямой туда нагружение нагрузка", "uk": "навантаження",
        "tr": "gidiş yükleme", "nl": "heen belasten", "sv": "fram belastning", "da": "frem belastning",
        "fi": "meno kuormitus", "hu": "oda terhelés", "ro": "dus încărcare", "hr": "opterećenje",
        "sk": "zaťažovanie", "ja": "往路 往 負荷 載荷", "zh": "加载 去程", "ko": "부하 왕로",
    },
    "other way": {
        "en": "unload unloading unloaded backward back return inward",
        "de": "rück rückweg rücklauf zurück entlasten entlastung ab", "fr": "retour décharge déchargement",
        "it": "ritorno scarico", "es": "vuelta descarga", "pt": "volta retorno descarga descarregamento",
        "pl": "odciążanie powrót", "cs": "zpět odlehčování", "ru": "обратный обратно разгрузка",
        "uk": "розвантаження", "tr": "dönüş boşaltma", "nl": "terug ontlasten", "sv": "tillbaka avlastning",
        "da": "tilbage aflastning avlastning", "fi": "paluu kuormituksen poisto",
        "hu": "vissza tehermentesítés", "ro": "întors descărcare", "hr": "rasterećenje",
        "sk": "odľahčovanie", "ja": "復路 復 除荷", "zh": "卸载 回程", "ko": "제하 복로",
    },
}  # fmt: skip

#: Those of "one way" on which the load grows, folded, parted by blanks.
LOADING = (
    "load loading loaded belasten belastung charge chargement carico carga carregamento obciazanie "
    "zatezovani нагружение нагрузка навантаження yukleme belastning kuormitus terheles incarcare opterecenje "
    "zatazovanie 負荷 載荷 加载 부하"
)

#: Words for a state in which the muscle does not move, by language.
HOLDS = {
    "en": "hold holding held dwell wait waiting pause rest idle settle settling steady",
    "de": "halten haltezeit pause warten ruhe", "fr": "maintien pause palier attente",
    "it": "mantenimento pausa attesa", "es": "mantener mantenimiento espera pausa",
    "pt": "manter espera pausa", "pl": "przerwa utrzymanie", "cs": "výdrž pauza", "nl": "wachten pauze",
    "sv": "vila paus", "da": "pause hold", "fi": "pito tauko", "hu": "tartás szünet",
    "ro": "menținere pauză", "ru": "выдержка пауза", "tr": "bekleme", "ja": "保持 待機",
    "zh": "保持 保压 等待", "ko": "유지 대기",
}  # fmt: skip
#: Heads of columns that name the phase of the test, by language.
PHASES = {
    "en": "phase stage step state branch segment", "de": "abschnitt schritt ast zustand", "fr": "étape",
    "it": "fase", "es": "fase etapa rama", "pt": "fase etapa", "pl": "faza etap", "cs": "fáze",
    "ru": "фаза этап", "tr": "faz evre", "nl": "fase", "sv": "fas", "da": "fase", "fi": "vaihe",
    "hu": "fázis", "ro": "fază etapă", "el": "φάση", "uk": "фаза етап", "hr": "faza",
    "ja": "工程 段階 過程", "zh": "阶段 过程", "ko": "단계 구간",
}  # fmt: skip

#: Words that tell the way there from the way back, in heads of columns of one quantity.
WAYS = {
    "en": (
        "up down loading unloading load unload inflation deflation inflating deflating forward "
        "backward return there back increasing decreasing rising falling filling venting "
        "pressurizing depressurizing pressurising depressurising loaded unloaded"
    ),
    "de": (
        "auf ab aufwärts abwärts hin rück hinweg rückweg belasten entlasten belastung entlastung "
        "füllen entlüften"
    ),
    "fr": "montée descente aller retour", "it": "salita discesa andata ritorno",
    "es": "subida bajada ida vuelta", "pt": "subida descida ida volta", "pl": "góra dół",
    "cs": "nahoru dolů tam zpět", "ru": "вверх вниз прямой обратный нагружение разгрузка",
    "tr": "gidiş dönüş artan azalan yükleme boşaltma", "nl": "heen terug op neer",
    "sv": "upp ner fram tillbaka", "ja": "加圧 減圧 往路 復路 昇圧 降圧 負荷 除荷 上昇 下降",
    "ko": "가압 감압 상승 하강 부하 제하",
    "zh": "加压 减压 升压 降压 充气 放气 上升 下降 加载 卸载 去程 回程",
}  # fmt: skip
