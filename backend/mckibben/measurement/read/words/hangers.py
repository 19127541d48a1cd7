"""Words for what carries the weights on a muscle, folded, parted by blanks."""

from __future__ import annotations

#: What hangs on the muscle besides the weights that are put on it.
HANGER = (
    "hanger hangers holder carrier pan hook tray cradle "
    "basket clamp platform bucket rod carriage fixture adapter "
    "eyebolt shackle plate gehange haken aufhangung "
    "halter teller schale gewichtshalter gewichtsteller stange "
    "gestange schlitten plateau crochet supporto support piattello gancio portapesos portapesas plato gancho "
    "bandeja prato suporte szalka wieszak hak misa zaves haak schaal hallare krok vagskal ripustin koukku "
    "kanca aski подвес крюк чаша フック 皿 吊り 挂钩 托盘 걸이"
)
#: It comes on top of the weights.
MORE = (
    "plus add added additional additionally extra zuzuglich dazu hinzu zusatzlich excluding exclusive excl "
    "exklusive ajouter sus aggiungere escluso esclusa anadir "
    "sumar excluido somar adicionar bez exclusief lisaksi"
)
