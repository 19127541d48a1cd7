"""A drive through time: its parts, where it rests, runs under a command, a controller or measured inputs."""
