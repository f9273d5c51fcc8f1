"""How notebooks show plans and results: as a picture, with the report above it."""

from __future__ import annotations

import base64
import html
import tempfile
from pathlib import Path
from typing import Any

from mcplan import _core
from mcplan.errors import InvalidInput, MissingExtra


def plan_html(plan: Any) -> str:
    """The picture of a plan of either kind in HTML, or its repr where nothing can be drawn.

    Args:
        plan: A Plan or a PlanarPlan.
    """
    from mcplan.showing import save_picture

    line = f"<pre>{html.escape(repr(plan))}</pre>"
    try:
        with tempfile.TemporaryDirectory() as folder:
            content = save_picture(plan, Path(folder) / "plan.png").read_bytes()
    except MissingExtra as missing:
        return f"{line}<p>{html.escape(str(missing))}</p>"
    except InvalidInput:  # an edited plan, or none
        return line
    data = base64.b64encode(content).decode("ascii")
    return f'{line}<img alt="{html.escape(repr(plan))}" style="max-width: 100%" src="data:image/png;base64,{data}">'


def result_html(result: Any) -> str:
    """The report of a result and its plan in HTML.

    Args:
        result: What an engine returns: it has a plan and a report.
    """
    return f"<pre>{html.escape(str(result.report))}</pre>{plan_html(result.plan)}"


def _give() -> None:
    plans: tuple[Any, ...] = (_core.Plan, _core.PlanarPlan)
    results: tuple[Any, ...] = (_core.PlanResult, _core.rhp.Walk, _core.sip.Result)
    for owner in plans:
        owner._repr_html_ = plan_html
    for owner in results:
        owner._repr_html_ = result_html


_give()
