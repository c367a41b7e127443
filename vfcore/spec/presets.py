"""Presets: voices to start from, each with a name, a sentence on what to look for, and a request."""

from typing import Any, NamedTuple


class Preset(NamedTuple):
    """``request`` holds only what differs from the default request."""

    key: str
    label: str
    look_for: str
    request: dict[str, Any]


def _muscles(lca: float, ia: float, pca: float, ct: float, ta: float) -> dict[str, Any]:
    return {"activation": {"lca": lca, "ia": ia, "pca": pca, "ct": ct, "ta": ta}}


PRESETS = (
    Preset(
        "modal", "Modal voice",
        "The folds meet along their whole length and close for about half of every cycle.",
        _muscles(0.8, 0.8, 0.0, 0.3, 0.4),
    ),
    Preset(
        "breathy", "Breathy: posterior gap",
        "PCA pulls the vocal processes apart: a gap stays open at the back and flow never stops.",
        _muscles(0.8, 0.8, 0.5, 0.3, 0.4),
    ),
    Preset(
        "pressed", "Pressed",
        "Strong TA bulges the folds against each other; with the paper's constants: less flow, more time closed.",
        _muscles(1.0, 1.0, 0.0, 0.3, 0.6),
    ),
    Preset(
        "bowed", "Bowed: anterior opening",
        "Without TA the folds are not bulged: they meet at the back and stay apart in front.",
        _muscles(1.0, 1.0, 0.0, 0.1, 0.0),
    ),
    Preset(
        "high_pitch", "High pitch by CT",
        "CT stretches and tenses the folds: longer, straighter, faster.",
        _muscles(0.8, 0.8, 0.0, 1.0, 0.1),
    ),
    Preset(
        "ta_shortening", "TA shortening",
        "Strong TA against little CT shortens the folds by 1.5 mm and slackens the cover: pitch falls.",
        _muscles(0.6, 0.6, 0.0, 0.2, 0.7),
    ),
    Preset(
        "pca_abduction", "PCA abduction",
        "PCA overcomes weak closers: a V of 9 mm at the back, much flow, no vibration at normal pressure.",
        _muscles(0.4, 0.4, 1.0, 0.3, 0.4),
    ),
    Preset(
        "no_phonation", "No phonation",
        "Low pressure over folds held wide apart: nothing vibrates, only air flows.",
        _muscles(0.2, 0.2, 1.0, 0.1, 0.0) | {"subglottal_pressure_pa": 300.0},
    ),
)  # fmt: skip
