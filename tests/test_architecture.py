"""The layers of docs/architecture.md, held: who may import whom, and what may stand where."""

import ast
import re
from functools import cache
from pathlib import Path

import pytest

from vfcore.kernels.jit import COMPILED_ROOMS

ROOT = Path(__file__).resolve().parent.parent
PYTHON_ROOMS = ("vfcore", "vocalis", "server", "frontend", "tests")
OUTSIDE_THE_PHYSICS = {"vocalis", "server", "frontend", "tests"}
WEB_AND_PLOTS = {
    "fastapi",
    "starlette",
    "uvicorn",
    "pydantic",
    "pydantic_settings",
    "plotly",
    "matplotlib",
    "typer",
    "rich",
}
#: What says how a fold is and how it is asked for.
BASE = {"errors", "spec", "fold.constants"}
PHYSICS = {"errors", "version", "spec", "kernels", "larynx", "fold", "airways", "measures"}
#: For each room of vfcore, the rooms and modules it may import besides itself. A more specific name overrules its room.
MAY_IMPORT = {
    "errors": set(),
    "version": set(),
    "spec": {"errors", "version", "fold.constants"},
    "spec.fields": {"errors"},
    "directories": set(),
    "kernels": {"directories"},
    "larynx": BASE | {"kernels"},
    "larynx.posture": BASE | {"kernels", "spec.muscles"},
    # Every file of the fold has its place: first what is declared, then the terms, what is made of them, the march.
    "fold.constants": {"spec.fields"},
    "fold.form": set(),
    "fold.closure": set(),
    "fold.displacement": {"kernels"},
    "fold.terms": {"kernels", "larynx.tissue"},
    "fold.layout": {"fold.form", "fold.terms"},
    "fold.material": {"fold.terms", "kernels"},
    "fold.assembly": {"fold.material", "fold.terms", "kernels"},
    "fold.equilibrium": {"fold.terms", "kernels"},
    "fold.surface": {"fold.terms", "kernels"},
    "fold.step": {"fold.displacement", "fold.form", "fold.layout", "fold.terms", "kernels"},
    "fold.assemble": BASE
    | {"larynx.tissue", "kernels", *(f"fold.{name}" for name in ("assembly", "form", "layout", "material", "terms"))},
    "fold.energy": {"fold.assemble", "fold.terms"},
    "fold.stability": BASE | {"fold.assemble", "fold.terms", "kernels"},
    "fold.statics": {"errors", *(f"fold.{name}" for name in ("assemble", "closure", "equilibrium", "terms"))},
    "fold.march": BASE
    | {"airways", *(f"fold.{name}" for name in ("assemble", "form", "layout", "statics", "step", "surface"))},
    "fold.march_many": BASE | {"airways", *(f"fold.{name}" for name in ("assemble", "form", "march", "statics"))},
    "fold": set(),
    "airways": BASE | {"spec.area_functions", "kernels"},
    "airways.sound": BASE | {"airways", "measures.signals"},
    "measures": {
        "errors",
        "spec.fields",
        *(f"kernels.{name}" for name in ("cepstrum", "cycles", "harmonics", "level", "repetition", "slope")),
    },
    "runs": PHYSICS,
    # Tables of sweeps and gestures write themselves, with what io has for every file.
    "runs.sweep": PHYSICS | {"runs", "io.atomic", "io.hdf5", "io.result_document"},
    "runs.gesture": PHYSICS | {"runs", "io.atomic", "io.audio", "io.hdf5", "io.result_document"},
    "io": PHYSICS | {"runs"},
}
#: Layers of the page, lowest first: a folder imports from its own layer and from those before it.
PAGE_LAYERS = ("vendor", "core", "state", "features")


def files(*suffixes: str, under: tuple[str, ...] = PYTHON_ROOMS) -> list[Path]:
    found = [path for room in under for path in (ROOT / room).rglob("*") if path.suffix in suffixes and path.is_file()]
    return sorted(
        path for path in found if not {"vendor", "node_modules", "__pycache__", ".hypothesis"} & set(path.parts)
    )


