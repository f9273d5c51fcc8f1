"""Names in sentences and in Python blocks: files, tests, modules and what they hold exist."""

from __future__ import annotations

import ast
import importlib
import re
from functools import cache
from types import ModuleType

from pages.page import ROOT, Page

_CODE = re.compile(r"`([^`\n]+)`")
_FILE = re.compile(r"(?:cpp|python|bench|tests|docs|scripts|benchmarks|examples)/[\w./-]+$")
#: Files in blocks; what lies in build/ or out/ is made by the reader.
_IN_BLOCK = re.compile(r"(?<![\w/.])(?:cpp|python|bench|tests|scripts|benchmarks|examples)/[\w./-]*\w")
_DOTTED = re.compile(r"(?:mcplan|mcplan_bench|mp)(?:\.\w+)+(?=\(|$)")
_TEST = re.compile(r"test_\w+$")


def faults(page: Page) -> list[str]:
    """Names that nothing has."""
    out = []
    for number, line, is_code in page.lines():
        for text in _IN_BLOCK.findall(line) if is_code else _CODE.findall(line):
            if fault := wrong(text):
                out.append(f"{page.name}:{number}: `{text}`: {fault}")
    for begin, block in page.blocks("python"):
        out += [f"{page.name}:{begin}: {fault}" for fault in wrong_block(block)]
    return out


def wrong(text: str) -> str | None:
    """What is wrong with a piece of code in a sentence; None: nothing that can be told."""
    if _FILE.match(text) and not any((ROOT / base / text).exists() for base in ("", "python/mcplan")):
        return "there is no such file"
    if (dotted := _DOTTED.match(text)) and not _resolves(dotted[0]):
        return f"there is no {dotted[0]}"
    if _TEST.match(text) and text not in _tests():
        return "there is no such test"
    return None


def wrong_block(block: str) -> list[str]:
    """What a Python block calls and mcplan does not have."""
    try:
        tree = ast.parse(block)
    except SyntaxError as found:
        return [f"the Python block does not parse: {found}"]
    out = []
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("mcplan"):
            out += [
                f"there is no {node.module}.{name.name}"
                for name in node.names
                if not _resolves(f"{node.module}.{name.name}")
            ]
        if isinstance(node, ast.Attribute):
            text = ast.unparse(node)
            if re.fullmatch(r"(mp|mcplan)(\.\w+)+", text) and not _resolves(text):
                out.append(f"there is no {text}")
    return out


@cache
def _resolves(dotted: str) -> bool:
    first, *rest = dotted.split(".")
    top = "mcplan" if first == "mp" else first
    at: object = importlib.import_module(top)
    for i, name in enumerate(rest):
        if not hasattr(at, name) and isinstance(at, ModuleType):
            try:
                at = importlib.import_module(".".join([top, *rest[: i + 1]]))
                continue
            except ImportError as found:
                # A package that is not installed here says nothing about ours.
                return not str(found.name).startswith("mcplan")
        if not hasattr(at, name):
            return False
        at = getattr(at, name)
    return True


@cache
def _tests() -> frozenset[str]:
    found: set[str] = set()
    for path in (ROOT / "tests").rglob("*.[ch]pp"):
        found.add("test_" + path.parent.name)
    for path in (ROOT / "tests/python").glob("test_*.py"):
        found.add(path.stem)
        found.update(re.findall(r"def (test_\w+)", path.read_text(encoding="utf-8")))
    return frozenset(found)
