"""Dependencies run one way (docs/architecture.md): C++ rooms by includes, Python rooms by imports."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
HEADERS, SOURCES, PACKAGE = ROOT / "cpp/include/mcplan", ROOT / "cpp/src", ROOT / "python/mcplan"
BENCH = ROOT / "bench/mcplan_bench"  # a distribution of its own, that imports the package

# room -> the rooms that it may include, beside itself
CPP_ROOMS = {
    "base": set(),
    "model": {"base"},
    "scene": {"base", "model"},
    "robot": {"base", "model", "scene"},
    "plan": {"base", "model", "scene", "robot"},  # the checker with it: it sees no planner
    "ddp": {"base", "model", "scene", "robot", "plan"},
    "nlp": {"base"},
    "ipm": {"base", "model", "nlp"},
    "rhp": {"base", "model", "scene", "robot", "plan", "nlp", "ipm"},
    "planar": {"base", "model", "plan"},  # robot, task, plan and checker, which sees no planner either
    "planar/sip": {"base", "model", "plan", "nlp", "ipm", "planar"},
    "wb": {"base", "nlp", "ipm"},
    "online": {"base", "model", "scene", "robot", "plan", "ddp"},
}
#: The public headers of each folder: data, options, results, and what loads, plans, checks and saves them. Another header
#: is internal and lies in cpp/src; it becomes public, and installed, by its name here.
PUBLIC = {
    ".": "mcplan version",
    "base": "deadline error logging range rotation status suspicion",
    "model": "data",
    "scene": "polygon scene scene_files",
    "robot": "robot robot_files similarity standing",
    "plan": "checker force_laws friction_use loads plan plan_files report",
    "ddp": "options plan replan switched_ddp",
    "nlp": "derivative_check piece problem solver",
    "ipm": "solver",
    "rhp": "options receding_horizon walk",
    "planar": "checker force_laws plan plan_files robot robot_files task task_files",
    "planar/sip": "certificate options plan planner",
    "wb": "problem solver",
    "online": "felt_push following planned_height planned_turn planner",
}
#: Sources that know a parser: nobody else includes one, and no public header.
PARSERS = {"toml++": "model/toml.cpp", "nlohmann": "model/json.cpp"}
OPENMP_ROOMS = {"ddp", "rhp", "planar/sip"}

# room (a module or folder of the package) -> the rooms that it may import, beside itself; "" is the package's
# front, which others import for annotations only
_GROUND = {"_core", "errors", "extras", "options", "arguments"}
_ENGINES = {"solve", "walking"}
_LOOKED_AT = {"files", "kinematics", "wb", "tracking", "view", "planar"}
_FRONT = _ENGINES | _LOOKED_AT | {"loading", "checking", "showing", "following", "export", "model", "option_types"}
_FRONT |= {"online", "running"}
_FRONT |= {"ddp", "ipm", "rhp", "sip", "samples", "notebooks", "sweep"}
PYTHON_ROOMS = {
    "__main__": {"cli"},
    "_core": set(),
    "moved": set(),
    "errors": {"moved"},
    "starting": set(),  # the command's first moments
    "extras": {"errors"},
    "logs": {"_core"},
    "options": {"errors", "arguments", "moved", "logs"},
    "samples": {"_core", "errors"},
    "option_types": {"_core"},  # generated
    "model": {"_core", "samples"},
    "arguments": {"_core", "errors"},
    "refusals": {"_core", "errors", "arguments"},
    "checking": {"_core", "errors", "arguments", "files", "wb"},
    "files": _GROUND,
    "loading": _GROUND | {"files"},
    "solve": _GROUND | {"files"},
    "walking": _GROUND | {"files", "solve"},
    "alternation": _GROUND | {"solve", "kinematics", "wb"},
    "ddp": _GROUND | {"solve", "alternation", "wb"},
    "ipm": {"_core", "errors", "arguments"},
    "rhp": _GROUND | {"walking"},
    "sip": _GROUND | {"planar"},
    "kinematics": _GROUND | {"files"},
    "wb": _GROUND | {"files", "kinematics"},
    "tracking": _GROUND | {"files", "kinematics", "wb"},
    "online": _GROUND | {"solve", "files", "kinematics", "tracking"},
    "view": _GROUND | {"files", "kinematics", "wb", "tracking"},
    "planar": _GROUND | {"files", "kinematics", "tracking", "view"},
    "export": _GROUND | {"files", "kinematics", "wb", "tracking"},
    "showing": _GROUND | _LOOKED_AT | {"online"},
    "notebooks": {"_core", "errors", "showing"},
    "following": _GROUND | _LOOKED_AT - {"view"},
    "running": _GROUND | {"solve", "files", "kinematics", "tracking", "online"},
    "sweep": _GROUND | _ENGINES | {"files", "wb", "checking", "view", "export"},
    "cli": _GROUND | _FRONT | {"starting", ""},
    "": _GROUND | _FRONT | {"starting", "moved"},
}
# The same inside of rooms; "" is what lies in the room's own folder, except for its __init__, which may import them all.
INNER_ROOMS = {
    "wb": {"": {"certificate"}, "certificate": set()},
    "view": {
        "": set(),
        "live": {"", "pages"},
        "pages": {""},
        "pictures": {""},
        "plots": {"", "pictures"},
        "video": {"", "pictures"},
    },
    "planar": {"": set(), "tracking": set(), "view": {"tracking"}},
}
HEAVY = {"crocoddyl", "example_robot_data", "imageio", "matplotlib", "meshcat", "mink", "mujoco"}
HEAVY |= {"PIL", "pink", "pinocchio", "proxsuite", "scipy", "dask", "distributed", "pandas", "pyarrow", "pydantic"}


def cpp_room(parts: tuple[str, ...]) -> str:
    """The room of a file by the folders and the name of its path: a room within a room if there is one."""
    inner = "/".join(parts[:2])
    return inner if inner in CPP_ROOMS else parts[0]


def cpp_files() -> Iterator[tuple[str, Path]]:
    """Room and path of every public header and every source of a room."""
    for top in (HEADERS, SOURCES):
        for path in sorted(top.glob("*/**/*.[ch]pp")):
            room = cpp_room(path.relative_to(top).parts)
            if room != "bindings":
                yield room, path


def quoted_includes(text: str) -> list[str]:
    return re.findall(r'^\s*#\s*include\s+"([^"]+)"', text, flags=re.MULTILINE)


def forbidden_includes(room: str, text: str) -> list[str]:
    """Includes of `text` that a file of this room may not have: other rooms, paths that leave its folder."""
    bad = []
    for include in quoted_includes(text):
        parts = include.split("/")
        if parts[0] == "mcplan" and len(parts) > 2:
            other = cpp_room(tuple(parts[1:]))
            if other != room and other not in CPP_ROOMS[room]:
                bad.append(include)
        elif len(parts) > 1 and parts[0] in CPP_ROOMS:  # internal headers: cpp/src/<room>
            other = cpp_room(tuple(parts))
            if other != room and other not in CPP_ROOMS[room]:
                bad.append(include)
        elif include != "mcplan/version.hpp" and len(parts) > 1:
            bad.append(include)
    return bad


def test_a_header_is_public_because_users_include_it() -> None:
    found: dict[str, set[str]] = {}
    for path in HEADERS.rglob("*.hpp"):
        found.setdefault(str(path.parent.relative_to(HEADERS)), set()).add(path.stem)
    assert found == {room: set(names.split()) for room, names in PUBLIC.items()}


def test_public_headers_include_public_ones_alone() -> None:
    public = {str(path.relative_to(HEADERS.parent)) for path in HEADERS.rglob("*.hpp")}
    for path in HEADERS.rglob("*.hpp"):
        assert set(quoted_includes(path.read_text())) <= public, path


def test_each_parser_is_known_to_one_source() -> None:
    for parser, source in PARSERS.items():
        users = [path for _, path in cpp_files() if re.search(rf"#\s*include\s*<{re.escape(parser)}", path.read_text())]
        assert [str(path.relative_to(SOURCES)) for path in users] == [source]


def test_the_compiled_module_calls_no_python_of_mcplan_but_errors_and_their_words() -> None:
    for path in sorted((SOURCES / "bindings").glob("*.[ch]pp")):
        named = re.findall(r'"(mcplan\.[\w.]+)"', path.read_text())
        assert set(named) <= {"mcplan.errors", "mcplan.refusals"}, path.name


def test_cpp_rooms_include_only_what_they_may() -> None:
    checked = 0
    for room, path in cpp_files():
        assert room in CPP_ROOMS, f"{path}: give the room its place in CPP_ROOMS and docs/architecture.md"
        assert forbidden_includes(room, path.read_text()) == [], path
        checked += 1
    assert checked > 20


def test_an_include_in_the_wrong_direction_is_seen() -> None:
    assert forbidden_includes("plan", '#include "mcplan/ddp/options.hpp"\n') == ["mcplan/ddp/options.hpp"]
    assert forbidden_includes("rhp", '  # include "mcplan/planar/sip/spline.hpp"') == ["mcplan/planar/sip/spline.hpp"]
    assert forbidden_includes("scene", '#include "../robot/inner.hpp"') == ["../robot/inner.hpp"]
    assert forbidden_includes("planar", '#include "mcplan/planar/sip/rows.hpp"') == ["mcplan/planar/sip/rows.hpp"]
    assert forbidden_includes("planar/sip", '#include "mcplan/planar/plan.hpp"') == []
    assert forbidden_includes("nlp", '#include "mcplan/ddp/costs/a.hpp"') == ["mcplan/ddp/costs/a.hpp"]
    assert forbidden_includes("plan", '#include "ddp/search.hpp"') == ["ddp/search.hpp"]
    assert forbidden_includes("planar", '#include "planar/sip/rows.hpp"') == ["planar/sip/rows.hpp"]
    assert forbidden_includes("planar/sip", '#include "rhp/pieces/costs.hpp"') == ["rhp/pieces/costs.hpp"]
    assert forbidden_includes("planar/sip", '#include "planar/sip/rows.hpp"\n#include "planar/checks.hpp"') == []
    assert forbidden_includes("base", '#include "mcplan/mcplan.hpp"') == ["mcplan/mcplan.hpp"]
    assert forbidden_includes("model", '#include "scene/scene_fields.hpp"') == ["scene/scene_fields.hpp"]
    legal = '#include <vector>\n#include "mcplan/scene/scene.hpp"\n#include "beside.hpp"\n#include "model/read.hpp"\n'
    assert forbidden_includes("robot", legal) == []


def test_the_rooms_have_no_cycle() -> None:
    for rooms in (CPP_ROOMS, {room: to for room, to in PYTHON_ROOMS.items() if room}):
        left = dict(rooms)
        while left:
            lowest = [room for room, to in left.items() if not (to - {""}) & left.keys()]
            assert lowest, f"cycle among {sorted(left)}"
            for room in lowest:
                del left[room]


def test_ipopt_is_known_to_the_files_of_nlp_that_bear_its_name_alone() -> None:
    ipopt = re.compile(r"#\s*include\s*[<\"][^>\"]*Ip[A-Z]\w+\.hp?p?|#\s*include\s*\"nlp/ipopt")
    users = [path for _, path in cpp_files() if ipopt.search(path.read_text())]
    assert SOURCES / "nlp/ipopt.cpp" in users
    assert all(path.parent == SOURCES / "nlp" and path.stem.startswith("ipopt") for path in users)


def test_openmp_stays_where_problems_are_evaluated() -> None:
    for room, path in cpp_files():
        if re.search(r"#\s*(pragma\s+omp|include\s*<omp\.h>)", path.read_text()):
            assert room in OPENMP_ROOMS, path


def test_mcplan_hpp_includes_every_public_header() -> None:
    every = {str(path.relative_to(HEADERS.parent)) for path in HEADERS.rglob("*.hpp")}
    assert set(quoted_includes((HEADERS / "mcplan.hpp").read_text())) == every - {"mcplan/mcplan.hpp"}


def test_a_cpp_test_has_the_name_of_what_it_tests() -> None:
    parts = {path.relative_to(top).with_suffix("") for top in (HEADERS, SOURCES) for path in top.rglob("*.[ch]pp")}
    tests = ROOT / "tests/cpp"
    for path in tests.glob("*/**/*.cpp"):
        name = path.relative_to(tests).with_suffix("")
        beside = [part.name for part in parts if part.parent == name.parent]
        # Some things have a second file, of a case of theirs: plan_wrench beside plan.
        assert any(name.name == part or name.name.startswith(f"{part}_") for part in beside), path


def room_of(module: str) -> str:
    """Room of a dotted name inside the package; "" for the front itself and for names that it exports."""
    name = module.split(".")[1] if "." in module else ""
    return name if name in PYTHON_ROOMS else ""


def imported(tree: ast.AST, package: str, typing: bool = False) -> Iterator[str]:
    """Dotted names that a module of `package` imports anywhere; those under `if TYPE_CHECKING:` only if `typing`."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test) and not typing:
            continue
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = package.split(".")[: len(package.split(".")) - node.level + 1] if node.level else []
            origin = ".".join(base + ([node.module] if node.module else []))
            yield from (f"{origin}.{alias.name}" for alias in node.names)
        else:
            yield from imported(node, package, typing)


