"""Constants as they stand in the source, C++ and Python."""

from __future__ import annotations

import ast
import re
from typing import Any

from pages.page import ROOT


def code(file: str, name: str) -> Any:
    """The constant of this name in a C++ file, given from `cpp/src/` or `cpp/include/mcplan/`.

    Raises:
        LookupError: There is none, or it is no number.
    """
    text = _source(file)
    match = re.search(rf"\b{re.escape(name)}\s*(?:=|\{{)\s*([^,;}}]+)", text)
    if not match:
        raise LookupError(f"{file} has no {name}")
    try:
        return eval(match[1].strip(), {"__builtins__": {}})
    except Exception:
        raise LookupError(f"{name} in {file} is no number: {match[1]}") from None


def found(file: str, pattern: str) -> Any:
    """The number that a regular expression's group catches in a file, for constants without a name.

    Raises:
        LookupError: It catches nothing.
    """
    match = re.search(pattern, _source(file))
    if not match:
        raise LookupError(f"{file} has nothing like {pattern}")
    return float(match[1])


def py(file: str, name: str) -> Any:
    """The constant of this name in a file of `python/mcplan/` or `bench/`, which is read and not imported.

    Raises:
        LookupError: There is none.
    """
    folder = next(folder for folder in ("python/mcplan", "bench") if (ROOT / folder / file).exists())
    tree = ast.parse((ROOT / folder / file).read_text(encoding="utf-8"))
    for node in tree.body:
        if isinstance(node, (ast.Assign, ast.AnnAssign)) and node.value is not None:
            for target in node.targets if isinstance(node, ast.Assign) else [node.target]:
                if isinstance(target, ast.Name) and target.id == name:
                    return ast.literal_eval(node.value)
                if isinstance(target, ast.Tuple) and name in (names := [ast.unparse(e) for e in target.elts]):
                    return ast.literal_eval(node.value)[names.index(name)]
    raise LookupError(f"{file} has no {name}")


def _source(file: str) -> str:
    for folder in ("cpp/src", "cpp/include/mcplan", "python/mcplan", "bench", "."):
        if (path := ROOT / folder / file).exists():
            return path.read_text(encoding="utf-8")
    raise LookupError(f"there is no {file}")
