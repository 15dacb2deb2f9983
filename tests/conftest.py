"""What holds for all tests: one thread for linear algebra, and the same examples every time."""

import os

from hypothesis import settings

# the tests themselves share the cores, and matrices are small
for variable in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(variable, "1")

# HYPOTHESIS_PROFILE=explore looks for new examples
settings.register_profile("steady", derandomize=True)
settings.register_profile("explore", derandomize=False)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "steady"))
