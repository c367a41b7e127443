"""What the page draws of a played voice: the waves of the blocks since the last picture, and the folds, as text."""

import math

import numpy as np
import orjson

from vfcore.runs.gesture.contours import level_db
from vfcore.runs.gesture.voice import BLOCK_S, BLOCK_STEPS, Block

STATE_EVERY = 8  # blocks: 12 pictures a second; a screen beside a played voice has no time for more
WAVE_EVERY = 10  # samples: 2.8 kHz is enough for a line on a screen
WAVE_RATE_HZ = BLOCK_STEPS / WAVE_EVERY / BLOCK_S
#: Of what is drawn: 1 µm; 0.01 mm² and 0.01 ml/s.
LENGTH_DECIMALS, WAVE_DECIMALS = 6, 2
EDGES = ("x_m", "superior_m", "inferior_m", "medial_superior_m", "medial_inferior_m")
WAVES = ("area_mm2", "flow_ml_s")


class Shown:
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
        """Glottal area, (samples,), m², of the blocks that were taken."""
        return self._area[: self._count].reshape(-1)

    def text(self, said: dict, x_m: np.ndarray, w_m: np.ndarray, medial_m: np.ndarray) -> str:
        """A picture as JSON: ``said``, the waves, and the folds at ``x_m`` (nx,): displacement and medial plane, both
        (ny, nx), at their edges."""
        said["spl_lips_db"] = rounded(level_db(self._lip[: self._count].reshape(-1)))
        said["wave_rate_hz"] = WAVE_RATE_HZ
        edges = np.round((x_m, w_m[0], w_m[-1], medial_m[0], medial_m[-1]), LENGTH_DECIMALS)
        waves = 1e6 * np.array((self.area_m2[::WAVE_EVERY], self._flow[: self._count].reshape(-1)))
        said |= zip((*EDGES, *WAVES), (*edges, *np.round(waves, WAVE_DECIMALS)), strict=True)
        return orjson.dumps(said, option=orjson.OPT_SERIALIZE_NUMPY).decode()


def rounded(value: float) -> float | None:
    """To two decimals; None, which JSON has, for what is no number."""
    return round(value, 2) if math.isfinite(value) else None
