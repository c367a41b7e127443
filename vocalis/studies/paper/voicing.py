"""Which cells of an activation map count as phonation: the paper's "physiologically relevant sustained oscillations".

The paper leaves the other cells blank and gives no criterion. Here a cell is voiced if

1. its phonation state is periodic or subharmonic: the vibration is sustained and repeats ("stable" in the paper);
2. its AC flow is at least half of its mean flow: normal men reach 1.4 times the mean (Holmberg, Hillman & Perkell
   1988), and less than half is breath with a ripple;
3. its SPL is within 20 dB of the median of the cells that pass 1: a hundredth of the radiated power at the same lung
   pressure is not the voice of the same speaker.

All other claims on the map use voiced cells only, like the maps of the paper. Claims on f_o exclude subharmonic cells
as well: their f_o is by definition the rate of the whole pattern, at most half the visible rate.
"""

import numpy as np

from vocalis.studies.paper.bands import Part, at_least
from vocalis.studies.paper.evidence import ActivationMap

STATES = ("periodic", "subharmonic")
MIN_AC_OVER_MEAN = 0.5
MAX_BELOW_MEDIAN_DB = 20.0
#: A trend is judged on at least this share of the map.
COVERED_GOOD, COVERED_FAIR = 0.5, 0.25


#: The part of a definition that all claims on the map share.
COVERAGE = f"On at least {COVERED_GOOD:.0%} of the map (deviation {COVERED_FAIR:.0%})."


def voiced(maps: ActivationMap) -> np.ndarray:
    """Mask (n, m) of the voiced cells."""
    lasting = np.isin(maps.state, STATES) & np.isfinite(maps.spl_lips_db)
    if not lasting.any():
        return lasting
    loud = maps.spl_lips_db >= np.median(maps.spl_lips_db[lasting]) - MAX_BELOW_MEDIAN_DB
    pulsing = maps.ac_flow_ml_s >= MIN_AC_OVER_MEAN * maps.mean_flow_ml_s
    return lasting & loud & pulsing  # comparisons with NaN are False


def seen(maps: ActivationMap, values: np.ndarray, states: tuple[str, ...] = STATES) -> np.ndarray:
    """``values`` (n, m) with NaN in the cells that are not voiced, or not in one of ``states``."""
    return np.where(voiced(maps) & np.isin(maps.state, states), values, np.nan)


def coverage_part(values: np.ndarray) -> Part:
    """The share of the map on which a claim is judged."""
    share = float(np.isfinite(values).mean())
    return Part(
        "judged cells",
        share,
        "of the map",
        f"judged on {share:.0%} of the map",
        at_least(share, COVERED_GOOD, COVERED_FAIR),
    )
