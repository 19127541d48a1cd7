"""Projects, and what the user keeps."""
