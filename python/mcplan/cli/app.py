"""The verbs put together."""

from __future__ import annotations

import typer

from mcplan.cli import check, plan, robots, scenes, version

app = typer.Typer(
    help="Multi-contact motion planning: which limb touches what, when and where.",
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"]},
)
for verb in (plan.plan, check.check, scenes.scenes, robots.robots, version.version):
    app.command(verb.__name__)(verb)
