"""Every file that a Markdown page names exists, and every link inside the repository has a target."""

import re
from pathlib import Path
from urllib.parse import unquote

import pytest

ROOT = Path(__file__).resolve().parents[2]
#: Folders whose files a page may name by their path from the root of the repository.
TOP = ("vfcore", "vocalis", "server", "frontend", "tests", "docs", "examples")
NAMED = re.compile(rf"`((?:{'|'.join(TOP)})(?:/[\w.*-]+)*/?)`")
MODULE = re.compile(r"python -m ((?:vfcore|vocalis|tests)[\w.]*)")
LINK = re.compile(r"(?<!!)\[[^\]]*\]\(([^)\s]+)\)|!\[[^\]]*\]\(([^)\s]+)\)")
CODE = re.compile(r"^```.*?^```", re.DOTALL | re.MULTILINE)


def _pages() -> list[str]:
    found = [*ROOT.glob("*.md"), *(page for folder in TOP for page in (ROOT / folder).rglob("*.md"))]
    own = {page.resolve() for page in found if not {"vendor", "node_modules"} & set(page.parts)}
    return sorted(page.relative_to(ROOT).as_posix() for page in own)


PAGES = _pages()


def text_of(page: Path) -> str:
    return CODE.sub("", page.read_text(encoding="utf-8"))


def paths_named(text: str) -> set[str]:
    """Files and folders in backticks, from the root of the repository."""
    return set(NAMED.findall(text))


def modules_run(page: Path) -> set[str]:
    """Modules that a page, code blocks included, runs with ``python -m``."""
    return {name.rstrip(".") for name in MODULE.findall(page.read_text(encoding="utf-8"))}


def module_exists(name: str) -> bool:
    path = ROOT / name.replace(".", "/")
    return path.with_suffix(".py").is_file() or (path / "__main__.py").is_file()


def exists(path: str) -> bool:
    """A pattern must match something."""
    return any(ROOT.glob(path)) if "*" in path else (ROOT / path).exists()


def anchors(page: Path) -> set[str]:
    """The anchors that GitHub gives to the headings of a page."""
    headings = re.findall(r"^#+ (.+)$", text_of(page), re.MULTILINE)
    plain = (re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading) for heading in headings)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in plain}


def broken_links(page: Path, text: str) -> list[str]:
    """Links of a page that lead to no file or to no heading."""
    broken = []
    for target in (link or image for link, image in LINK.findall(text)):
        if re.match(r"\w+:", target):
            continue
        path, _, anchor = target.partition("#")
        file = (page.parent / unquote(path)).resolve() if path else page
        if not file.exists() or (anchor and file.suffix == ".md" and unquote(anchor) not in anchors(file)):
            broken.append(target)
    return broken


@pytest.mark.parametrize("name", PAGES)
def test_every_path_named_on_a_page_exists(name):
    assert [path for path in sorted(paths_named(text_of(ROOT / name))) if not exists(path)] == []


@pytest.mark.parametrize("name", PAGES)
def test_every_module_that_a_page_runs_exists(name):
    assert [module for module in sorted(modules_run(ROOT / name)) if not module_exists(module)] == []


@pytest.mark.parametrize("name", PAGES)
def test_every_internal_link_of_a_page_resolves(name):
    assert broken_links(ROOT / name, text_of(ROOT / name)) == []


def test_the_checks_find_missing_targets(tmp_path):
    """A page with one wrong path, one wrong file, one wrong heading."""
    page = tmp_path / "page.md"
    page.write_text(
        "# One heading\n`docs/nowhere.md` [a](nowhere.md) [b](#one-heading) [c](#another) `docs/img`\n"
        "```sh\npython -m tests.nowhere --write\npython -m tests.support.model_tables\n```\n"
    )
    text = text_of(page)
    assert {path for path in paths_named(text) if not exists(path)} == {"docs/nowhere.md"}
    assert broken_links(page, text) == ["nowhere.md", "#another"]
    assert {name for name in modules_run(page) if not module_exists(name)} == {"tests.nowhere"}


def test_pages_are_found_and_name_files():
    assert len(PAGES) > 15
    assert sum(len(paths_named(text_of(ROOT / name))) for name in PAGES) > 80
