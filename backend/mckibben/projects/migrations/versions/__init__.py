"""One module for each state of the database; each knows the one before it."""
