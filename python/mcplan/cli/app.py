"""The verbs put together."""

from __future__ import annotations

import typer

from mcplan.cli import bench, check, demo, plan, reproduce, robots, scenes, version

app = typer.Typer(
    help="Multi-contact motion planning: which limb touches what, when and where.",
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"]},
)
for verb in (demo.demo, plan.plan, check.check, scenes.scenes, robots.robots, reproduce.reproduce, version.version):
    app.command(verb.__name__)(verb)
app.add_typer(bench.app, name="bench")
