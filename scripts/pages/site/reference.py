"""Pages of the reference: Python from docstrings, C++ from the headers, the command from its help, files from schemas."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from pages import commands
from pages.page import ROOT
from pages.site import stage

HEADERS = "cpp/include/mcplan"
SCHEMAS = "python/mcplan/data/schema"

#: Names of `mcplan` that are described with what they belong to.
TOLD_ELSEWHERE = (
    "Plan, PlanarPlan, PlanarRobot, PlanarTask, PlanarTolerances, Robot, Scene, Status, Tolerances, Interrupted"
)
TOLD_ELSEWHERE += ", InvalidInput, MissingExtra, PlanViolated, UnknownName, ddp, rhp, sip, export, __version__"

#: Modules, what they are about, and names that are described elsewhere.
MODULES = {
    "mcplan": ("Plan, check, show, track", TOLD_ELSEWHERE),
    "mcplan.model": ("Scenes, robots, plans, reports", ""),
    "mcplan.ddp": ("The contact-sequence search", "plan, replan"),
    "mcplan.rhp": ("The receding horizon", "receding_horizon, walk"),
    "mcplan.sip": ("Whole bodies in the plane", "whole_body, Solver"),
    "mcplan.wb": ("Whole-body motions in space", ""),
    "mcplan.tracking": ("Tracking in simulation", "track"),
    "mcplan.online": ("Planning while the robot walks", "run"),
    "mcplan.sweep": ("Sweeps", "load_sweep"),
    "mcplan.export": ("Export", ""),
    "mcplan.view": ("Pages and plots", "show"),
    "mcplan.ipm": ("The interior-point kernel", ""),
    "mcplan.errors": ("Errors", ""),
}

#: Rooms of headers in the order in which they depend on each other, and what they are about.
ROOMS = {
    "base": "Errors, status, deadlines, logging",
    "scene": "Scenes and their files",
    "robot": "Robots and their files",
    "plan": "Plans, their files and the checker",
    "ipm": "The interior-point kernel",
    "nlp": "Sparse nonlinear programs",
    "model": "Models of contacts",
    "ddp": "The contact-sequence search",
    "rhp": "The receding horizon",
    "planar": "Planar robots and whole-body plans",
    "wb": "Whole-body motions in space",
    "online": "Planning while the robot walks",
}


def write_reference(folder: Path) -> None:
    """Write all pages of the reference.

    Args:
        folder: Where Sphinx reads.
    """
    place = folder / "reference"
    place.mkdir(exist_ok=True)
    for module, (title, elsewhere) in MODULES.items():
        (place / f"{module}.md").write_text(_python_page(module, title, elsewhere), encoding="utf-8")
    for room, title in ROOMS.items():
        (place / f"cpp_{room}.md").write_text(_cpp_page(room, title), encoding="utf-8")
    _write_index(place / "python.md", "Python", {module: title for module, (title, _) in MODULES.items()})
    _write_index(place / "cpp.md", "C++", {f"cpp_{room}": title for room, title in ROOMS.items()})
    (place / "command.md").write_text(_command_page(), encoding="utf-8")
    (place / "schemas.md").write_text(_schemas_page(folder), encoding="utf-8")
    (place / "examples.md").write_text(_examples_page(), encoding="utf-8")


def run_doxygen(folder: Path) -> None:
    """Have Doxygen read the headers.

    Args:
        folder: Where the XML is written.
    """
    folder.mkdir(parents=True, exist_ok=True)
    settings = f"""
        PROJECT_NAME = mcplan
        INPUT = {ROOT / HEADERS}
        STRIP_FROM_PATH = {ROOT / "cpp/include"}
        RECURSIVE = YES
        GENERATE_HTML = NO
        GENERATE_LATEX = NO
        GENERATE_XML = YES
        XML_PROGRAMLISTING = NO
        OUTPUT_DIRECTORY = {folder}
        XML_OUTPUT = .
        QUIET = YES
        WARN_IF_UNDOCUMENTED = NO
        WARN_AS_ERROR = FAIL_ON_WARNINGS
        EXTRACT_ALL = YES
        HIDE_FRIEND_COMPOUNDS = YES
        ENABLE_PREPROCESSING = YES
        MACRO_EXPANSION = YES
        HAVE_DOT = NO
    """
    subprocess.run(["doxygen", "-"], input=settings, text=True, check=True, cwd=ROOT)
    _name_files_by_path(folder)
    _silence_namespaces(folder)


def _name_files_by_path(folder: Path) -> None:
    """The index names files without their folders, by which Breathe cannot tell the options of one room from another's."""
    index = ElementTree.parse(folder / "index.xml")
    for compound in index.iterfind("compound[@kind='file']"):
        location = ElementTree.parse(folder / f"{compound.get('refid')}.xml").find("compounddef/location")
        name = compound.find("name")
        assert location is not None and name is not None
        name.text = location.get("file")
    index.write(folder / "index.xml", encoding="utf-8", xml_declaration=True)


