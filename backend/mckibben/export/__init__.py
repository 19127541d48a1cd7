"""Models and drives as files for other programs: source code, tables, equations, documents.

A format is one file of ``formats/``; `mckibben.export.registry` finds it. What every format needs is prepared
once: `mckibben.export.subject` (the model, its identity and the source of every constant),
`static_equations` and `drive_equations` (the engine's own symbols, as named results of named arguments),
`code` (straight-line code in any language). The use case is `mckibben.export.use_case`. Nothing here holds a
formula of the physics.
"""
