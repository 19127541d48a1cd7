"""Studies: many runs of one subject with varied quantities, and what their figures show.

A study knows its subject only as an `mckibben.studies.table.Evaluate`: a function from points to rows.
"""
