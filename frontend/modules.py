"""The list of modules that the page needs first. Without it a browser finds them import by import, level by level.

``python -m vocalis.frontend.modules`` writes the list into index.html; a test compares it with the imports.
"""

import re
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
INDEX = FOLDER / "index.html"
IMPORT = re.compile(
    r"""^(?:import|export|\}).*?["'](\.{1,2}/[^"']+\.js)["'];?|(?:from|import)["'](\.{1,2}/[^"']+\.js)["']""", re.M
)
LINE = '  <link rel="modulepreload" href="{}">\n'
LINES = re.compile(r'(?:  <link rel="modulepreload" href="[^"]+">\n)*(?=  <script type="module")')


def needed(first: str = "main.js") -> list[str]:
    """Modules that ``first`` needs before it runs, in the order of discovery: its imports, their imports …"""
    found = [first]
    for name in found:
        path = FOLDER / name
        for match in IMPORT.finditer(path.read_text(encoding="utf-8")):
            other = (path.parent / (match[1] or match[2])).resolve().relative_to(FOLDER).as_posix()
            if other not in found:
                found.append(other)
    return found[1:]


def with_list(page: str) -> str:
    """The page with its list written again."""
    return LINES.sub("".join(map(LINE.format, needed())), page, count=1)


if __name__ == "__main__":
    INDEX.write_text(with_list(INDEX.read_text(encoding="utf-8")), encoding="utf-8")
