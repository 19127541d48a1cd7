"""Projects in a database: document, history, measurements and notes."""