def import_graph(sources: dict[str, str], packages: set[str], typing: bool) -> dict[str, set[str]]:
    """For each module, by dotted name and text, the other modules that it names in imports, lazy ones included.

    A package stands for its `__init__`, which is counted where something is imported from it by name; that a module in it
    loads it on the way is not.
    """
    graph: dict[str, set[str]] = {}
    for module, text in sources.items():
        package = module if module in packages else module.rpartition(".")[0]
        graph[module] = set()
        for name in imported(ast.parse(text), package, typing):
            while name and name not in sources:
                name = name.rpartition(".")[0] if not name.startswith("mcplan._core") else ""
            graph[module] |= {name} - {"", module}
    return graph


def circles(graph: dict[str, set[str]]) -> list[list[str]]:
    """The modules of each circle: those that can be reached from each other (Tarjan's strong components)."""
    order: dict[str, int] = {}
    lowest: dict[str, int] = {}
    path: list[str] = []
    found = []

    def visit(module: str) -> None:
        order[module] = lowest[module] = len(order)
        path.append(module)
        for other in graph[module]:
            if other not in order:
                visit(other)
            if other in path:
                lowest[module] = min(lowest[module], lowest[other])
        if lowest[module] == order[module]:
            start = path.index(module)
            if len(path) - start > 1:
                found.append(sorted(path[start:]))
            del path[start:]

    for module in graph:
        if module not in order:
            visit(module)
    return found


