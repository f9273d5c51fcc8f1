"""mcplan scenes"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from mcplan.cli.terminal import say

if TYPE_CHECKING:
    from mcplan._core import Scene, Stance
    from mcplan.view import Page


def scenes(
    name: Annotated[str | None, typer.Argument(metavar="[NAME]", help="Scene: built-in name or TOML file.")] = None,
    html: Annotated[
        Path | None, typer.Option("--html", metavar="FILE", help="File for a page that shows the scene.")
    ] = None,
    robot: Annotated[
        str | None,
        typer.Option(
            "--robot",
            metavar="R",
            help="With --html: robot drawn at start and goal, built-in name or TOML file; "
            "default: humanoid44 where it is able to stand.",
        ),
    ] = None,
    seed: Annotated[
        int | None, typer.Option("--seed", metavar="SEED", help="Seed of the patches, for random_patches alone.")
    ] = None,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="FILE", help="TOML file for the scene.")
    ] = None,
) -> None:
    """List the built-in scenes, or print, draw or copy one.

    Example: mcplan scenes gap_with_rail --html rail.html --robot talos

    Example: mcplan scenes random_patches --seed 3 -o my.toml
    """
    from mcplan.cli.table import print_table
    from mcplan.errors import InvalidInput
    from mcplan.files.outputs import PAGE, TOML, require_target
    from mcplan.files.scenes import list_scenes, load_scene, save_scene

    if name is None:
        for option, value in (("--html", html), ("--robot", robot), ("--seed", seed), ("--output", output)):
            if value is not None:
                raise InvalidInput(option, "needs the NAME of a scene")
        print_table([entry, load_scene(entry).description] for entry in list_scenes())
        return
    if robot is not None and html is None:
        raise InvalidInput("--robot", "needs --html")
    require_target("--output", output, TOML)
    require_target("--html", html, PAGE)
    scene = load_scene(name) if seed is None else _seeded(name, seed)
    if output is not None:
        made = "" if seed is None else f" --seed {seed}"
        save_scene(scene, output, f"Made by: mcplan scenes {name}{made} -o {output}")
        say(f"Wrote {output}")
    if html is None:
        if output is None:
            _print_scene(scene)
        return
    from mcplan.extras import require

    require("mcplan scenes --html", "view", "meshcat")
    _page(scene, robot).save_html(html)
    say(f"Wrote {html}")


def _page(scene: Scene, robot: str | None) -> Page:
    """The scene with the robot asked for, else with the paper's humanoid or, where that cannot stand, with none."""
    from mcplan.errors import InvalidScene
    from mcplan.files.meeting import warn_of_names
    from mcplan.files.robots import load_robot
    from mcplan.view import show_scene

    if robot is not None:
        chosen = load_robot(robot)
        warn_of_names(scene, chosen)
        return show_scene(scene, chosen)
    try:
        return show_scene(scene, load_robot("humanoid44"))
    except InvalidScene:
        return show_scene(scene)


def _seeded(name: str, seed: int) -> Scene:
    from mcplan.errors import InvalidInput, shown
    from mcplan.files.terrains import random_patches

    if name != "random_patches":
        raise InvalidInput("--seed", "is for random_patches alone", shown(name))
    return random_patches(seed)


def _print_scene(scene: Scene) -> None:
    from mcplan._core import Polygon
    from mcplan.cli.table import print_table

    say(f"{scene.name}: {scene.description}" if scene.description else scene.name)
    say(f"gravity {scene.gravity:g} m/s^2")
    for field, stance in (("start", scene.start), ("goal", scene.goal)):
        say(_stance_line(field, stance))
    for rule in scene.rules:
        say(f"rule    when {_listed(rule.when_free)} is free, {_listed(rule.require)} must be in contact")
    if scene.steps:
        say("steps   " + ", ".join(f"{step.end_effector} on {step.surface}" for step in scene.steps))
    say()
    rows = []
    for surface in scene.surfaces:
        polygon = Polygon(surface.vertices_W)
        rows.append(
            [
                surface.name,
                _numbers(polygon.centroid_W),
                _numbers(polygon.normal_W),
                str(len(surface.vertices_W)),
                "grasp" if surface.grasp else f"{surface.friction:g}",
                ", ".join(surface.end_effectors) or "all",
            ]
        )
    print_table(rows, ["surface", "centre [m]", "normal", "corners", "friction", "allowed contacts"])


def _stance_line(field: str, stance: Stance) -> str:
    contacts = ", ".join(f"{who} on {surface}" for who, surface in stance.contacts.items())
    return f"{field:7} {_numbers(stance.position_W)} m, yaw {stance.yaw:g} rad: {contacts}"


def _listed(names: tuple[str, ...]) -> str:
    return " and ".join(names)


def _numbers(values: object) -> str:
    return " ".join(f"{value:.3f}" for value in values)  # type: ignore[attr-defined]
