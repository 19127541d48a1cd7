"""The HTTP interface: thin routes that only convert, one JSON form of errors, secure defaults."""