def modules_of(top: Path) -> tuple[dict[str, str], set[str]]:
    """Text of each module below the folder of a package, by dotted name; and those that are packages."""
    sources, packages = {}, set()
    for path in sorted(top.rglob("*.py")):
        parts = [top.name, *path.relative_to(top).with_suffix("").parts]
        if parts[-1] == "__init__":
            parts.pop()
            packages.add(".".join(parts))
        sources[".".join(parts)] = path.read_text()
    return sources, packages


@pytest.mark.parametrize("typing", [False, True], ids=["what runs", "annotations too"])
def test_modules_import_each_other_in_no_circle(typing: bool) -> None:
    sources, packages = (known[0] | known[1] for known in zip(modules_of(PACKAGE), modules_of(BENCH), strict=True))
    assert len(sources) > 100
    assert circles(import_graph(sources, packages, typing)) == []


def test_a_circle_is_seen() -> None:
    sources = {
        "p": "from p.a import f",
        "p.a": "def f():\n    from .b import g",
        "p.b": "class C:\n    def m(self):\n        from . import c",
        "p.c": "import p.a, numpy",
        "p.d": "from p import f\nfrom p.a import f",
    }
    assert circles(import_graph(sources, {"p"}, False)) == [["p.a", "p.b", "p.c"]]
    sources["p.c"] = "if TYPE_CHECKING:\n    import p.a"
    assert circles(import_graph(sources, {"p"}, False)) == []
    assert circles(import_graph(sources, {"p"}, True)) == [["p.a", "p.b", "p.c"]]


