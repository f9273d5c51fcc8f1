"""Valid planar robot and task data to break in one place, and the ways in which they are broken."""

from __future__ import annotations

from typing import Any

from malformed import DELETE, INF, NAN, Break

# A body with two legs of one link each, feet 0.5 m below the hips.
ROBOT: dict[str, Any] = {
    "name": "compass",
    "gravity": 9.81,
    "bodies": [
        {"name": "hip", "mass": 5.0, "inertia": 0.05},
        {
            "name": "left",
            "parent": "hip",
            "joint": [0.0, 0.0],
            "offset": -0.2,
            "mass": 1.0,
            "com": [0.0, -0.2],
            "inertia": 0.01,
            "position_min": -1.0,
            "position_max": 1.0,
            "velocity_max": 6.0,
            "torque_max": 40.0,
            "capsules": [{"from": [0.0, 0.0], "to": [0.0, -0.5], "radius": 0.03}],
        },
        {
            "name": "right",
            "parent": "hip",
            "offset": 0.2,
            "mass": 1.0,
            "com": [0.0, -0.2],
            "inertia": 0.01,
            "capsules": [{"from": [0.0, 0.0], "to": [0.0, -0.5], "radius": 0.03}],
        },
    ],
    "end_effectors": [
        {"name": "left_foot", "body": "left", "position": [0.0, -0.5], "points": [-0.05, 0.05]},
        {"name": "right_foot", "body": "right", "position": [0.0, -0.5], "points": [-0.05, 0.05]},
    ],
    "collision_pairs": [["left", "right"]],
}

TASK: dict[str, Any] = {
    "name": "step",
    "robot": ROBOT,
    "surfaces": [
        {"name": "floor", "friction": 0.8, "extent": [-1.0, 2.0]},
        {"name": "wall", "origin": [-0.5, 0.0], "angle": -1.5},
    ],
    "phases": [
        {
            "contacts": [
                {"end_effector": "right_foot", "surface": "floor", "at": 0.1},
                {"end_effector": "left_foot", "surface": "floor", "position": [-0.1, 0.0]},
            ]
        },
        {
            "lift": ["left_foot"],
            "min_duration": 0.2,
            "max_duration": 2.0,
            "clearances": [
                {"end_effector": "left_foot", "surface": "floor", "middle_height": 0.02},
                {"end_effector": "left_foot", "surface": "wall", "first_interval": 1, "end_interval": 2},
            ],
            "poses": [{"body": "hip", "fraction": 0.5, "x": [0.0, 0.2], "y": [0.3, INF]}],
        },
        {"place": [{"end_effector": "left_foot", "surface": "floor", "at": 0.3, "turns": 1}], "intervals": 5},
    ],
}

