"""Synthetic case results with known features, for the tests of the claims; no model is run."""

import numpy as np

from vocalis.studies.paper.evidence import ActivationMap, PcaSweep, StaticSeries, VoiceCycle

LEVELS = np.linspace(0.0, 1.0, 11)
X, Y = np.linspace(0.0, 1.0, 21), np.linspace(0.0, 1.0, 10)
LENGTH, THICKNESS = 16e-3, 5e-3
MM = 1e-3
REST = THICKNESS * np.tan(0.02)  # convergence of the medial plane over the thickness
HALF_SINE = np.sin(np.pi * X)
CT, TA = np.meshgrid(np.linspace(0.0, 1.0, 21), np.linspace(0.0, 1.0, 21), indexing="ij")
PHASES = np.arange(100) / 100


def medial(half_gap_m: float) -> np.ndarray:
    """Medial plane (nx, ny) that opens posteriorly by ``half_gap_m`` and converges by REST."""
    return half_gap_m * X[:, None] + REST * Y


def series(half_gap=lambda a: 0.0, superior=lambda a: 0.0 * X, lead=lambda a: 0.0 * X, length=lambda a: LENGTH):
    """Static shapes over LEVELS: functions of the activation give half the posterior gap, w at y = 0 (nx,), how far
    w at y = b leads it (nx,), all in m, and the length.
    """
    w = np.stack([superior(a)[:, None] + lead(a)[:, None] * Y for a in LEVELS])
    return StaticSeries(
        LEVELS,
        np.stack([length(a) * X for a in LEVELS]),
        np.stack([THICKNESS * Y for _ in LEVELS]),
        w,
        np.stack([superior(a) for a in LEVELS]),
        np.stack([medial(half_gap(a)) for a in LEVELS]),
    )


def voice_of(w, half_gap=0.0, state="periodic", flow=None, aerodynamic=None, contact=None, static=None, **measures):
    """A voice around the displacement of one cycle ``w`` (p, nx, ny), m; area follows from it, contact by a spring and
    a damper, air pressure 800 Pa while the area rises and 80 Pa while it falls.
    """
    G = medial(half_gap)
    gap = 2 * np.maximum(G - w, 0.0)
    area = np.trapezoid(gap.min(axis=-1), LENGTH * X, axis=1)
    rising = np.roll(area, -1) > np.roll(area, 1)
    overlap = np.maximum(w - G, 0.0)
    speed = (np.roll(w, -1, axis=0) - np.roll(w, 1, axis=0)) / 2
    spring = 1e6 * (overlap + 2.0 * speed * (overlap > 0.0))
    push = np.where(rising, 800.0, 80.0)[:, None, None] * np.ones_like(w)
    return VoiceCycle(
        state,
        f"State {state}.",
        state != "none",
        measures,
        LENGTH * X,
        THICKNESS * Y,
        G,
        0.05 * MM * HALF_SINE[:, None] + REST * Y if static is None else static,
        PHASES / 150,
        area,
        40 * np.roll(area, -6) if flow is None else flow(area),
        w,
        push if aerodynamic is None else aerodynamic(rising),
        spring if contact is None else contact(spring),
    )


def wave(lead=0.12, bias=0.1, amplitude=1.0, lowered=0.0, ahead=0.0):
    """A travelling wave (p, nx, ny), m: the inferior edge leads by ``lead`` of a cycle.

    ``lowered`` (ny,), mm, takes rows back from contact; ``ahead`` (ny,), of a cycle, lets them go first.
    """
    swing = -np.cos(2 * np.pi * (PHASES[:, None] + lead * Y + ahead))
    return MM * HALF_SINE[:, None] * (amplitude * swing + bias - lowered)[:, None, :] + REST * Y


def channel(convergent: float, divergent: float) -> np.ndarray:
    """Displacement (p, nx, ny) of a cycle whose inlet is the wider for the first ``convergent`` of the opening and the
    narrower for the last ``divergent`` of the closing; the area opens at phase 0.25 and closes at 0.75.
    """
    gap = np.maximum(-np.cos(2 * np.pi * PHASES), 0.0)
    opening, closing = (PHASES - 0.25) / 0.25, (PHASES - 0.5) / 0.25
    wider = np.where(PHASES < 0.5, opening <= convergent, closing < 1.0 - divergent)
    tilt = np.where(wider, 0.3, -0.3)[:, None] * (Y - 0.5)
    return -MM * HALF_SINE[:, None] * (gap[:, None] * (1.0 + tilt))[:, None, :] + REST * Y


def touching(places: list[float]):
    """Contact pressure (p, nx, ny), Pa, that sits at each x/L in turn, the same number of phases at each."""
    pressure = np.zeros((100, 21, 10))
    for phase, place in enumerate(np.repeat(places, 60 // len(places))):
        pressure[(phase + 20) % 100, round(place * 20), 5] = 2000.0
    return lambda _: pressure


def activation_map(state=None, **values) -> ActivationMap:
    """A map over CT and TA in steps of 0.05, periodic and loud unless said; measures not given are plain numbers."""
    plain = {
        "fo_hz": 145 + 75 * CT**0.7 - 5 * TA,
        "mean_flow_ml_s": 200 - 100 * TA + 10 * CT,
        "spl_lips_db": 130 + 0 * CT,
        "speed_quotient": 2 - CT,
        "closed_quotient": 0.3 + 0.3 * TA,
    }
    plain["ac_flow_ml_s"] = 1.4 * (plain | values)["mean_flow_ml_s"]
    state = np.full(CT.shape, "periodic", dtype="U11") if state is None else state
    return ActivationMap(CT[:, 0], TA[0], state, **(plain | values))


def states(where: np.ndarray, name: str) -> np.ndarray:
    """States (21, 21): ``name`` in the cells ``where``, periodic elsewhere."""
    return np.where(where, name, "periodic").astype("U11")


def sweep(pressure=None, place=None, state=None) -> PcaSweep:
    """A PCA sweep in steps of 0.05 from (pca, value) corners joined by straight lines."""
    pca = np.linspace(0.0, 1.0, 21)

    def curve(corners):
        return np.interp(pca, *np.array(corners).T)

    state = np.full(21, "periodic", dtype="U11") if state is None else state
    return PcaSweep(
        pca,
        state,
        curve(pressure or [(0, 3000), (0.2, 3150), (0.6, 2900), (1, 4500)]),
        curve(place or [(0, 0.5), (0.65, 0.5), (0.8, 0.3), (1, 0.45)]),
    )
