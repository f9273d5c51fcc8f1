"""What the plots of runs have in common: shaded phases, pushes, the fall, legends below."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan.tracking import Recording
from mcplan.view.colours import PUSH, TEXT
from mcplan.view.run_samples import push_text, pushes_of, stretches_of
from mcplan.view.runs import LEAST_S
from mcplan.view.sheets import label, legend, support_patches

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = NDArray[np.float64]


def shade_run(axes: Any, recording: Recording) -> None:
    """Tint planned stretches with no contact and with one; mark pushes, and the fall."""
    times = recording.times_s
    count = np.sum(recording.contacts_plan >= 0, axis=1)
    for contacts, patch in enumerate(support_patches()):
        for start, stop in stretches_of(count == contacts):
            until = times[min(stop, len(times) - 1)]
            axes.axvspan(times[start], until, color=patch.get_facecolor(), linewidth=0, zorder=0)
    for start, stop in pushes_of(recording):
        axes.axvspan(times[start], times[min(stop, len(times) - 1)], color=PUSH, alpha=0.28, linewidth=0, zorder=0.5)
    if np.isfinite(recording.fell_at_s):
        axes.axvline(recording.fell_at_s, color=TEXT, linewidth=1.6)


def finish(figure: Figure, axes: Any, recording: Recording, lines: Any = None) -> None:
    """Time axis, and a legend below the figure: of `lines`' curves and of what is shaded."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    for chart in axes[-1]:
        label(chart, x="time [s]")
    first, last = float(recording.times_s[0]), max(float(recording.times_s[-1]), LEAST_S)
    axes[0, 0].set_xlim(first, last + (0.004 * (last - first) if np.isfinite(recording.fell_at_s) else 0.0))
    handles = lines.get_legend_handles_labels()[0] if lines is not None else []
    count = np.sum(recording.contacts_plan >= 0, axis=1)
    handles += [patch for number, patch in enumerate(support_patches()) if (count == number).any()]
    texts = {push_text(recording, *push) for push in pushes_of(recording)}
    if texts:
        largest = float(np.linalg.norm(recording.pushes_W, axis=1).max())
        text = f"pushes of up to {largest:.0f} N" if len(texts) > 1 else texts.pop()
        handles.append(Patch(color=PUSH, alpha=0.28, label=text))
    if np.isfinite(recording.fell_at_s):
        handles.append(Line2D([], [], color=TEXT, linewidth=1.6, label="fall"))
    if handles:
        legend(figure, handles=handles, loc="outside lower center", ncol=len(handles))
