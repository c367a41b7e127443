"""Rewrite the golden file: ``python -m tests.golden.regenerate --reason "why the results changed"``.

Refused without a reason, and if results differ from the file while MODEL_VERSION is the same as in the file: raise
MODEL_VERSION in vfcore/version.py first, so that stored results of different models are not mixed.
"""

import argparse
import json
import sys
from pathlib import Path

from tests.golden.cases import CASES, STORED, differences, read_stored, results_of
from vfcore.version import MODEL_VERSION


def regenerate(reason: str, path: Path = STORED, version: str = MODEL_VERSION) -> list[str]:
    """Write ``path``; returns one line per change. Raises SystemExit with a message when refused."""
    if not reason.strip():
        raise SystemExit('say why the results changed: --reason "..."')
    now = {name: {"request": document, "results": results_of(document)} for name, document in CASES.items()}
    changed = _changes(read_stored(path), now) if path.exists() else []
    if changed and read_stored(path)["model_version"] == version:
        raise SystemExit(
            "results changed, but MODEL_VERSION is still "
            f"{version!r}: raise it in vfcore/version.py first.\n  " + "\n  ".join(changed)
        )
    document = {"model_version": version, "reason": reason.strip(), "cases": now}
    path.write_text(json.dumps(document, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    return changed


def _changes(stored: dict, now: dict) -> list[str]:
    both = [
        name for name in stored["cases"] if name in now and stored["cases"][name]["request"] == now[name]["request"]
    ]
    return [
        f"{name}: {line}"
        for name in both
        for line in differences(stored["cases"][name]["results"], now[name]["results"])
    ]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--reason", default="", help="why the results changed; stored in the file")
    changed = regenerate(parser.parse_args().reason)
    sys.stdout.write("\n".join(changed or ["nothing changed"]) + "\n")


if __name__ == "__main__":
    main()
