"""What the page draws of a played voice: the waves of the blocks since the last picture, and the folds, as text."""

import math

import numpy as np

from vfcore.document import json_text
from vfcore.gesture.contours import level_db
from vfcore.gesture.voice import BLOCK_S, BLOCK_STEPS, Block
from vfcore.kernels.decimals import ROOM, write_decimals

STATE_EVERY = 8  # blocks: 12 pictures a second; a screen beside a played voice has no time for more
WAVE_EVERY = 14  # samples: 2.5 kHz is enough for a line on a screen
#: Factor and decimals of what is drawn: 1 µm, 0.01 mm², 0.1 ml/s.
LENGTH, AREA, FLOW = (1.0, 6), (1e6, 2), (1e6, 1)


class Shown:
    """Gathers the waves of at most STATE_EVERY blocks."""

    def __init__(self) -> None:
        self._area, self._lip = (np.zeros((STATE_EVERY, BLOCK_STEPS)) for _ in range(2))
        self._flow = np.zeros((STATE_EVERY, BLOCK_STEPS // WAVE_EVERY))
        self._text = np.empty(0, np.uint8)
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
        level = level_db(self._lip[: self._count].reshape(-1))
        said = said | {
            "spl_lips_db": round(level, 2) if math.isfinite(level) else None,
            "wave_rate_hz": BLOCK_STEPS / WAVE_EVERY / BLOCK_S,
        }
        drawn = {
            "x_m": self._list(x_m, *LENGTH),
            "superior_m": self._list(w_m[0], *LENGTH),
            "inferior_m": self._list(w_m[-1], *LENGTH),
            "medial_superior_m": self._list(medial_m[0], *LENGTH),
            "medial_inferior_m": self._list(medial_m[-1], *LENGTH),
            "area_mm2": self._list(self.area_m2[::WAVE_EVERY], *AREA),
            "flow_ml_s": self._list(self._flow[: self._count].reshape(-1), *FLOW),
        }
        return json_text(said)[:-1] + "".join(f', "{name}": {numbers}' for name, numbers in drawn.items()) + "}"

    def _list(self, values: np.ndarray, factor: float, decimals: int) -> str:
        if len(self._text) < len(values) * ROOM + 2:
            self._text = np.empty(len(values) * ROOM + 2, np.uint8)
        return self._text[: write_decimals(values, factor, decimals, self._text)].tobytes().decode("ascii")
