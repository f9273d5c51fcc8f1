"""Valid scene and robot data to break in one place, and the ways in which they are broken."""

from __future__ import annotations

import copy
from typing import Any

NAN, INF = float("nan"), float("inf")
SQUARE = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]
DELETE = object()

SCENE: dict[str, Any] = {
    "name": "room",
    "gravity": 9.8,
    "surfaces": [
        {"name": "floor", "vertices": SQUARE, "friction": 0.6, "end_effectors": ["foot"]},
        {"name": "pad", "vertices": [[2.0, 0.0, 1.0], [3.0, 0.0, 1.0], [2.0, 1.0, 1.0]], "grasp": True},
    ],
    "start": {"position": [0.5, 0.5, 0.0], "contacts": {"foot": "floor"}},
    "goal": {"position": [0.6, 0.5, 0.0], "yaw": 0.1, "contacts": {"foot": "floor"}},
    "rules": [{"when_free": ["foot"], "require": ["hand"]}],
    "steps": [{"end_effector": "leg", "surface": "floor"}],
}

ROBOT: dict[str, Any] = {
    "name": "hopper",
    "mass": 10.0,
    "inertia": [1.0, 1.0, 1.0],
    "com_height": 0.5,
    "swing_height": 0.1,
    "posture": {"knee": 0.3},
    "end_effectors": [
        {
            "name": "leg",
            "kind": "foot",
            "half_size": [0.1, 0.05],
            "nominal": [0.0, 0.0, -0.5],
            "reach_min": [-0.2, -0.2, -0.6],
            "reach_max": [0.2, 0.2, -0.3],
            "max_force": 400.0,
            "max_moment": [0.0, 0.0, 1.0],
            "yaw_range": [-0.4, 0.6],
            "com_reach": {"A": [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]], "b": [0.6, -0.3]},
            "partner_reach": {"arm": {"A": [[1.0, 0.0, 0.0]], "b": [0.4]}},
            "limb": {
                "hip": [0.0, 0.0, -0.05],
                "upper": 0.25,
                "lower": 0.25,
                "ankle": [0.0, 0.0, 0.05],
                "knee_torque": 90.0,
            },
        },
        {
            "name": "arm",
            "kind": "hand",
            "nominal": [0.2, 0, 0],
            "reach_min": [0, -0.2, -0.2],
            "reach_max": [0.4, 0.2, 0.2],
        },
    ],
}

# (path of the value, value put there, field named in the error, part of the rule)
Break = tuple[tuple[Any, ...], Any, str, str]

