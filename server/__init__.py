"""The HTTP server of Vocalis: the page, the synchronous calls and the job API.

The linear systems of a request are small, and several requests share the cores: BLAS's own threads would only wait for
each other. (On a busy machine of two cores a static shape of 100×50 nodes takes 0.09 s with one thread and 0.5 to
4 s with two.) The setting counts when numpy is loaded after this package; worker processes inherit it.
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
