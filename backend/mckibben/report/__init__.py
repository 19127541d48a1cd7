"""Reports: self-contained HTML files with tables, formulas and drawings of what the caller has computed.

Pure text in, text out: no model, no request, no file. `document.document` is the frame, `table`, `facts` and
the like are its parts, `chart`, `stack`, `bars` and `heat` draw, `figures` writes numbers with units. What a
report of one kind says stands in a package of its own (`diagnosis`, `sizing`).
"""