SCENE_BREAKS: list[Break] = [
    (("gravity",), 0.0, "gravity", "must be a positive number"),
    (("gravity",), -9.8, "gravity", "must be a positive number"),
    (("gravity",), NAN, "gravity", "must be a finite number"),
    (("gravity",), INF, "gravity", "must be a finite number"),
    (("gravity",), "9.8", "gravity", "must be a number"),
    (("gravity",), True, "gravity", "must be a number"),
    (("gravitiy",), 9.8, "gravitiy", "no such key. Did you mean 'gravity'? Keys: name, description, gravity"),
    (("name",), 7, "name", "must be a string"),
    (("description",), [], "description", "must be a string"),
    (("surfaces",), DELETE, "surfaces", "is required"),
    (("surfaces",), [], "surfaces", "needs at least 1 entry"),
    (("surfaces",), {}, "surfaces", "must be a list"),
    (("surfaces", 0), "floor", "surfaces[0]", "must be a table"),
    (("surfaces", 0, "name"), DELETE, "surfaces[0].name", "is required"),
    (("surfaces", 0, "name"), "", "surfaces[0].name", "must not be empty"),
    (("surfaces", 1, "name"), "floor", "surfaces[1].name", "must be unique"),
    (("surfaces", 0, "frction"), 0.5, "surfaces[0].frction", "Did you mean 'friction'?"),
    (("surfaces", 0, "friction"), 0.0, "surfaces[0].friction", "must be a positive number"),
    (("surfaces", 0, "friction"), -0.1, "surfaces[0].friction", "must be a positive number"),
    (("surfaces", 0, "friction"), NAN, "surfaces[0].friction", "must be a finite number"),
    (("surfaces", 0, "grasp"), 1, "surfaces[0].grasp", "must be true or false"),
    (("surfaces", 0, "grasp"), "yes", "surfaces[0].grasp", "must be true or false"),
    (("surfaces", 0, "thickness"), 0.0, "surfaces[0].thickness", "must be a positive number"),
    (("surfaces", 0, "thickness"), INF, "surfaces[0].thickness", "must be a finite number"),
    (("surfaces", 0, "end_effectors"), "foot", "surfaces[0].end_effectors", "must be a list"),
    (("surfaces", 0, "end_effectors", 0), 3, "surfaces[0].end_effectors[0]", "must be a string"),
    (("surfaces", 0, "end_effectors", 0), "", "surfaces[0].end_effectors[0]", "must not be empty"),
    (("surfaces", 0, "vertices"), DELETE, "surfaces[0].vertices", "is required"),
    (("surfaces", 0, "vertices"), 4.0, "surfaces[0].vertices", "must be a list"),
    (("surfaces", 0, "vertices"), [], "surfaces[0].vertices", "needs at least 3 points, got 0"),
    (("surfaces", 0, "vertices"), SQUARE[:2], "surfaces[0].vertices", "needs at least 3 points, got 2"),
    (
        ("surfaces", 0, "vertices", 2),
        [1.0, 1.0],
        "surfaces[0].vertices[2]",
        "needs at least 3 entries, got 2",
    ),
    (
        ("surfaces", 0, "vertices", 2),
        [1.0] * 4,
        "surfaces[0].vertices[2]",
        "may have 3 entries at most, got 4",
    ),
    (("surfaces", 0, "vertices", 2), 1.0, "surfaces[0].vertices[2]", "must be a list"),
    (("surfaces", 0, "vertices", 2, 1), NAN, "surfaces[0].vertices[2][1]", "must be a finite number"),
    (("surfaces", 0, "vertices", 2, 1), INF, "surfaces[0].vertices[2][1]", "must be a finite number"),
    (("surfaces", 0, "vertices", 2, 1), "1", "surfaces[0].vertices[2][1]", "must be a number"),
    (("surfaces", 0, "vertices", 2, 0), 1e6, "surfaces[0].vertices[2]", "must lie within 10 km"),
    # Degenerate polygons
    (
        ("surfaces", 0, "vertices", 2),
        [1.0, 0.0, 0.0],
        "surfaces[0].vertices[2]",
        "more than 0.1 mm from the point before",
    ),
    (
        ("surfaces", 0, "vertices"),
        [*SQUARE, SQUARE[0]],
        "surfaces[0].vertices[0]",
        "more than 0.1 mm from the point before",
    ),
    (
        ("surfaces", 0, "vertices"),
        [[0, 0, 0], [1, 0, 0], [2, 0, 0]],
        "surfaces[0].vertices",
        "area of more than 1e-06 m^2",
    ),
    (
        ("surfaces", 0, "vertices"),
        [[0, 0, 0], [1e-3, 0, 0], [5e-4, 5e-10, 0]],
        "surfaces[0].vertices",
        "area of more than 1e-12 m^2",
    ),
    (("surfaces", 0, "vertices", 2, 2), 0.1, "surfaces[0].vertices", "must lie in the plane of the others"),
    (
        ("surfaces", 0, "vertices", 2),
        [0.2, 0.2, 0.0],
        "surfaces[0].vertices[2]",
        "corner of a strictly convex polygon",
    ),
    (
        ("surfaces", 0, "vertices", 2),
        [0.5, 0.5, 0.0],
        "surfaces[0].vertices[2]",
        "corner of a strictly convex polygon",
    ),
    (
        ("surfaces", 0, "vertices"),
        [*SQUARE[:2], [1, 0.5, 0], *SQUARE[2:]],
        "surfaces[0].vertices[2]",
        "strictly convex",
    ),
    (
        ("surfaces", 0, "vertices"),
        [SQUARE[0], SQUARE[2], SQUARE[1], SQUARE[3]],
        "surfaces[0].vertices",
        "",
    ),  # a bow tie
    (
        ("surfaces", 0, "vertices"),
        [[1, 0, 0], [-0.809, 0.588, 0], [0.309, -0.951, 0], [0.309, 0.951, 0], [-0.809, -0.588, 0]],
        "surfaces[0].vertices",
        "must run once around a convex polygon, got 2 turns",
    ),
    # Stances and rules
    (("steps", 0, "end_effector"), DELETE, "steps[0].end_effector", "is required"),
    (("steps", 0, "end_effector"), "", "steps[0].end_effector", "must not be empty"),
    (("steps", 0, "surface"), "roof", "steps[0].surface", 'must name a surface. There are: floor, pad, got "roof"'),
    (("steps", 0), "floor", "steps[0]", "must be a table"),
    (("start",), DELETE, "start", "is required"),
    (("goal",), DELETE, "goal", "is required"),
    (("start",), [0.0, 0.0, 0.0], "start", "must be a table"),
    (("start", "position"), DELETE, "start.position", "is required"),
    (("start", "position"), [0.0, 0.0], "start.position", "needs at least 3 entries, got 2"),
    (("start", "position", 0), NAN, "start.position[0]", "must be a finite number"),
    (("goal", "yaw"), INF, "goal.yaw", "must be a finite number"),
    (("goal", "yaw"), 30.0, "goal.yaw", "must lie in [-2 pi, 2 pi] rad, got 30"),
    (("goal", "yaw"), "north", "goal.yaw", "must be a number"),
    (("start", "contacts"), DELETE, "start.contacts", "is required"),
    (("start", "contacts"), {}, "start.contacts", "must put at least one end-effector on a surface"),
    (("start", "contacts"), ["floor"], "start.contacts", "must be a table"),
    (
        ("start", "contacts"),
        {"foot": "flor"},
        "start.contacts.foot",
        "must name a surface. Did you mean 'floor'? There are: floor, pad, got \"flor\"",
    ),
    (("start", "contacts"), {"foot": 0}, "start.contacts.foot", "must be a string"),
    (("start", "heading"), 0.0, "start.heading", "no such key. Keys: position, yaw, contacts"),
    (("rules",), {}, "rules", "must be a list"),
    (("rules", 0, "when_free"), [], "rules[0].when_free", "needs at least 1 entry"),
    (("rules", 0, "require"), DELETE, "rules[0].require", "is required"),
    (("rules", 0, "requires"), ["hand"], "rules[0].requires", "Did you mean 'require'?"),
]

