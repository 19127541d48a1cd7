"""Which effect is missing: search, twins, verdict, and the experiment that would decide."""
