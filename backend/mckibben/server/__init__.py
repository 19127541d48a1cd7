"""The HTTP interface: thin routes (convert, call, convert), one JSON error shape, safe by default."""
