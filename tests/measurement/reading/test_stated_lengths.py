"""Rest lengths in the words of other laboratories, and lengths that are none."""

from __future__ import annotations

WHOLE = {
    "length 400 mm between fittings": "400 mm",
    "active length: 280 mm": "280 mm",
    "8.27 in from clamp to clamp at zero pressure": "8.27 in",
    "clamp-to-clamp distance is 31 cm": "31 cm",
    "muscle 300 mm between fittings, 20 mm bore": "300 mm",
    "L_active = 0.3 m": "0.3 m",
    "wirksame Länge: 300 mm": "300 mm",
    "Länge 250 mm zwischen den Armaturen": "250 mm",
    "longueur utile 250 mm": "250 mm",
    "lunghezza tra i raccordi 300 mm": "300 mm",
    "comprimento entre terminais 400 mm": "400 mm",
    "długość czynna 250 mm": "250 mm",
    "длина 420 мм между заделками": "420 mm",
    "有効長 250 mm": "250 mm",
    "유효 길이 300 mm": "300 mm",
}
