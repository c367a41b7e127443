"""Fetch the page's libraries from the npm registry and make them importable without a bundler.

    python frontend/vendor/refresh.py

Each package of PACKAGES is packed by `npm pack` at the version named, its module file is copied here, and bare
import specifiers are rewritten to the files beside it: the page's content security policy allows no inline import map.
"""

import re
import subprocess
import tarfile
import tempfile
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).parent


class Package(NamedTuple):
    """An npm package: ``files`` maps a path inside it to a file name here."""

    name: str
    version: str
    licence: str
    files: dict[str, str]


PACKAGES = (
    Package("preact", "11.2.0", "MIT", {"dist/preact.mjs": "preact.js", "hooks/dist/hooks.mjs": "preact-hooks.js"}),
    Package("htm", "3.1.1", "Apache-2.0", {"dist/htm.mjs": "htm.js"}),
    Package("@preact/signals-core", "1.14.5", "MIT", {"dist/signals-core.mjs": "signals-core.js"}),
    Package("@preact/signals", "2.11.4", "MIT", {"dist/signals.mjs": "signals.js"}),
)
SPECIFIERS = {
    "preact": "./preact.js",
    "preact/hooks": "./preact-hooks.js",
    "@preact/signals-core": "./signals-core.js",
}


def main() -> None:
    rows = ["# Libraries of the page", "", "Written by `refresh.py`; licences beside it.", ""]
    rows += ["| package | version | licence | files |", "|---|---|---|---|"]
    for package in PACKAGES:
        fetch(package)
        files = ", ".join(package.files.values())
        rows.append(f"| [{package.name}](https://www.npmjs.com/package/{package.name}) | {package.version} "
                    f"| {package.licence} | {files} |")  # fmt: skip
    (HERE / "README.md").write_text("\n".join(rows) + "\n", encoding="utf-8")


def fetch(package: Package) -> None:
    with tempfile.TemporaryDirectory() as folder:
        wanted = f"{package.name}@{package.version}"
        subprocess.run(["npm", "pack", "--silent", wanted], cwd=folder, check=True, stdout=subprocess.DEVNULL)
        with tarfile.open(next(Path(folder).glob("*.tgz"))) as archive:
            for inside, name in package.files.items():
                source = archive.extractfile(f"package/{inside}").read().decode("utf-8")
                (HERE / name).write_text(relative(source), encoding="utf-8")
            licence = archive.extractfile("package/LICENSE").read()
        (HERE / f"LICENSE.{package.name.strip('@').replace('/', '-')}.txt").write_bytes(licence)


def relative(source: str) -> str:
    """Bare specifiers become files in this folder. The source map comment is dropped: no map is served."""
    source = "// @ts-nocheck\n" + re.sub(r"//# sourceMappingURL=\S+\s*", "", source)
    return re.sub(r'((?:from|import)\s*)"([^"./][^"]*)"', lambda m: f'{m[1]}"{SPECIFIERS[m[2]]}"', source)


if __name__ == "__main__":
    main()
