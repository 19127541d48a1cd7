"""The parts of an FMU: variables, description, generated and fixed C, compilers."""
