"""Many runs with varied quantities."""