def test_the_package_knows_nothing_of_the_bench() -> None:
    for module, text in modules_of(PACKAGE)[0].items():
        assert not [name for name in imported(ast.parse(text), module, True) if name.startswith("mcplan_bench")], module


def test_of_the_bench_its_commands_alone_import_those_of_mcplan() -> None:
    graph = import_graph(*modules_of(BENCH), True)
    order = {"mcplan_bench.cli": 2, "mcplan_bench.reproduce": 1}

    def height(module: str) -> int:
        return order.get(".".join(module.split(".")[:2]), 0)

    for module, others in graph.items():
        assert all(height(other) <= height(module) for other in others), module
    for module, text in modules_of(BENCH)[0].items():
        verbs = [name for name in imported(ast.parse(text), module) if name.startswith("mcplan.cli")]
        assert not verbs or height(module) == 2, module


def forbidden_imports(room: str, text: str, package: str) -> list[str]:
    """Names of the package that a module of this room may not import."""
    return [
        name
        for name in imported(ast.parse(text), package)
        if name.split(".")[0] == "mcplan" and room_of(name) not in PYTHON_ROOMS[room] | {room}
    ]


def test_python_rooms_import_only_what_they_may() -> None:
    modules = sorted(PACKAGE.rglob("*.py"))
    for path in modules:
        inside = path.relative_to(PACKAGE)
        room = "" if inside == Path("__init__.py") else inside.parts[0].removesuffix(".py")
        assert room in PYTHON_ROOMS, f"{inside}: give it its place in PYTHON_ROOMS and docs/architecture.md"
        package = ".".join(("mcplan", *inside.parts[:-1]))
        assert forbidden_imports(room, path.read_text(), package) == [], inside
    assert modules