def name_of(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


@cache
def tree(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


def imports(path: Path) -> set[str]:
    """Dotted names of the modules a file imports, anywhere in it; of ``from a import b`` both a and a.b."""
    names = set()
    for node in ast.walk(tree(path)):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{name_of(path)} imports relatively"
            names |= {node.module} | {f"{node.module}.{alias.name}" for alias in node.names}
    return names


def top_levels(path: Path) -> set[str]:
    return {name.split(".")[0] for name in imports(path)}


PYTHON = files(".py")
VFCORE = [path for path in PYTHON if name_of(path).startswith("vfcore/")]
MODULES = {".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__"): path for path in VFCORE}


def modules_used(path: Path) -> set[str]:
    """The vfcore modules a file imports, without the packages around them."""
    own = {name for name in imports(path) if name in MODULES}
    return {name for name in own if not any(other.startswith(name + ".") for other in own)}


def test_the_rooms_are_there_and_read():
    assert len(VFCORE) > 50 and "vfcore.fold.step" in MODULES
    assert "numba" in top_levels(ROOT / "vfcore/kernels/jit.py")


def test_only_the_compile_options_and_the_lanes_import_numba():
    found = [name_of(path) for path in PYTHON if {"numba", "llvmlite"} & top_levels(path)]
    assert found == ["vfcore/kernels/jit.py", "vfcore/kernels/simd.py"]


def test_the_physics_knows_no_web_no_plots_and_nobody_above_it():
    above = {name_of(path): top_levels(path) & (OUTSIDE_THE_PHYSICS | WEB_AND_PLOTS) for path in VFCORE}
    assert not {name: used for name, used in above.items() if used}


@pytest.mark.parametrize("module", MODULES)
def test_imports_point_down(module):
    inner = module.removeprefix("vfcore").removeprefix(".")
    if not inner:  # what users import offers everything
        return
    rooms = [room for room in MAY_IMPORT if inner == room or inner.startswith(room + ".")]
    assert rooms, f"{module} belongs to no layer"
    room = max(rooms, key=len)
    allowed = MAY_IMPORT[room] | {room}
    for used in modules_used(MODULES[module]):
        if used == "vfcore":  # `from vfcore import fold` is counted as vfcore.fold
            continue
        short = used.removeprefix("vfcore.")
        assert any(short == name or short.startswith(name + ".") for name in allowed), f"{module} imports {used}"


def test_no_import_goes_round_in_a_circle():
    graph = {name: modules_used(path) - {name, "vfcore"} for name, path in MODULES.items()}
    finished: set[str] = set()

    def visit(name, way):
        assert name not in way, " → ".join([*way[way.index(name) :], name])
        if name not in finished:
            for used in sorted(graph[name]):
                visit(used, [*way, name])
            finished.add(name)

    for name in graph:
        visit(name, [])
    assert finished == set(graph)


def test_jobs_do_not_know_the_web():
    jobs = files(".py", under=("server/jobs",))
    assert jobs
    assert not [name_of(path) for path in jobs if top_levels(path) & {"fastapi", "starlette"}]


PAGE = ROOT / "frontend"
PAGE_IMPORT = re.compile(r"""(?:from|import)\s*\(?\s*["'](\.[^"']+)["']""")


def page_imports(path: Path) -> set[str]:
    """Modules of the page that a module imports, at once or later, as paths under frontend."""
    found = PAGE_IMPORT.findall(path.read_text(encoding="utf-8"))
    return {(path.parent / name).resolve().relative_to(PAGE).as_posix() for name in found}


def feature_of(name: str) -> str:
    return name.split("/")[1]


def test_the_layers_of_the_page_point_down():
    scripts = [path for path in files(".js", under=("frontend",)) if path.parent != PAGE]
    assert len(scripts) > 50
    for path in scripts:
        layer = path.relative_to(PAGE).parts[0]
        allowed = PAGE_LAYERS[: PAGE_LAYERS.index(layer) + 1]
        assert {name.split("/")[0] for name in page_imports(path)} <= set(allowed), name_of(path)


def test_no_feature_of_the_page_needs_itself():
    """Features may use one another, but never in a circle: each can be read without those that use it."""
    graph: dict[str, set[str]] = {}
    for path in files(".js", under=("frontend/features",)):
        own = path.relative_to(PAGE / "features").parts[0]
        used = {feature_of(name) for name in page_imports(path) if name.startswith("features/")}
        graph.setdefault(own, set()).update(used - {own})
    assert len(graph) > 10
    while graph:
        free = {name for name, used in graph.items() if not used & set(graph)}
        assert free, f"a circle among {sorted(graph)}"
        graph = {name: used for name, used in graph.items() if name not in free}


def test_nothing_prints_but_the_command_line():
    """server/serve.py is the command line of the server: it says where the page is."""
    printing = [
        name_of(path) for path in files(".py", under=("vfcore", "server")) if any(map(_prints, ast.walk(tree(path))))
    ]
    assert set(printing) <= {"server/serve.py"}


def _prints(node) -> bool:
    return isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "print"


def test_nothing_is_left_for_later_and_no_file_is_a_drawer():
    mark = re.compile(r"\b(?:TO" + r"DO|FIX" + r"ME|XX" + r"X)\b")
    every = files(".py", ".js", ".css", ".html")
    assert [name_of(path) for path in every if mark.search(path.read_text(encoding="utf-8"))] == []
    assert [name_of(path) for path in every if re.fullmatch(r"utils?|helpers?|misc|common", path.stem)] == []


def test_every_file_of_the_physics_says_what_it_is():
    written = [path for path in VFCORE if path.read_text(encoding="utf-8").strip()]
    assert [name_of(path) for path in written if not ast.get_docstring(tree(path))] == []


def test_compiled_functions_raise_nothing_and_build_no_text():
    """In compiled functions; what is at module level is not compiled."""
    foreign = (ast.Raise, ast.Try, ast.JoinedStr, ast.Dict, ast.ListComp)
    rooms = tuple(f"vfcore/{room}" for room in COMPILED_ROOMS)
    compiled = [node for path in files(".py", under=rooms) for node in ast.walk(tree(path)) if _is_compiled(node)]
    assert {"advance", "wall_of", "prestrained", "solve_postures"} <= {node.name for node in compiled}
    assert [node.name for node in compiled if any(isinstance(inner, foreign) for inner in ast.walk(node))] == []


def test_compiled_code_is_in_the_rooms_that_the_kernel_cache_knows():
    """The directory of the cache is named by a hash of these rooms; code elsewhere would be stale after a change."""
    rooms = tuple(f"vfcore/{room}/" for room in COMPILED_ROOMS)
    outside = [path for path in VFCORE if not name_of(path).startswith(rooms)]
    assert [name_of(path) for path in outside if any(map(_is_compiled, ast.walk(tree(path))))] == []


def _is_compiled(node) -> bool:
    return isinstance(node, ast.FunctionDef) and any(
        isinstance(mark, ast.Name) and mark.id in ("jit", "inlined", "formula", "written_out")
        for mark in node.decorator_list
    )


#: Words in the markup of the page: text between tags, and attributes that are read out.
MARKUP_WORDS = re.compile(
    r"(?<!=)>([^<>${}`=()]*[A-Za-z]{3,}[^<>${}`=()]*)<|(?:aria-label|aria-description|title|placeholder|alt)=\"([^\"$]+)\""
)


def test_the_words_of_the_page_are_in_its_texts():
    """Lessons are data; the words before the page's script are in index.html."""
    scripts = files(".js", under=("frontend",))
    stray = {
        name_of(path): words
        for path in scripts
        if path.name != "texts.js" and "html`" in (text := path.read_text(encoding="utf-8"))
        for words in [[match[0] for match in MARKUP_WORDS.finditer(text)]]
        if words
    }
    assert stray == {}


def test_the_page_tells_browsers_what_it_will_need():
    from vocalis.frontend import modules

    page = modules.INDEX.read_text(encoding="utf-8")
    assert len(modules.needed()) > 50
    assert modules.with_list(page) == page, "write the list again: python -m vocalis.frontend.modules"
