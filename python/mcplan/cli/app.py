"""The verbs put together: those of mcplan, and those that other distributions plug in."""

from __future__ import annotations

from importlib import metadata
from typing import Annotated

import typer

from mcplan.cli import (
    check,
    demo,
    export,
    motion,
    plan,
    rhp,
    robots,
    run,
    scenes,
    schema,
    show,
    sip,
    sweep,
    tasks,
    track,
    version,
)
from mcplan.errors import MissingExtra

app = typer.Typer(
    help="Multi-contact motion planning: which limb is in contact with what, when and where.",
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
    motion.motion,
    check.check,
    track.track,
    run.run,
    show.show,
    sweep.sweep,
    export.export,
    scenes.scenes,
    robots.robots,
    tasks.tasks,
    schema.schema,
    version.version,
)
for verb in verbs:
    app.command(verb.__name__)(verb)


def _print_version(asked: bool) -> None:
    if asked:
        version.version()
        raise typer.Exit


@app.callback()
def main(
    version: Annotated[  # noqa: ARG001  read by its callback
        bool, typer.Option("--version", is_eager=True, callback=_print_version, help="Print what mcplan version does.")
    ] = False,
) -> None:
    """Multi-contact motion planning: which limb is in contact with what, when and where."""


#: An earlier name of `tasks`, for one release.
app.command("motions", hidden=True)(tasks.tasks)

#: Entry points that are verbs: a function or a Typer application each.
GROUP = "mcplan.commands"
#: Verbs of a distribution of their own, and what installs it.
APART = dict.fromkeys(("bench", "reproduce"), "mcplan-bench: pip install ./bench in the source tree of mcplan")


def complete(word: str) -> None:
    """Plug in the verbs of other distributions, unless the word is a verb of ours: looking for them takes time.

    Args:
        word: The first one after ``mcplan``.

    Raises:
        MissingExtra: The word is a verb that comes with a distribution that is not installed.
    """
    known = _names()
    if word in known:
        return
    for point in sorted(metadata.entry_points(group=GROUP), key=lambda point: point.name):
        if point.name not in known:
            plugged = point.load()
            if isinstance(plugged, typer.Typer):
                app.add_typer(plugged, name=point.name)
            else:
                app.command(point.name)(plugged)
    if word in APART and word not in _names():
        raise MissingExtra(f"mcplan {word} needs {APART[word]}")


def _names() -> set[str | None]:
    return {verb.name for verb in app.registered_commands} | {verb.name for verb in app.registered_groups}
