"""``save`` and ``load`` of plans. Their classes are compiled and know no files of Python: these methods are given to them here.

The front imports this, so that they are there whenever ``mcplan`` is; what reads and writes comes when it is first used.
Annotations are types here, not texts, because those who ask the classes for signatures would look for their names in ``_core``.
"""

from inspect import cleandoc
from pathlib import Path

from mcplan._core import Plan, PlanarPlan


def _save(self: Plan, path: str | Path) -> None:
    """Write the plan to an .npz or a .json file, which is complete or not there at all; C++ reads the latter.

    Raises:
        InvalidInput: The name promises another kind of file.
        OSError: The file cannot be written.
        InvalidPlan: Its sizes do not fit together or a number is not finite.
    """
    from mcplan.files.plans import save_plan

    save_plan(self, path)


def _load(path: str | Path) -> Plan:
    """Read a plan that was written by save(), or by Plan::save in C++.

    Raises:
        InvalidPlan: Not such a file, or its content does not fit together; the message names file, field and rule.
        FileNotFoundError: There is no such file.
    """
    from mcplan.files.plans import load_plan

    return load_plan(path)


def _save_planar(self: PlanarPlan, path: str | Path) -> None:
    """Write the plan to an .npz or a .json file, which is complete or not there at all; C++ reads the latter.

    Raises:
        InvalidInput: The name promises another kind of file.
        OSError: The file cannot be written.
        InvalidPlan: Its sizes do not fit together or a number is not finite.
    """
    from mcplan.files.whole_body_plans import save_whole_body_plan

    save_whole_body_plan(self, path)


def _load_planar(path: str | Path) -> PlanarPlan:
    """Read a plan that was written by save(), or by PlanarPlan::save in C++.

    Raises:
        InvalidPlan: Not such a file, or its content does not fit together; the message names file, field and rule.
        FileNotFoundError: There is no such file.
    """
    from mcplan.files.whole_body_plans import load_whole_body_plan

    return load_whole_body_plan(path)


def _give(owner: type, save: object, load: object) -> None:
    """Make the two functions methods of a class, under their names."""
    for name, function in (("save", save), ("load", load)):
        function.__name__, function.__qualname__ = name, f"{owner.__name__}.{name}"  # type: ignore[attr-defined]
        function.__doc__ = cleandoc(function.__doc__ or "")
    owner.save, owner.load = save, staticmethod(load)  # type: ignore[attr-defined, arg-type]


_give(Plan, _save, _load)
_give(PlanarPlan, _save_planar, _load_planar)