ROBOT_BREAKS: list[Break] = [
    (("mass",), DELETE, "mass", "is required"),
    (("mass",), 0.0, "mass", "must be a positive number"),
    (("mass",), -1.0, "mass", "must be a positive number"),
    (("mass",), NAN, "mass", "must be a finite number"),
    (("mass",), "heavy", "mass", 'must be a number, got "heavy"'),
    (("inertia",), DELETE, "inertia", "is required"),
    (("inertia",), 1.0, "inertia", "must be a list"),
    (("inertia",), [1.0, 1.0], "inertia", "needs at least 3 entries, got 2"),
    (("inertia", 1), 0.0, "inertia[1]", "must be a positive number"),
    (("inertia", 2), INF, "inertia[2]", "must be a finite number"),
    (("com_height",), 0.0, "com_height", "must be a positive number"),
    (("com_hight",), 0.7, "com_hight", "Did you mean 'com_height'?"),
    (("swing_height",), -0.1, "swing_height", "must be a positive number"),
    (("phase_duration",), 0.3, "phase_duration", "must be a list"),
    (("phase_duration",), [0.3], "phase_duration", "needs at least 2 entries, got 1"),
    (("phase_duration",), [0.3, 0.4, 0.5], "phase_duration", "may have 2 entries at most, got 3"),
    (("phase_duration",), [0.0, 0.5], "phase_duration[0]", "must be a positive number"),
    (("phase_duration",), [0.3, NAN], "phase_duration[1]", "must be a finite number"),
    (("phase_duration",), [0.5, 0.3], "phase_duration", "must be two positive numbers, the shorter first"),
    (("sole_support",), -0.1, "sole_support", "must be"),
    (("sole_support",), 1.1, "sole_support", "must be"),
    (("sole_support",), NAN, "sole_support", "must be at most 1"),
    (("sole_support",), "all", "sole_support", "must be a number"),
    (("tracked",), 1, "tracked", "must be true or false"),
    (("urdf",), 1, "urdf", "must be a string"),
    (("posture", "knee"), NAN, "posture.knee", "must be a finite number"),
    (("posture", "knee"), "bent", "posture.knee", "must be a number"),
    (("posture",), [0.3], "posture", "must be a table"),
    (("end_effectors",), DELETE, "end_effectors", "is required"),
    (("end_effectors",), [], "end_effectors", "needs at least 1 entry"),
    (
        ("end_effectors",),
        [ROBOT["end_effectors"][0]] * 9,
        "end_effectors",
        "may have 8 entries at most, got 9",
    ),
    (("end_effectors", 0), 1, "end_effectors[0]", "must be a table"),
    (("end_effectors", 0, "name"), "", "end_effectors[0].name", "must not be empty"),
    (("end_effectors", 1, "name"), "leg", "end_effectors[1].name", "must be unique"),
    (("end_effectors", 0, "kind"), "", "end_effectors[0].kind", "must not be empty"),
    (("end_effectors", 0, "frame"), 1, "end_effectors[0].frame", "must be a string"),
    (("end_effectors", 0, "half_size"), [0.1], "end_effectors[0].half_size", "needs at least 2 entries"),
    (("end_effectors", 0, "half_size", 0), -0.1, "end_effectors[0].half_size[0]", "must be at least 0"),
    (("end_effectors", 0, "nominal"), DELETE, "end_effectors[0].nominal", "is required"),
    (
        ("end_effectors", 0, "nominal"),
        [0.0, 0.0, -0.9],
        "end_effectors[0].nominal",
        "must lie in the reach box in z",
    ),
    (("end_effectors", 0, "nominal", 2), NAN, "end_effectors[0].nominal[2]", "must be a finite number"),
    (
        ("end_effectors", 0, "reach_max"),
        [0.2, -0.3, -0.3],
        "end_effectors[0].reach_max",
        "must exceed reach_min in y",
    ),
    (("end_effectors", 0, "reach_max", 0), -0.2, "end_effectors[0].reach_max", "must exceed reach_min in x"),
    (("end_effectors", 0, "reach_min", 0), INF, "end_effectors[0].reach_min[0]", "must be a finite number"),
    (("end_effectors", 0, "max_force"), 0.0, "end_effectors[0].max_force", "must be a positive number"),
    (("end_effectors", 0, "max_force"), NAN, "end_effectors[0].max_force", "must be a positive number"),
    (("end_effectors", 0, "max_moment", 2), -1.0, "end_effectors[0].max_moment[2]", "must be at least 0"),
    (("end_effectors", 0, "yaw_range"), [0.1, 0.4], "end_effectors[0].yaw_range", "the first <= 0, the second >= 0"),
    (("end_effectors", 0, "yaw_range"), [-0.4, -0.1], "end_effectors[0].yaw_range", "the first <= 0, the second >= 0"),
    (("end_effectors", 0, "yaw_range"), [-0.4], "end_effectors[0].yaw_range", "needs at least 2 entries"),
    (("end_effectors", 0, "yaw_range", 1), INF, "end_effectors[0].yaw_range[1]", "must be a finite number"),
    (("end_effectors", 0, "yaw_range", 0), "left", "end_effectors[0].yaw_range[0]", "must be a number"),
    (("end_effectors", 0, "limb"), [1.0], "end_effectors[0].limb", "must be a table"),
    (("end_effectors", 0, "limb", "upper"), DELETE, "end_effectors[0].limb.upper", "is required"),
    (("end_effectors", 0, "limb", "upper"), 0.0, "end_effectors[0].limb.upper", "must be a positive number"),
    (("end_effectors", 0, "limb", "lower"), 0.05, "end_effectors[0].limb", "must be a leg that is bent in the nominal"),
    (("end_effectors", 0, "limb", "hip_shift"), 0.1, "end_effectors[0].limb.hip_shift", "must be at most 0"),
    (
        ("end_effectors", 0, "limb", "knee_torque"),
        -1.0,
        "end_effectors[0].limb.knee_torque",
        "must be a positive number",
    ),
    (("end_effectors", 0, "limb", "hip_torque"), [1.0], "end_effectors[0].limb.hip_torque", "needs at least 2 entries"),
    (("end_effectors", 0, "limb", "radius"), -0.1, "end_effectors[0].limb.radius", "must be at least 0"),
    (("end_effectors", 0, "limb", "radius"), 0.5, "end_effectors[0].limb.radius", "must be at most half of upper"),
    (("end_effectors", 0, "limb", "beside"), -0.5, "end_effectors[0].limb.beside", "must be at most half of upper"),
    (("end_effectors", 0, "limb", "margin"), NAN, "end_effectors[0].limb.margin", "must be a finite number"),
    (("end_effectors", 0, "limb", "knee"), 1.0, "end_effectors[0].limb.knee", "no such key"),
    (("end_effectors", 0, "com_reach"), [1.0], "end_effectors[0].com_reach", "must be a table"),
    (("end_effectors", 0, "com_reach", "A"), DELETE, "end_effectors[0].com_reach.A", "is required, or file and name"),
    (
        ("end_effectors", 0, "com_reach", "b"),
        [0.6],
        "end_effectors[0].com_reach.b",
        "must have a number for each row of A, got 1 for 2 rows",
    ),
    (("end_effectors", 0, "com_reach", "b", 1), NAN, "end_effectors[0].com_reach.b[1]", "must be a finite number"),
    (
        ("end_effectors", 0, "com_reach", "A", 1),
        [0.0, 0.0, -1.1],
        "end_effectors[0].com_reach.A[1]",
        "must have length 1 within 0.001, got 1.1",
    ),
    (
        ("end_effectors", 0, "com_reach", "b", 1),
        -0.51,
        "end_effectors[0].com_reach",
        "must hold the nominal stance, got",
    ),
    (
        ("end_effectors", 0, "com_reach", "file"),
        "reach.json",
        "end_effectors[0].com_reach.file",
        "must stand alone, without A and b",
    ),
    (
        ("end_effectors", 0, "com_reach"),
        {"file": "reach.json", "name": "com"},
        "end_effectors[0].com_reach.file",
        "cannot be read: No such file",
    ),
    (
        ("end_effectors", 0, "partner_reach"),
        {"tail": {"A": [[1.0, 0.0, 0.0]], "b": [0.4]}},
        "end_effectors[0].partner_reach.tail",
        "must name another end-effector",
    ),
    (
        ("end_effectors", 0, "partner_reach", "arm", "b", 0),
        0.19,
        "end_effectors[0].partner_reach.arm",
        "must hold the nominal stance",
    ),
    (("end_effectors", 0, "maxforce"), 1.0, "end_effectors[0].maxforce", "Did you mean 'max_force'?"),
    (("trunk",), {"from": [0, 0, 0], "to": [0, 0, 0.3], "radius": 0.1}, "trunk", "must be a list"),
    (("trunk",), [{"from": [0, 0, 0], "to": [0, 0, 0.3]}], "trunk[0].radius", "is required"),
    (("trunk",), [{"from": [0, 0, -0.9], "to": [0, 0, 0.3], "radius": 0.1}], "trunk[0]", "must lie above the ground"),
]

