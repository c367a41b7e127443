"""What the page draws of a live voice, as JSON: the waves of the blocks since the last frame, and the folds."""

import math
from collections.abc import Iterator

import numpy as np
import orjson

from vfcore.runs.gesture.contours import level_db
from vfcore.runs.gesture.voice import BLOCK_S, BLOCK_STEPS, Block

STATE_EVERY = 8  # blocks: 12 frames a second; a page that also plays the voice has no time for more
WAVE_EVERY = 10  # samples: 2.8 kHz is enough for a line on a screen
WAVE_RATE_HZ = BLOCK_STEPS / WAVE_EVERY / BLOCK_S
#: Rounding of what is drawn: 1 µm; 0.01 mm² and 0.01 ml/s.
LENGTH_DECIMALS, WAVE_DECIMALS = 6, 2
EDGES = ("x_m", "superior_m", "inferior_m", "medial_superior_m", "medial_inferior_m")
WAVES = ("area_mm2", "flow_ml_s")


class StateFrame:
    """Gathers the waves of at most STATE_EVERY blocks."""

    def __init__(self) -> None:
        self._area, self._lip = (np.zeros((STATE_EVERY, BLOCK_STEPS)) for _ in range(2))
        self._flow = np.zeros((STATE_EVERY, BLOCK_STEPS // WAVE_EVERY))
        self._count = 0

    def clear(self) -> None:
        self._count = 0

    def take(self, block: Block) -> None:
        k = self._count
        self._area[k], self._lip[k] = block.record[:, 0], block.lip_pressure_pa
        self._flow[k] = block.record[::WAVE_EVERY, 1]
        self._count += 1

    @property
    def area_m2(self) -> np.ndarray:
        """Glottal area, (samples,), m², of the blocks taken since ``clear``."""
        return self._area[: self._count].reshape(-1)

    def text(self, state: dict, x_m: np.ndarray, w_m: np.ndarray, medial_m: np.ndarray) -> str:
        """A frame as JSON: ``state``, the waves, and the folds at ``x_m`` (walls, nx), m: displacement and medial
        plane, both (walls, ny, nx), m, at their edges. Of two different folds the right one is under ``right``.
        """
        state["spl_lips_db"] = rounded(level_db(self._lip[: self._count].reshape(-1)))
        state["wave_rate_hz"] = WAVE_RATE_HZ
        waves = 1e6 * np.array((self.area_m2[::WAVE_EVERY], self._flow[: self._count].reshape(-1)))
        state |= zip(WAVES, np.round(waves, WAVE_DECIMALS), strict=True)
        left, *others = (dict(zip(EDGES, one, strict=True)) for one in self._edges(x_m, w_m, medial_m))
        state |= left
        if others:
            state["right"] = others[0]
        return orjson.dumps(state, option=orjson.OPT_SERIALIZE_NUMPY).decode()

    @staticmethod
    def _edges(x_m: np.ndarray, w_m: np.ndarray, medial_m: np.ndarray) -> Iterator[np.ndarray]:
        """What EDGES names, (5, nx), of each wall."""
        for x, w, medial in zip(x_m, w_m, medial_m, strict=True):
            yield np.round((x, w[0], w[-1], medial[0], medial[-1]), LENGTH_DECIMALS)


def rounded(value: float) -> float | None:
    """Rounded to two decimals; None for NaN and infinity, which JSON does not have."""
    return round(value, 2) if math.isfinite(value) else None
