"""The tests. One thread of linear algebra: workers with more of them wait for one another."""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