@pytest.mark.parametrize("room", INNER_ROOMS)
def test_folders_of_a_room_import_only_what_they_may(room: str) -> None:
    sources, packages = modules_of(PACKAGE)
    graph = import_graph(sources, packages, typing=True)
    folders = INNER_ROOMS[room]
    seen = set()

    def folder_of(module: str) -> str:
        parts = module.split(".")[2:]
        return parts[0] if f"mcplan.{room}.{parts[0]}" in packages else ""

    for module in (name for name in graph if name.startswith(f"mcplan.{room}.")):
        own = folder_of(module)
        assert own in folders, f"{module}: give the folder its place in INNER_ROOMS"
        inside = {folder_of(other) for other in graph[module] if other.startswith(f"mcplan.{room}.")}
        assert inside <= folders[own] | {own}, module
        seen.add(own)
    assert seen == set(folders)


def test_an_import_in_the_wrong_direction_is_seen() -> None:
    lazy = "def f():\n    from mcplan.cli import main"
    assert forbidden_imports("files", lazy, "mcplan.files") == ["mcplan.cli.main"]
    assert forbidden_imports("tracking", "from ..view import show", "mcplan.tracking") == ["mcplan.view.show"]
    assert forbidden_imports("tracking", "from .. import view", "mcplan.tracking") == ["mcplan.view"]
    assert forbidden_imports("files", "import mcplan", "mcplan.files") == ["mcplan"]
    assert forbidden_imports("view", "from .page import Page\nimport numpy", "mcplan.view") == []
    assert forbidden_imports("view", "if TYPE_CHECKING:\n    from mcplan import Plan", "mcplan.view") == []


def test_python_files_and_functions_can_be_taken_in() -> None:
    for top in (PACKAGE, BENCH):
        for path in top.rglob("*.py"):
            text = path.read_text()
            assert text.count("\n") <= 400, path
            for node in ast.walk(ast.parse(text)):
                if isinstance(node, ast.FunctionDef):
                    lines = node.end_lineno - node.lineno + 1
                    assert lines <= 60, f"{path}: {node.name} has {lines} lines"


def cpp_functions(text: str) -> Iterator[tuple[str, int]]:
    """Head and number of lines of each function that has a body: what has parentheses before its braces, and stands in
    namespaces, structs and classes alone."""
    blank = r"//[^\n]*|/\*.*?\*/|^[ \t]*#(?:[^\n]*\\\n)*[^\n]*|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])'"
    text = re.sub(blank, lambda found: "\n" * found[0].count("\n"), text, flags=re.DOTALL | re.MULTILINE)
    open_braces: list[tuple[str, str, int]] = []  # kind, head and where the head starts
    start = 0
    for brace in re.finditer(r"[{};]", text):
        if brace[0] == "{":
            head = text[start : brace.start()]
            within = not open_braces or open_braces[-1][0] == "scope"
            kind = "inner"
            if not head[-1:].isspace() or head.count("(") > head.count(")"):
                kind = "value"  # member{0}, T b = {}: bodies stand behind a space, and not among arguments
            elif within and re.search(r"\b(namespace|struct|class|union|enum)\b[^()]*$", head):
                kind = "scope"
            elif within and "(" in head:
                kind = "function"
            open_braces.append((kind, head.strip(), start + len(head) - len(head.lstrip())))
        elif brace[0] == "}":
            kind, head, first = open_braces.pop()
            if kind == "function":
                yield head, text.count("\n", first, brace.end()) + 1
            if kind == "value":
                continue
        if not open_braces or open_braces[-1][0] == "scope":
            start = brace.end()
    assert not open_braces


