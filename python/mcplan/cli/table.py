"""Plain tables on the terminal."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Sequence


def print_table(rows: Iterable[Sequence[str]], head: Sequence[str] = ()) -> None:
    """Print rows in aligned columns; the last column wraps in a terminal and stays on one line in a pipe.

    Args:
        rows: Cells.
        head: Titles of the columns; none: no title line.
    """
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    from mcplan.cli.terminal import control, printable

    table = Table(box=None, show_header=bool(head), pad_edge=False, padding=(0, 2, 0, 0), header_style="bold")
    cells = [[printable(cell) for cell in row] for row in rows]
    columns = len(head) if head else len(cells[0])
    for i in range(columns):
        table.add_column(Text(head[i]) if head else "", no_wrap=i + 1 < columns)
    for row in cells:
        table.add_row(*(Text(cell) for cell in row))
    console = Console(width=None if sys.stdout.isatty() else 1000)
    with console.capture() as captured:
        console.print(table)
    text = "\n".join(line.rstrip() for line in captured.get().splitlines())
    control(sys.stdout, f"{text}\n")  # bold titles, in a terminal