ROBOT_BREAKS: list[Break] = [
    (("gravity",), -1.0, "gravity", "must be a positive number"),
    (("gravity",), 0, "gravity", "must be a positive number"),
    (("bodys",), [], "bodys", "no such key. Did you mean 'bodies'? Keys: name, description, gravity, bodies"),
    (("bodies",), DELETE, "bodies", "is required"),
    (("bodies",), [], "bodies", "needs at least 1 entry"),
    (("bodies", 1, "name"), DELETE, "bodies[1].name", "is required"),
    (("bodies", 2, "name"), "left", "bodies[2].name", "must be unique"),
    (("bodies", 1, "mass"), 0.0, "bodies[1].mass", "must be a positive number, got 0.0"),
    (("bodies", 1, "mass"), DELETE, "bodies[1].mass", "is required"),
    (("bodies", 1, "inertia"), 0, "bodies[1].inertia", "must be a positive number"),
    (("bodies", 1, "inertia"), NAN, "bodies[1].inertia", "must be a finite number"),
    (("bodies", 1, "masss"), 1.0, "bodies[1].masss", "no such key. Did you mean 'mass'?"),
    (("bodies", 0, "parent"), "left", "bodies[0].parent", "must be left out for the first body"),
    (("bodies", 1, "parent"), DELETE, "bodies[1].parent", "is required of every body but the first"),
    (("bodies", 1, "parent"), "hipp", "bodies[1].parent", "must name a body above this one. Did you mean 'hip'?"),
    (("bodies", 1, "parent"), "right", "bodies[1].parent", "must come before its children"),
    (("bodies", 1, "parent"), "left", "bodies[1].parent", 'no body may be its own ancestor, got "left"'),
    (("bodies", 1, "joint"), [0.0], "bodies[1].joint", "needs at least 2 entries, got 1"),
    (("bodies", 1, "joint", 0), INF, "bodies[1].joint[0]", "must be a finite number"),
    (("bodies", 1, "position_max"), -2.0, "bodies[1].position_max", "must exceed position_min"),
    (("bodies", 1, "velocity_max"), 0.0, "bodies[1].velocity_max", "must be a positive number"),
    (("bodies", 1, "torque_max"), -3.0, "bodies[1].torque_max", "must be a positive number"),
    (("bodies", 1, "capsules", 0, "radius"), 0.0, "bodies[1].capsules[0].radius", "must be a positive number"),
    (("bodies", 1, "capsules", 0, "from"), DELETE, "bodies[1].capsules[0].from", "is required"),
    (("bodies", 1, "capsules", 0, "radios"), 1.0, "bodies[1].capsules[0].radios", "Keys: from, to, radius"),
    (("end_effectors",), [], "end_effectors", "needs at least 1 entry"),
    (
        ("end_effectors", 0, "body"),
        "lleft",
        "end_effectors[0].body",
        "Did you mean 'left'? There are: hip, left, right",
    ),
    (("end_effectors", 0, "points"), [], "end_effectors[0].points", "needs at least 1 entry"),
    (("end_effectors", 0, "points"), [0.1, 0.1], "end_effectors[0].points", "must differ"),
    (("end_effectors", 1, "name"), "left_foot", "end_effectors[1].name", "must be unique"),
    (("collision_pairs", 0), ["left"], "collision_pairs[0]", "needs at least 2 entries"),
    (("collision_pairs", 0, 1), "arm", "collision_pairs[0][1]", "must name a body"),
    (("collision_pairs", 0, 1), "left", "collision_pairs[0]", "must be two different bodies"),
    (("collision_pairs", 0, 1), "hip", "collision_pairs[0]", "must be bodies with capsules"),
]

