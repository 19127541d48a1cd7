"""What a model leaves: where it fails, how much of that is noise, and the structure in the rest."""
