"""The tables of docs/human.md and of the notebook's entry on the calibration, from the shipped documents."""

from collections.abc import Mapping, Sequence
from typing import Any

from vfcore.spec.larynx import CONSTANTS, PAPER_LARYNX
from vfcore.spec.variants import VARIANTS
from vocalis.studies.norms.report import calibration_rows, markdown, rows, summary
from vocalis.studies.paper.claims.registry import CLAIMS

_DASH = "–"


def tables(documents: Mapping[str, Mapping[str, Any]]) -> dict[str, str]:
    """The generated tables by the name of their marks; ``documents``: the shipped documents by name."""
    norms, claims, coupling = (documents[name] for name in ("norms", "claims", "coupling"))
    return {
        "norms": markdown(*rows(norms)),
        "in range": "\n".join(f"- {sentence}" for sentence in summary(norms)),
        "human constants": _constants("human"),
        "human_female constants": _constants("human_female", besides="human"),
        "claims": _claims(claims),
        "claims missed": _missed(claims),
        "fo over TA": _fo_over_ta(claims),
        "vowels": _vowels(coupling["pairs"]),
        "F1": _f1(coupling["fo_over_f1"]),
        "random": _random(coupling["random"]),
        "versions": _versions(documents),
    }


def calibration_tables(study: Mapping[str, Any]) -> dict[str, str]:
    """The generated tables of the calibration study by the name of their marks."""
    return {
        "calibration": markdown(*calibration_rows(study)),
        "calibration front": markdown(*calibration_rows(study, "front")),
        "calibration effects": _effects(study),
    }


def _table(header: Sequence[str], lines) -> str:
    return markdown(tuple(header), [tuple(map(str, line)) for line in lines])


def _constants(variant: str, besides: str | None = None) -> str:
    """The constants that a variant changes; with ``besides``, only those that differ from that variant."""
    meta = {name: constant.metadata for name, constant in CONSTANTS.items()}
    known = VARIANTS[besides].changes if besides else ()
    return _table(
        ("constant", "name", "the paper", variant, "unit", "why"),
        (
            (meta[c.name]["symbol"], f"`{c.name}`", f"{PAPER_LARYNX.value(c.name):.4g}", f"{c.value:.4g}",
             meta[c.name]["unit"], c.why)
            for c in VARIANTS[variant].changes if c not in known
        ),
    )  # fmt: skip


def _effects(study: Mapping[str, Any]) -> str:
    names = list(next(iter(study["effects"].values())))
    return _table(
        ("norm", *(f"`{name}`" for name in names)),
        ((key, *(f"{effect[name]:+.2f}" for name in names)) for key, effect in study["effects"].items()),
    )


def _claims(claims: Mapping[str, Any]) -> str:
    columns = claims["columns"]
    lines = [
        (key, CLAIMS[key].title, *(column["outcomes"][key]["verdict"] for column in columns.values()))
        for key in next(iter(columns.values()))["outcomes"]
    ]
    counts = (f"{c['score']['pass']} / {c['score']['deviation']} / {c['score']['fail']}" for c in columns.values())
    return _table(("", "claim", *columns), [*lines, ("", "pass / deviation / fail", *counts)])


def _missed(claims: Mapping[str, Any]) -> str:
    outcomes = claims["columns"]["human, two_way"]["outcomes"]
    return _table(
        ("", "verdict", "on `human`, two-way"),
        ((key, one["verdict"], one["sentence"]) for key, one in outcomes.items() if one["verdict"] != "pass"),
    )


def _fo_over_ta(claims: Mapping[str, Any]) -> str:
    found = claims["columns"]["human, two_way"]["fo_map"]
    shown = range(0, len(found["ta"]), 2)
    return _table(
        ("CT", *(f"TA {found['ta'][k]:g}" for k in shown)),
        ((ct, *(_DASH if line[k] is None else f"{line[k]:.0f}" for k in shown)) for ct, line in found["rows"].items()),
    )


def _vowels(pairs: Sequence[Mapping[str, Any]]) -> str:
    lines = []
    for pair in pairs:
        for way in ("one_way", "two_way"):
            e = pair[way]
            numbers = (
                (e["fo_hz"], 1),
                (e["skew"], 2),
                (e["ac_flow_ml_s"], 0),
                (e["mfdr_l_s2"], 0),
                (e["peak_area_mm2"], 1),
                (e["spl_30cm_db"], 1),
            )
            cells = (_DASH if v is None else f"{v:.{digits}f}" for v, digits in numbers)
            lines.append((pair["variant"], f"/{pair['vowel']}/", way, e["state"], *cells))
    return _table(
        ("variant", "vowel", "coupling", "state", "f_o, Hz", "flow peak after area peak, cycles", "AC flow, mL/s",
         "MFDR, L/s²", "peak area, mm²", "SPL at 30 cm, dB"),
        lines,
    )  # fmt: skip


def _f1(found: Sequence[Mapping[str, float]]) -> str:
    return _table(
        ("F1, Hz", "f_o, Hz", "F1 / f_o"),
        ((f"{r['f1_hz']:.0f}", f"{r['fo_hz']:.1f}", f"{r['f1_hz'] / r['fo_hz']:.2f}") for r in found),
    )


def _random(found: Mapping[str, Any]) -> str:
    lines = []
    for variant, one in found.items():
        outcomes = ", ".join(f"{state} {count}" for state, count in one["outcomes"].items())
        moved = [f"{a:.1e} / {b:.1e}" for a, b in (one["fo_moved"], one["area_moved"])]
        lines.append((variant, one["voices"], outcomes, one["halved"], *moved))
    return _table(
        ("variant", "voices", "outcomes", "repeated at half the step", "f_o moved by, median / 90 %",
         "peak area moved by, median / 90 %"),
        lines,
    )  # fmt: skip


def _versions(documents: Mapping[str, Mapping[str, Any]]) -> str:
    return "\n".join(
        f"- {name}: model {document['provenance']['model_version']}, {document['provenance']['created'][:10]}"
        for name, document in documents.items()
    )