def test_cpp_files_and_functions_can_be_taken_in() -> None:
    counted = 0
    for path in (ROOT / "tests").rglob("*.[ch]pp"):
        assert path.read_text().count("\n") <= 400, path  # a law that is held takes the lines it takes
    for path in (ROOT / "cpp").rglob("*.[ch]pp"):
        text = path.read_text()
        assert text.count("\n") <= 400, path
        for head, lines in cpp_functions(text):
            assert lines <= 60, f"{path}: {head} has {lines} lines"
            counted += 1
    assert counted > 1500


def test_functions_of_cpp_are_counted() -> None:
    text = """#include "a.hpp"
#define BRACE(x) { \\
  x
namespace a {
struct B {
  int member{0};
  B(int x) : member{x} {}
  int one() const { return member; }  // } in a comment, "{" too
};
template <class T>
double two(T a,
           T b = {}) {
  const auto inner = [&](T c) {
    return c;
  };
  if (a < b) { return '{'; }
  return inner("}{");
}
constexpr int three[] = {1, 2};
}  // namespace a
"""
    assert [lines for _, lines in cpp_functions(text)] == [1, 1, 9]


@pytest.mark.parametrize("module", ["mcplan", "mcplan.cli"])
def test_importing_loads_nothing_heavy(module: str) -> None:
    code = f"import sys, {module}; print(*{{name.split('.')[0] for name in sys.modules}})"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    loaded = set(run.stdout.split())
    assert "mcplan" in loaded
    assert not loaded & HEAVY
    if module == "mcplan":
        assert not loaded & {"typer", "rich"}


def parameters(node: ast.FunctionDef) -> int:
    """Number of parameters of a function, `self` and `cls` apart."""
    arguments = node.args
    names = [item.arg for item in (*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs)]
    names += [item.arg for item in (arguments.vararg, arguments.kwarg) if item is not None]
    return len([name for name in names if name not in ("self", "cls")])


def exported(sources: dict[str, str], packages: set[str]) -> set[str]:
    """Names in __all__ of packages: what users call, with options by keyword."""
    found: set[str] = set()
    for package in packages:
        for node in ast.parse(sources[package]).body:
            if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__":
                found |= {str(name) for name in ast.literal_eval(node.value)}
    return found


def is_command(node: ast.FunctionDef) -> bool:
    """Whether the parameters of a function are options and arguments of a command, each of a type of its own."""
    own = [item.annotation for item in (*node.args.args, *node.args.kwonlyargs)]
    return all(kind is not None and ast.unparse(kind).endswith(("Option", "Argument")) for kind in own)


def test_functions_take_six_parameters_at_most() -> None:
    """Excepted are those whose parameters are the options of who calls them: verbs that a package exports, and commands."""
    sources, packages = modules_of(PACKAGE)
    public = exported(sources, packages)
    counted = 0
    for module, text in sources.items():
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.FunctionDef):
                counted += 1
                if node.name in public and not node.name.startswith("_"):
                    continue
                if module.startswith("mcplan.cli.") and is_command(node):
                    continue
                assert parameters(node) <= 6, f"{module}.{node.name} takes {parameters(node)} parameters"
    assert counted > 1000


def test_the_verdict_of_a_check_is_called_for() -> None:
    """``ok`` is a method: without its parentheses a test of it cannot fail."""
    found = []
    for file in sorted(Path(__file__).parent.glob("*.py")):
        nodes = list(ast.walk(ast.parse(file.read_text())))
        called = {id(node.func) for node in nodes if isinstance(node, ast.Call)}
        found += [
            f"{file.name}:{node.lineno}"
            for node in nodes
            if isinstance(node, ast.Attribute) and node.attr == "ok" and id(node) not in called
        ]
    assert not found