# (content, part of the message after the file's name)
NOT_SCENE_FILES: list[tuple[bytes, str]] = [
    (b"", "is empty"),
    (b"  \n\t\n", "is empty"),
    (b"# only a comment\n", "surfaces: is required"),
    (b"gravity = 9.8\ngravity = 9.8\n", "is not TOML: "),
    (b"gravity = \n", "is not TOML: error while parsing key-value pair: expected value, saw '\\n' (at line 1"),
    (b'{"gravity": 9.8}', "must be TOML, got JSON"),
    (b"[[surfaces]\n", "is not TOML: "),
    (b'name = "\xff\xfe"\n', "must be UTF-8 text, got byte 0xff at offset 8"),
    ("name = 'raum'\n".encode("utf-16"), "must be TOML, got UTF-16 text"),
    (b"\x00\x01\x02\x03", "must be TOML, got binary data"),
    (b"PK\x03\x04\x14\x00\x00\x00\x08\x00\xb7\xac\xce", "must be TOML, got a zip archive"),
    (b"surfaces = " + b"[" * 5000 + b"]" * 5000, "is not TOML: nested too deep"),
    (b"surfaces = 2026-01-01\n", "surfaces: must be a list, got 2026-01-01"),
]


def broken(data: dict[str, Any], path: tuple[Any, ...], value: Any) -> dict[str, Any]:
    """A copy of `data` with one value changed or deleted."""
    out = copy.deepcopy(data)
    target: Any = out
    for part in path[:-1]:
        target = target[part]
    if value is DELETE:
        del target[path[-1]]
    else:
        target[path[-1]] = value
    return out


def label(case: Break) -> str:
    """A readable id for pytest."""
    path, value = case[0], case[1]
    shown = "deleted" if value is DELETE else repr(value)
    return f"{'.'.join(map(str, path))}={shown[:30]}"