def _silence_namespaces(folder: Path) -> None:
    """What stands before a namespace in a header is about the header, and would stand on every page."""
    for path in folder.glob("namespace*.xml"):
        tree = ElementTree.parse(path)
        for kind in ("briefdescription", "detaileddescription"):
            for told in tree.iterfind(f"compounddef/{kind}"):
                told.clear()
        tree.write(path, encoding="utf-8", xml_declaration=True)


def _write_index(page: Path, title: str, parts: dict[str, str]) -> None:
    lines = [f"# {title}", "", "```{toctree}", *(f"{told} <{name}>" for name, told in parts.items()), "```", ""]
    page.write_text("\n".join(lines), encoding="utf-8")


def _python_page(module: str, title: str, left_out: str) -> str:
    options = f":members:\n:imported-members:\n:exclude-members: {left_out}"
    options += "\n:show-inheritance:" if module == "mcplan.errors" else ""
    return f"# {title}: `{module}`\n\n```{{eval-rst}}\n.. automodule:: {module}\n{_indented(options)}\n```\n"


def _cpp_page(room: str, title: str) -> str:
    lines = [f"# {title}: `mcplan/{room}`", ""]
    for header in sorted((ROOT / HEADERS / room).rglob("*.hpp")):
        name = header.relative_to(ROOT / HEADERS.rsplit("/", 1)[0]).as_posix()
        lines += [f"## `#include <{name}>`", "", "```{doxygenfile} " + name, "```", ""]
    return "\n".join(lines)


def _command_page() -> str:
    lines = ["# The command", "", "What `--help` of each verb prints.", ""]
    for name, verb in commands.all_verbs():
        context = verb.make_context(name, [], resilient_parsing=True)
        lines += [f"## `{name}`", "", "```text", verb.get_help(context).strip(), "```", ""]
    return "\n".join(lines)


def _schemas_page(folder: Path) -> str:
    lines = [
        "# Files",
        "",
        "Fields of the TOML files that the product reads. `mcplan schema scene` prints where a schema is; an",
    ]
    lines += ["editor that knows JSON schemas completes and checks what the first line of a file names:", ""]
    lines += ["```toml", "#:schema /path/that/mcplan/schema/prints.json", "```", ""]
    for path in sorted((ROOT / SCHEMAS).glob("*.json")):
        stage.copy(folder, f"{SCHEMAS}/{path.name}")
        schema = json.loads(path.read_text(encoding="utf-8"))
        lines += [f"## {schema['title']}", "", f"[{path.name}](../{SCHEMAS}/{path.name})", ""]
        objects = {"": schema, **schema.get("$defs", {})}
        for name, of in objects.items():
            if "properties" not in of:
                continue
            lines += [f"### {schema['title']}: {name}" if name else "", "", of.get("description", ""), ""]
            lines += ["| field | type | meaning |", "|---|---|---|"]
            for field, told in of["properties"].items():
                what = told.get("description", "").replace("|", "\\|")
                lines.append(f"| `{field}` | {_type_of(told)} | {what}{_default_of(told)} |")
            lines.append("")
    return "\n".join(lines)


def _type_of(told: dict[str, Any]) -> str:
    """The type of a field in words: "array of Surface"."""
    if "$ref" in told:
        return str(told["$ref"]).rpartition("/")[2]
    if "enum" in told:
        return ", ".join(f"`{value}`" for value in told["enum"])
    for several in ("anyOf", "oneOf"):
        if several in told:
            return " or ".join(dict.fromkeys(_type_of(one) for one in told[several]))
    kind = told.get("type", "any")
    kind = " or ".join(kind) if isinstance(kind, list) else str(kind)
    items = told.get("items")
    return f"{kind} of {_type_of(items)}" if isinstance(items, dict) else kind


def _default_of(told: dict[str, Any]) -> str:
    return f" Default: `{json.dumps(told['default'])}`." if told.get("default") not in (None, "") else ""


def _examples_page() -> str:
    lines = [
        "# Examples",
        "",
        "Each does the same in both languages where there are two; the tests run all of them.",
        "",
    ]
    for source in sorted((ROOT / "examples").glob("*")):
        if source.suffix in (".py", ".cpp", ".toml"):
            language = {".py": "python", ".cpp": "cpp", ".toml": "toml"}[source.suffix]
            text = source.read_text(encoding="utf-8").rstrip()
            lines += [f"## {source.name}", "", f"```{language}", text, "```", ""]
    return "\n".join(lines)


def _indented(text: str) -> str:
    return "\n".join(f"   {line}" for line in text.splitlines())
