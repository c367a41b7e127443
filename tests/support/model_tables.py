"""The tables of docs/model/, docs/reference/ and docs/validation.md that are generated, between markers in the files.

    python -m tests.support.model_tables                  name the tables that are out of date
    python -m tests.support.model_tables --write          rewrite them
    python -m tests.support.model_tables --write --runs   and those that need simulations (under a minute)

A block begins with ``<!-- table: name -->`` and ends with ``<!-- end -->``.
"""

import argparse
import dataclasses
import re
from importlib import import_module
from pathlib import Path

from tests.support.model_numbers import NUMBERS
from vfcore.fold.constants import FoldConstants
from vfcore.fold.stability import longest_stable_step_s, time_step_s
from vfcore.measures.catalogue import CATALOGUE
from vfcore.runs.setup import prepare
from vfcore.spec.joints import JointConstants
from vfcore.spec.lesions import KINDS, LesionKind
from vfcore.spec.muscles import Muscle
from vfcore.spec.posture_sets import POSTURE_SETS, posture_set
from vfcore.spec.simulation import DEFAULT_STEP_S, Run, Simulation

DOCS = Path(__file__).resolve().parents[2] / "docs"
#: The page of every table.
PAGES = {
    DOCS / "model" / "choices.md": ("variants", "stretch"),
    DOCS / "model" / "numerics.md": ("steps", "time steps", "grid", "separation"),
    DOCS / "reference" / "constants.md": ("constants", "joints", "muscles", "posture sets", "sources"),
    DOCS / "reference" / "lesions.md": ("lesions",),
    DOCS / "reference" / "measures.md": ("measures", "closed"),
    DOCS / "reference" / "numbers.md": ("numbers",),
    DOCS / "validation.md": ("modal", "shapes", "pca", "pressures", "damping"),
}
GRIDS = ((20, 10), (40, 10), (80, 10), (20, 20), (20, 40))
ROWS = {"ta": "TA", "ct": "CT", "lca": "LCA", "ia": "IA", "pca": "PCA", "lig": "ligament", "muc": "mucosa"}


def table(header: tuple[str, ...], rows) -> str:
    """A GitHub table; bars inside cells are escaped."""
    lines = [header, ("---",) * len(header), *rows]
    return "\n".join("| " + " | ".join(str(cell).replace("|", "\\|") for cell in line) + " |" for line in lines)


def number(value) -> str:
    """A number as short as its digits allow, 5e-6 rather than 5e-06."""
    return re.sub(r"e([+-])0*", lambda m: "e" + m[1].replace("+", ""), f"{value:.7g}") if value != "" else ""


def block(text: str, name: str) -> str:
    """The text between the markers of one table."""
    return re.search(rf"<!-- table: {name} -->\n(.*?)\n<!-- end -->", text, re.DOTALL)[1]


def page_of(name: str) -> Path:
    """The page that holds a table."""
    return next(page for page, names in PAGES.items() if name in names)


def measures() -> str:
    rows = (
        (
            f"`{m['key']}`",
            m["symbol"],
            m["unit"],
            f"{m['definition']} `{m['formula']}`",
            m["threshold"] or "–",
            m["needs"],
            ", ".join(f"`{name}`" for name in m["signals"]),
            m["source"],
        )
        for m in CATALOGUE.as_rows()
    )
    head = ("key", "symbol", "unit", "definition and formula", "threshold", "given for", "signals", "source")
    return table(head, rows)


def _constants(kind) -> str:
    rows = (
        (
            f.metadata["symbol"],
            f.metadata["label"],
            f"`{f.name}`",
            number(f.default),
            f.metadata["unit"],
            f"{number(f.metadata['low'])} to {number(f.metadata['high'])}",
            "both" if f.metadata["common"] else "each",
            f.metadata["source"],
        )
        for f in dataclasses.fields(kind)
    )
    return table(("symbol", "meaning", "name", "value", "unit", "accepted", "side", "source"), rows)


def lesions() -> str:
    """The numbers that each kind of lesion brings, and why."""
    names = [f.name for f in dataclasses.fields(LesionKind) if f.name not in ("label", "why")]
    rows = ((f"`{key}`", *(number(getattr(kind, name)) for name in names), kind.why) for key, kind in KINDS.items())
    return table(("kind", *(f"`{name}`" for name in names), "why"), rows)


def muscles() -> str:
    """Every column of the default set, one muscle or tissue per column of the table."""
    constants = posture_set("serry2026")
    rows = (
        (
            f.metadata["symbol"],
            f.metadata["label"],
            f"`…_{f.name}`",
            f.metadata["unit"],
            *(number(getattr(getattr(constants, key), f.name)) for key in ROWS),
        )
        for f in dataclasses.fields(Muscle)
    )
    return table(("symbol", "meaning", "name", "unit", *ROWS.values()), rows)


def posture_sets() -> str:
    """The differences of the other sets from the default set."""
    default = posture_set("serry2026")
    rows = []
    for name in list(POSTURE_SETS)[1:]:
        constants = posture_set(name)
        for f in dataclasses.fields(Muscle):
            own = {key: getattr(getattr(constants, key), f.name) for key in ROWS}
            if any(own[key] != getattr(getattr(default, key), f.name) for key in ROWS):
                rows.append((f"`{name}`", f.metadata["symbol"], f.metadata["unit"], *map(number, own.values())))
    return table(("set", "symbol", "unit", *ROWS.values()), rows)


def sources() -> str:
    return table(
        ("set", "source"),
        ((f"`{name}`", row.source) for name, row in POSTURE_SETS.items()),
    )


def numbers() -> str:
    rows = (
        (f"`{name}`", f"`{module}`", number(getattr(import_module(module), name)), unit, meaning)
        for module, name, unit, meaning in NUMBERS
    )
    return table(("name", "module", "value", "unit", "what it does"), rows)


def steps() -> str:
    rows = []
    for nx, ny in GRIDS:
        run = Run(nx=nx, ny=ny)
        glottis = prepare(Simulation(run=run)).glottis
        limit, chosen = longest_stable_step_s(glottis), time_step_s(run, glottis)
        rows.append((f"{nx} × {ny}", f"{limit * 1e6:.2f}", f"{chosen * 1e6:.3f}", f"1/{DEFAULT_STEP_S / chosen:.0f}"))
    return table(("grid, $N_x × N_y$", "gate, µs", "step chosen, µs", "of the default"), rows)


TABLES = {
    "measures": measures,
    "constants": lambda: _constants(FoldConstants),
    "joints": lambda: _constants(JointConstants),
    "muscles": muscles,
    "posture sets": posture_sets,
    "sources": sources,
    "numbers": numbers,
    "lesions": lesions,
    "steps": steps,
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", action="store_true", help="rewrite the pages")
    parser.add_argument("--runs", action="store_true", help="also the tables that need simulations")
    wanted = parser.parse_args()
    makers = dict(TABLES)
    if wanted.runs:
        makers |= import_module("tests.support.model_runs").RUNS
    for page, names in PAGES.items():
        text = page.read_text(encoding="utf-8")
        for name in filter(makers.get, names):
            old, new = block(text, name), makers[name]()
            if old != new:
                print(f"{page.relative_to(DOCS.parent)}: {name} {'rewritten' if wanted.write else 'is out of date'}")
                text = text.replace(f"<!-- table: {name} -->\n{old}\n", f"<!-- table: {name} -->\n{new}\n")
        if wanted.write:
            page.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
