"""What a sweep has come to: its table, and plans as they are asked for."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from mcplan._core import Plan
from mcplan.errors import InvalidArgument, InvalidSweep, shown
from mcplan.extras import require
from mcplan.sweep import store
from mcplan.sweep.columns import HEAD, RESULTS

if TYPE_CHECKING:
    import pandas
    import pyarrow

    from mcplan.wb import Motion

T = TypeVar("T")


class _Files(Mapping[int, T]):
    """What files hold by the number of their task, each loaded when it is asked for; tasks without one are not in it."""

    kind = ""

    def __init__(self, out: Path, paths: Mapping[int, str]) -> None:
        self._out, self._paths = out, dict(paths)

    def __iter__(self) -> Iterator[int]:
        return iter(self._paths)

    def __len__(self) -> int:
        return len(self._paths)

    def __repr__(self) -> str:
        return f"<{len(self)} {self.kind} in {self._out}>"


class Plans(_Files[Plan]):
    """Plans by the number of their task, each loaded when it is asked for; tasks without a plan are not in it."""

    kind = "plans"

    def __getitem__(self, task: int) -> Plan:
        from mcplan.files.plans import load_plan

        return load_plan(self._out / self._paths[task])


class Motions(_Files["Motion"]):
    """Motions by the number of their task, likewise."""

    kind = "motions"

    def __getitem__(self, task: int) -> Motion:
        from mcplan.wb import Motion

        return Motion.load(self._out / self._paths[task])


class Sweep:
    """The folder of a sweep, as far as it has come.

    Attributes:
        out: The folder.
        manifest: Name, number of tasks, seeds, versions, the spec.
        plans: Plans by task.
        motions: Whole-body motions by task; empty without ``motion`` in the spec.
    """

    def __init__(self, out: Path) -> None:
        self.out = out
        self.manifest = store.read_manifest(out)
        self._arrow = self._read()
        rows = self._arrow.select(["task", "plan"]).to_pylist()
        self.plans = Plans(out, {row["task"]: row["plan"] for row in rows if row["plan"]})
        found = self._arrow.select(["task", "motion"]).to_pylist() if "motion" in self._arrow.column_names else []
        self.motions = Motions(out, {row["task"]: row["motion"] for row in found if row["motion"]})

    @property
    def complete(self) -> bool:
        """Whether all tasks are done."""
        return self._arrow.num_rows == self.manifest["tasks"]

    @cached_property
    def table(self) -> pandas.DataFrame:
        """A row for each task that is done: parameters, status, cost, worst violation, contact sequence."""
        require("Sweep.table", "sweep", "pandas")
        return self._arrow.to_pandas()

    @cached_property
    def times(self) -> pandas.DataFrame:
        """Times [s] of each task, by its number."""
        require("Sweep.times", "sweep", "pandas")
        from mcplan.sweep.index import times_table

        return times_table(_rows(self.out, store.times)).to_pandas()

    def to_arrow(self) -> pyarrow.Table:
        """The table as Arrow has it; ``polars.from_arrow`` takes it."""
        return self._arrow

    def verify(self) -> list[str]:
        """Files whose content is not that of their checksum, or that are missing: none, if all is well.

        Raises:
            InvalidSweep: The sweep is not complete: there are no checksums yet, or their file is damaged.
        """
        try:
            lines = (self.out / store.CHECKSUMS).read_text(encoding="utf-8").splitlines()
        except OSError:
            raise InvalidSweep("", f"must be complete: there is no {store.CHECKSUMS}", str(self.out)) from None
        except UnicodeDecodeError:
            lines = []
        if not lines:
            raise _damaged(self.out, store.CHECKSUMS)
        wrong = []
        for line in lines:
            digest, _, name = line.partition("  ")
            path = self.out / name
            if not path.is_file() or hashlib.sha256(path.read_bytes()).hexdigest() != digest:
                wrong.append(name)
        return wrong

    def _read(self) -> pyarrow.Table:
        """The index; of a sweep that is not complete what its records make."""
        if (self.out / store.INDEX).exists():
            import pyarrow as pa
            import pyarrow.parquet as pq

            try:
                found = pq.read_table(self.out / store.INDEX)
            except (pa.ArrowInvalid, OSError):
                raise _damaged(self.out, store.INDEX) from None
            if not {*HEAD, *RESULTS} <= set(found.column_names):
                raise _damaged(self.out, store.INDEX)
            return found
        from mcplan.sweep.index import index_table

        return index_table(_rows(self.out, store.records))

    def __repr__(self) -> str:
        return f"<Sweep {self.manifest['name']!r}: {self._arrow.num_rows} of {self.manifest['tasks']} tasks>"


def load_sweep(path: str | Path) -> Sweep:
    """Load the folder of a sweep, also one that is still running.

        sweep = mp.load_sweep("out/stairs")
        sweep.table.groupby("robot").status.value_counts()  # a pandas.DataFrame
        plan = sweep.plans[17]  # loaded now

    Args:
        path: What ``mcplan sweep --out`` was given.

    Returns:
        Its table (``table``, ``times``, ``to_arrow()``), plans and motions by the number of their task (``plans``,
        ``motions``), ``manifest``, and ``verify()``, which compares files with their checksums.

    Raises:
        InvalidSweep: The folder is none of a sweep, or its index is damaged.
        InvalidArgument: It is no path.
        MissingExtra: The packages of ``pip install 'mcplan[sweep]'`` are not installed.
    """
    if not isinstance(path, str | Path) or not str(path):
        raise InvalidArgument("path", "must be a path", shown(path))
    store.read_manifest(Path(path))
    require("mcplan.load_sweep", "sweep", "pyarrow")
    return Sweep(Path(path))


def _damaged(out: Path, name: str) -> InvalidSweep:
    rule = f"must be that of a sweep: {name} is damaged, and the same `mcplan sweep` makes it again"
    return InvalidSweep("", rule, str(out))


def _rows(out: Path, read: Any) -> list[dict[str, Any]]:
    return sorted(read(out), key=lambda row: int(row["task"]))
