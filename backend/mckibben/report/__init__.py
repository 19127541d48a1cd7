"""Reports: self-contained HTML files with tables, formulas and drawings of what the caller has computed.

Values in, text out. `document.document` builds the page, `table`, `facts` and the like its parts; `chart`,
`stack`, `bars` and `heat` draw, `figures` formats numbers with units. Each kind of report has a package of
its own (`diagnosis`, `sizing`), whose `gather` collects the content.
"""
