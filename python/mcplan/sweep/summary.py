"""The summary page of a sweep: one HTML file with its plots inside, which needs no network."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from html import escape
from typing import Any

from mcplan.errors import printable
from mcplan.view.colours import COOL, WARM

Record = Mapping[str, Any]
_COLOURS = (COOL[0], WARM[0], COOL[2], WARM[1], COOL[1], WARM[2])
_BINS, _WIDTH, _HEIGHT, _MARGIN = 10, 380, 190, 38
_MAX_LISTED = 100

_STYLE = """
body { background: #fff; color: #22262b; margin: 24px auto; max-width: 1240px; padding: 0 20px;
  font: 13px/1.45 system-ui, "Segoe UI", "Helvetica Neue", "DejaVu Sans", sans-serif; }
h1 { font-size: 17px; font-weight: 650; margin: 0; } h2 { font-size: 14px; font-weight: 650; margin: 24px 0 8px; }
p { color: #5b6470; margin: 2px 0 10px; } table { border-collapse: collapse; } th { text-align: left; font-weight: 650; }
td, th { padding: 3px 14px 3px 0; border-bottom: 1px solid #e3e6ea; font-variant-numeric: tabular-nums; }
.plots { display: flex; flex-wrap: wrap; gap: 14px; } figure { margin: 0; border: 1px solid #e3e6ea; border-radius: 8px;
  padding: 10px; } figcaption { font-weight: 650; } svg text { font-size: 11px; fill: #5b6470; }
.key { display: inline-block; width: 10px; height: 10px; border-radius: 3px; margin: 0 5px 0 14px; }
"""


def summary_page(manifest: Mapping[str, Any], records: Sequence[Record], times: Sequence[Record]) -> str:
    """The page as text.

    Args:
        manifest: Of the sweep.
        records: What is known of each task.
        times: Of each task, in the same order.
    """
    robots = list(dict.fromkeys(str(record["robot"]) for record in records))
    solved = sum(_solved(record) for record in records)
    versions = ", ".join(f"{name} {version}" for name, version in manifest["versions"].items())
    keys = "".join(
        f'<span class="key" style="background:{_COLOURS[i % len(_COLOURS)]}"></span>{_text(robot)}'
        for i, robot in enumerate(robots)
    )
    plots = "".join(_success_plots(records, robots)) + _times_plot(records, times, robots)
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f"<title>{_text(manifest['name'])}</title>\n<style>{_STYLE}</style>\n</head>\n<body>\n"
        f"<h1>{_text(manifest['name'])}</h1>\n"
        f"<p>{solved} of {len(records)} tasks solved. Seed {manifest['seed']}; {_text(versions)}</p>\n"
        f"<h2>Tasks by scene and robot</h2>\n{_counts(records)}\n"
        f"<h2>Success over parameters, and processor times</h2>\n<p>Robots: {keys}</p>\n"
        f'<div class="plots">{plots}</div>\n<h2>Not solved</h2>\n{_failures(records)}\n</body>\n</html>\n'
    )


def _solved(record: Record) -> bool:
    return bool(record["status"] == "solved")


def _counts(records: Sequence[Record]) -> str:
    groups: dict[tuple[str, str], list[Record]] = {}
    for record in records:
        groups.setdefault((str(record["entry"]), str(record["robot"])), []).append(record)
    rows = []
    for (entry, robot), group in groups.items():
        statuses = Counter(str(record["status"]) for record in group if not _solved(record))
        others = ", ".join(f"{count} {status}" for status, count in sorted(statuses.items()))
        good = sum(map(_solved, group))
        rows.append((entry, robot, f"{good} of {len(group)}", f"{100 * good / len(group):.0f} %", others))
    return _table(("scene", "robot", "solved", "", "others"), rows)


def _failures(records: Sequence[Record]) -> str:
    bad = [record for record in records if not _solved(record)]
    rows = []
    for record in bad[:_MAX_LISTED]:
        given = {**record["parameters"], **record["options"]}
        shown = " ".join(f"{k}={v:.4g}" if isinstance(v, float) else f"{k}={v}" for k, v in given.items())
        rows.append((record["task"], record["entry"], record["robot"], shown, record["status"], record["message"]))
    more = f"<p>And {len(bad) - _MAX_LISTED} more, in index.parquet.</p>" if len(bad) > _MAX_LISTED else ""
    return _table(("task", "scene", "robot", "given", "status", "message"), rows) + more if rows else "<p>None.</p>"


def _success_plots(records: Sequence[Record], robots: Sequence[str]) -> list[str]:
    """For each entry and each number that varies in it: the ratio of solved tasks, in bins, by robot."""
    out = []
    for entry in dict.fromkeys(str(record["entry"]) for record in records):
        group = [record for record in records if record["entry"] == entry]
        for kind in ("parameters", "options"):
            for name in group[0][kind]:
                if name == "seed":
                    continue
                values = [record[kind].get(name) for record in group]
                if all(isinstance(v, int | float) and not isinstance(v, bool) for v in values) and len(set(values)) > 1:
                    out.append(_success_plot(f"{entry}: solved over {name}", values, group, robots))
    return out


def _success_plot(title: str, values: Sequence[Any], group: Sequence[Record], robots: Sequence[str]) -> str:
    low, high = min(values), max(values)
    few = sorted(set(values)) if len(set(values)) <= _BINS else None
    lines = []
    for i, robot in enumerate(robots):
        bins: dict[float, list[bool]] = {}
        for value, record in zip(values, group, strict=True):
            if record["robot"] == robot:
                middle = low + (int(_BINS * (value - low) / (high - low) - 1e-9) + 0.5) * (high - low) / _BINS
                bins.setdefault(value if few else middle, []).append(_solved(record))
        lines.append((i, [(x, sum(good) / len(good), len(good)) for x, good in sorted(bins.items())]))
    return _figure(title, (low, high), (0.0, 1.0), lines, ("0", "100 %"))


def _times_plot(records: Sequence[Record], times: Sequence[Record], robots: Sequence[str]) -> str:
    """Ratio of tasks that took at most so long."""
    lines = []
    for i, robot in enumerate(robots):
        mine = sorted(t["cpu_s"] for r, t in zip(records, times, strict=True) if r["robot"] == robot and "cpu_s" in t)
        lines.append((i, [(second, (k + 1) / len(mine), 0) for k, second in enumerate(mine)]))
    largest = max((points[-1][0] for _, points in lines if points), default=1.0)
    return _figure("Ratio of tasks within a processor time [s]", (0.0, largest), (0.0, 1.0), lines, ("0", "100 %"))


def _figure(
    title: str,
    x: tuple[float, float],
    y: tuple[float, float],
    lines: Sequence[tuple[int, list[tuple[float, float, int]]]],
    ends: tuple[str, str],
) -> str:
    """Lines over a number; points that stand for several tasks tell of how many."""

    def at(point: tuple[float, float, int]) -> tuple[float, float]:
        across = (point[0] - x[0]) / ((x[1] - x[0]) or 1.0)
        up = (point[1] - y[0]) / (y[1] - y[0])
        return _MARGIN + across * (_WIDTH - _MARGIN - 14), _HEIGHT - 22 - up * (_HEIGHT - 34)

    left, bottom = at((x[0], y[0], 0))
    right, top = at((x[1], y[1], 0))
    parts = [f'<path d="M{left:.1f} {top:.1f}V{bottom:.1f}H{right:.1f}" fill="none" stroke="#8a919c"/>']
    for text, height in zip(ends, (bottom, top), strict=True):
        parts.append(f'<text x="{left - 5:.1f}" y="{height + 4:.1f}" text-anchor="end">{text}</text>')
    for value, anchor in ((x[0], "start"), (x[1], "end")):
        place = left if anchor == "start" else right
        parts.append(f'<text x="{place:.1f}" y="{bottom + 15:.1f}" text-anchor="{anchor}">{value:.4g}</text>')
    for index, points in lines:
        colour = _COLOURS[index % len(_COLOURS)]
        path = " ".join(f"{a:.1f},{b:.1f}" for a, b in map(at, points))
        parts.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="1.8"/>')
        for point in points:
            if point[2]:
                a, b = at(point)
                told = f"{point[0]:.4g}: {100 * point[1]:.0f} % of {point[2]}"
                parts.append(f'<circle cx="{a:.1f}" cy="{b:.1f}" r="3" fill="{colour}"><title>{told}</title></circle>')
    svg = f'<svg width="{_WIDTH}" height="{_HEIGHT}" role="img">{"".join(parts)}</svg>'
    return f"<figure><figcaption>{_text(title)}</figcaption>{svg}</figure>"


def _table(head: Sequence[str], rows: Sequence[Sequence[Any]]) -> str:
    lines = ["<tr>" + "".join(f"<th>{_text(cell)}</th>" for cell in head) + "</tr>"]
    lines += ["<tr>" + "".join(f"<td>{_text(cell)}</td>" for cell in row) + "</tr>" for row in rows]
    return "<table>" + "\n".join(lines) + "</table>"


def _text(value: Any) -> str:
    return escape(printable(str(value)))
