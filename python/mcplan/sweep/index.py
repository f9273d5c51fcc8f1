"""Tables of a sweep: what is the same whoever did it, and, apart from that, how long it took."""

from __future__ import annotations

import hashlib
import io
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mcplan.files.outputs import write_whole
from mcplan.sweep import store
from mcplan.sweep.columns import HEAD, MOTION_RESULTS, RESULTS, TIMES
from mcplan.sweep.tasks import Task
from mcplan.sweep.work import files_of

if TYPE_CHECKING:
    import pyarrow


def write_tables(out: Path, tasks: Sequence[Task], records: Sequence[Mapping[str, Any]]) -> None:
    """Write index, times, checksums and the summary page of a sweep that is done.

    Args:
        out: Its folder.
        tasks: All its tasks.
        records: What is known of each.
    """
    from mcplan.sweep.summary import summary_page

    times = [store.times_of(out, task) for task in tasks]
    index = _parquet(index_table(records))
    write_whole(index, out / store.INDEX)
    write_whole(_parquet(times_table(times)), out / store.TIMES_TABLE)
    write_whole(_checksums(out, index, records), out / store.CHECKSUMS)
    write_whole(summary_page(store.read_manifest(out), records, times), out / store.SUMMARY)


def index_table(records: Sequence[Mapping[str, Any]]) -> pyarrow.Table:
    """A row for each task; parameters are columns ``scene.NAME``, options ``options.NAME``."""
    import pyarrow as pa

    columns: dict[str, pa.Array] = {}
    for name, kind in HEAD.items():
        columns[name] = pa.array([record[name] for record in records], type_of(kind))
    for group, prefix in (("parameters", "scene."), ("options", "options.")):
        names = dict.fromkeys(name for record in records for name in record[group])
        for name in sorted(names):
            columns[prefix + name] = _guessed([record[group].get(name) for record in records])
    motions = any("motion_status" in record for record in records)
    exports = sorted({name for record in records for name in record if name.startswith("export_")})
    results = {**RESULTS, **(MOTION_RESULTS if motions else {}), **dict.fromkeys(exports, "string")}
    for name, kind in results.items():
        columns[name] = pa.array([record.get(name) for record in records], type_of(kind))
    return pa.table(columns)


def times_table(times: Sequence[Mapping[str, Any]]) -> pyarrow.Table:
    """A row for each task."""
    import pyarrow as pa

    return pa.table({name: pa.array([row.get(name) for row in times], type_of(kind)) for name, kind in TIMES.items()})


def type_of(kind: str) -> pyarrow.DataType:
    """The type of a column by its name in Arrow."""
    import pyarrow as pa

    kinds = {"int64": pa.int64(), "double": pa.float64(), "string": pa.string(), "list<string>": pa.list_(pa.string())}
    return kinds.get(kind) or pa.list_(pa.float64())


def _guessed(values: Sequence[Any]) -> pyarrow.Array:
    """Values of a sweep's file in a column of the type that holds all of them; of mixed types as texts."""
    import pyarrow as pa

    kinds = {type(value) for value in values if value is not None}
    for legal, kind in (({bool}, pa.bool_()), ({int}, pa.int64()), ({int, float}, pa.float64()), ({str}, pa.string())):
        if kinds <= legal:
            return pa.array(values, kind)
    return pa.array([None if value is None else str(value) for value in values], pa.string())


def _parquet(table: pyarrow.Table) -> bytes:
    import pyarrow.parquet as pq

    buffer = io.BytesIO()
    pq.write_table(table, buffer, compression="zstd")
    return buffer.getvalue()


def _checksums(out: Path, index: bytes, records: Sequence[Mapping[str, Any]]) -> str:
    """As `sha256sum --check` reads them: of all files that do not depend on who made them."""
    lines = [
        f"{hashlib.sha256((out / store.MANIFEST).read_bytes()).hexdigest()}  {store.MANIFEST}",
        f"{hashlib.sha256(index).hexdigest()}  {store.INDEX}",
    ]
    kinds = dict.fromkeys(kind for record in records for kind in files_of(record))
    for kind in kinds:
        lines += [f"{record[f'{kind}_sha256']}  {record[kind]}" for record in records if record.get(kind)]
    return "\n".join(lines) + "\n"
