"""The verbs put together."""

from __future__ import annotations

import typer

from mcplan.cli import bench, check, demo, motions, plan, reproduce, rhp, robots, scenes, sip, track, version

app = typer.Typer(
    help="Multi-contact motion planning: which limb touches what, when and where.",
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"]},
)
verbs = (
    demo.demo,
    plan.plan,
    rhp.rhp,
    sip.sip,
    check.check,
    track.track,
    scenes.scenes,
    robots.robots,
    motions.motions,
    reproduce.reproduce,
    version.version,
)
for verb in verbs:
    app.command(verb.__name__)(verb)
app.add_typer(bench.app, name="bench")
