"""One physical effect per file; the file name is the effect's id. The catalogue scans this folder."""