TASK_BREAKS: list[Break] = [
    (("robot",), DELETE, "robot", "is required"),
    (("robot",), 9, "robot", "must be a name, a path or a table"),
    (("robot",), "", "robot", 'must be a name, a path or a table, got ""'),
    (("surfaces",), [], "surfaces", "needs at least 1 entry"),
    (("surfaces", 1, "name"), "floor", "surfaces[1].name", "must be unique"),
    (("surfaces", 0, "friction"), 0.0, "surfaces[0].friction", "must be a positive number"),
    (("surfaces", 0, "frction"), 0.5, "surfaces[0].frction", "no such key. Did you mean 'friction'?"),
    (("surfaces", 0, "extent"), [2.0, -1.0], "surfaces[0].extent", "must exceed from"),
    (("surfaces", 0, "extent"), [1.0], "surfaces[0].extent", "needs at least 2 entries"),
    (("phases",), [], "phases", "needs at least 1 entry"),
    (("phases", 0), {}, "phases[0].contacts", "is required"),
    (("phases", 0), {"lift": ["left_foot"]}, "phases[0].contacts", "is required of the first phase"),
    (("phases", 2), {}, "phases[2].contacts", "is required, or lift or place"),
    (("phases", 0, "lift"), ["left_foot"], "phases[0].lift", "may not stand beside contacts"),
    (("phases", 1, "lift"), ["left_foot", "right_foot"], "phases[1].lift", "must leave one contact at least"),
    (("phases", 1, "lift"), ["left_fot"], "phases[1].lift[0]", "Did you mean 'left_foot'?"),
    (("phases", 2, "lift"), ["left_foot"], "phases[2].lift[0]", "must be in contact in the phase before"),
    (("phases", 2, "place", 0, "end_effector"), "right_foot", "phases[2].place[0].end_effector", "lift it first"),
    (("phases", 0, "contacts", 0, "surface"), DELETE, "phases[0].contacts[0].surface", "is required"),
    (
        ("phases", 0, "contacts", 0, "surface"),
        "flor",
        "phases[0].contacts[0].surface",
        "must name one of the surfaces. Did you mean 'floor'? There are: floor, wall, got \"flor\"",
    ),
    (
        ("phases", 0, "contacts", 0, "end_effector"),
        "hand",
        "phases[0].contacts[0].end_effector",
        "must name an end-effector of the robot. There are: left_foot, right_foot",
    ),
    (("phases", 0, "contacts", 1, "end_effector"), "right_foot", "phases[0].contacts[1].end_effector", "already"),
    (("phases", 0, "contacts", 0, "at"), DELETE, "phases[0].contacts[0].at", "is required, or position"),
    (("phases", 0, "contacts", 1, "at"), 0.3, "phases[0].contacts[1].at", "may not stand beside position"),
    (("phases", 2, "place", 0, "angle"), 0.3, "phases[2].place[0].turns", "may not stand beside angle"),
    (("phases", 2, "place", 0, "turns"), 0.5, "phases[2].place[0].turns", "must be a whole number"),
    # Said by the C++ classes, which know contacts in the order of the robot's end-effectors:
    (("phases", 0, "contacts", 0, "at"), 1.98, "phases[0].contacts[0].at", "must keep all points within the extent"),
    (("phases", 0, "contacts", 1, "position"), [-0.1, 0.2], "phases[0].contacts[1].position", "must lie on"),
    (("phases", 0, "contacts", 1, "angle"), 0.3, "phases[0].contacts[1].angle", "must be that of"),
    (("phases", 2, "place", 0, "at"), 1.5, "phases[2].place", 'right_foot must be within 1 m of "left_foot"'),
    (("phases", 1, "intervals"), 0, "phases[1].intervals", "must be at least 1"),
    (("phases", 1, "intervals"), 2.5, "phases[1].intervals", "must be a whole number"),
    (("phases", 1, "max_duration"), 0.0, "phases[1].max_duration", "must be a positive number"),
    (("phases", 1, "max_duration"), 0.1, "phases[1].max_duration", "not below min_duration"),
    (("phases", 1, "min_duration"), -1.0, "phases[1].min_duration", "must be at least 0"),
    (("phases", 1, "duration"), 1.0, "phases[1].duration", "no such key. Did you mean 'min_duration'?"),
    (
        ("phases", 1, "clearances", 0, "end_effector"),
        "right_foot",
        "phases[1].clearances[0].end_effector",
        "must not be in contact",
    ),
    (("phases", 1, "clearances", 0, "surface"), "roof", "phases[1].clearances[0].surface", "one of the surfaces"),
    (("phases", 1, "clearances", 1, "end_interval"), 5, "phases[1].clearances[1].end_interval", "must be -1 or lie in"),
    (
        ("phases", 1, "clearances", 1, "first_interval"),
        4,
        "phases[1].clearances[1].first_interval",
        "must be an interval",
    ),
    (
        ("no_clearance",),
        [{"end_effector": "left_fot", "surface": "wall"}],
        "no_clearance[0].end_effector",
        "must name an end-effector of the robot. Did you mean 'left_foot'?",
    ),
    (
        ("no_clearance",),
        [{"end_effector": "left_foot", "surface": "roof"}],
        "no_clearance[0].surface",
        "must name one of the surfaces",
    ),
    (("no_clearance",), [{"end_effector": "left_foot"}], "no_clearance[0].surface", "is required"),
    (
        ("no_clearance",),
        2 * [{"end_effector": "right_foot", "surface": "wall"}],
        "no_clearance[1].surface",
        "must not be there twice",
    ),
    (
        ("no_clearance",),
        [{"end_effector": "left_foot", "surface": "wall"}],
        "phases[1].clearances[1].surface",
        'must not be in no_clearance together with "left_foot"',
    ),
    (("no_clearances",), [], "no_clearances", "no such key. Did you mean 'no_clearance'?"),
    (("phases", 1, "poses", 0, "body"), "hips", "phases[1].poses[0].body", "Did you mean 'hip'?"),
    (("phases", 1, "poses", 0, "fraction"), 1.5, "phases[1].poses[0].fraction", "must be at most 1"),
    (("phases", 1, "poses", 0, "x"), [0.3, 0.1], "phases[1].poses[0].x", "from not above to, got [0.3, 0.1]"),
]
