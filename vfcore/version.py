"""Two versions: of the code, and of the numbers it produces."""

from importlib.metadata import PackageNotFoundError, version

try:
    CODE_VERSION = version("vocalis")
except PackageNotFoundError:  # running from a source tree that was never installed
    CODE_VERSION = "0+source"

#: Bumped by hand whenever any stored result would change. The golden tests fail when
#: results change and this does not. Stored results are keyed by it.
MODEL_VERSION = "6"

#: Raised when the same computation gets another address, so that what is stored at an older one is not read.
#: 2: addresses hold every constant. Before, a number of a sweep that equalled the paper's was left out under every
#: variant, and rows of one voice could be kept at the address of another.
#: 3: both folds, the lesions and the stretch of the membrane are part of an address.
ADDRESS_VERSION = "3"
