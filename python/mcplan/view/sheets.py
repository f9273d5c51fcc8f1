"""Style of the plots: one look for all figures, drawn without a display."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan.extras import require
from mcplan.files.outputs import made_folder, whole_file

from .colours import TEXT

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from mcplan.kinematics.samples import Samples

Array = NDArray[np.float64]

QUIET = "#6B7480"


def save_figure(figure: Figure, path: str | Path, **options: Any) -> Path:
    """Write a figure to a file (.png, .pdf, .svg; a device: PNG), which is complete or not there at all.

    Args:
        figure: The figure.
        path: File to write.
        **options: Of matplotlib's ``savefig``.

    Raises:
        OSError: The file cannot be written.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    kind = Path(path).suffix.lower()[1:] or "png"
    about = {"Software": None} if kind == "png" else None  # its version: the same figure gives the same bytes
    with whole_file(path) as temporary:
        if kind == "png" and not options:
            FigureCanvasAgg(figure).print_png(temporary, metadata=about)  # savefig would draw twice, once to lay it out
        else:
            figure.savefig(temporary, format=kind, metadata=about, **options)
    return Path(path)


def save_figures(figures: Mapping[str, Figure], folder: str | Path) -> list[Path]:
    """Write each figure to NAME.png in a folder, which is made if it does not exist; the files written."""
    folder = made_folder(folder)
    return [save_figure(figure, folder / f"{name}.png") for name, figure in figures.items()]


def sheet(rows: int, columns: int = 1, size: tuple[float, float] = (9.0, 4.0), **options: Any) -> tuple[Figure, Array]:
    """A figure with rows x columns axes (an array of that shape); size in inches.

    Raises:
        MissingExtra: matplotlib is not installed.
    """
    require("mcplan.view.plots", "view", "matplotlib")
    figure = blank_sheet(size, constrained=True)
    axes = np.asarray(figure.subplots(rows, columns, squeeze=False, **options))
    for each in axes.flat:
        for side in ("top", "right"):
            each.spines[side].set_visible(False)
        for side in ("left", "bottom"):
            each.spines[side].set_color(QUIET)
        each.tick_params(colors=QUIET, labelsize=9, labelcolor=TEXT)
        each.grid(True, color="#E8EBEE", linewidth=0.7)
        each.set_axisbelow(True)
    return figure, axes


def blank_sheet(size: tuple[float, float], constrained: bool = False) -> Figure:
    """A white figure without axes; size in inches; `constrained`: matplotlib places what is added."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=size, dpi=140, facecolor="white", layout="constrained" if constrained else None)
    FigureCanvasAgg(figure)
    return figure


def label(axes: Any, x: str = "", y: str = "", title: str = "") -> None:
    """Labels of axes, in the sheet's type."""
    if x:
        axes.set_xlabel(x, fontsize=10, color=TEXT)
    if y:
        axes.set_ylabel(y, fontsize=10, color=TEXT)
    if title:
        axes.set_title(title, fontsize=11, color=TEXT, loc="left", fontweight="bold")


def legend(axes: Any, **options: Any) -> None:
    """A legend without a frame; below the figure when `axes` is a figure."""
    axes.legend(frameon=False, fontsize=9, labelcolor=TEXT, **options)


def shade_support(axes: Any, samples: Samples) -> None:
    """Tint the stretches with no contact and those with one."""
    count = np.sum(samples.surfaces >= 0, axis=1)
    starts = np.flatnonzero(np.concatenate([[True], count[1:] != count[:-1]]))
    ends = np.append(starts[1:], len(count) - 1)
    for start, end in zip(starts, ends, strict=True):
        tint = {0: "#F6D8CC", 1: "#EEF1F5"}.get(int(count[start]))
        if tint:
            axes.axvspan(samples.times_s[start], samples.times_s[end], color=tint, linewidth=0, zorder=0)


def support_patches() -> list[Any]:
    """Legend entries for shade_support."""
    from matplotlib.patches import Patch

    return [Patch(color="#F6D8CC", label="flight"), Patch(color="#EEF1F5", label="one contact")]
