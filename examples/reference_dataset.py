"""A data set of reference motions for learning: the G1 on the flat, stairs, stones and slopes, with contact labels, checked.

    python examples/reference_dataset.py --seconds 60 --seed 1 references

Each motion is planned on ground drawn at random, and kept if the checker accepts the plan and the references keep their promise:
soles in contact move by less than a millimetre, and joints stay within their limits. Of each there are three files of one rate:
NAME.motion.npz for mjlab, NAME.contacts.npz with labels and forces, NAME.plan.npz. Needs ``pip install 'mcplan[view]'``.
"""

import argparse
import json
import time
from pathlib import Path

import numpy as np

import mcplan as mp

ROBOT, RATE_HZ = "g1", 50
MAX_SKATE_M = 1e-3  # of a sole's frame in contact


def ground(name: str, x: tuple[float, float], y: tuple[float, float], slope: float = 0.0, z: float = 0.0):
    """A rectangle that rises along x by an angle [rad] from the height z at x = 0."""
    corners = [(a, b, z + np.tan(slope) * a) for a, b in ((x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1]))]
    return mp.model.Surface(name=name, vertices_W=corners, friction=0.7)


def draw(kind: str, rng: np.random.Generator) -> mp.Scene:
    """A scene of a kind: walk about 0.8 m ahead."""
    feet = ("right_foot", "left_foot")
    length = rng.uniform(0.6, 1.0)
    first = last = "ground"
    slope = rng.uniform(-0.12, 0.12) if kind == "slopes" else 0.0
    surfaces, height = [ground("ground", (-1.0, 3.0), (-1.0, 1.0), slope)], np.tan(slope) * length
    if kind == "stairs":
        rise, tread = rng.uniform(0.02, 0.05), rng.uniform(0.35, 0.4)
        surfaces = [ground("tread 0", (-1.0, 0.2), (-0.6, 0.6))]
        surfaces += [
            ground(f"tread {i}", (0.2 + tread * (i - 1), 0.2 + tread * i), (-0.6, 0.6), z=rise * i) for i in (1, 2)
        ]
        surfaces.append(ground("tread 3", (0.2 + 2 * tread, 3.0), (-0.6, 0.6), z=rise * 3))
        first, last, length, height = "tread 0", "tread 3", 0.45 + 2 * tread, 3 * rise
    if kind == "stones":
        surfaces = [ground("start", (-0.5, 0.15), (-0.5, 0.5))]
        for i in range(3):
            x, gap = 0.2 + 0.3 * i, rng.uniform(0.0, 0.03)
            z = rng.uniform(-0.015, 0.015)
            surfaces += [
                ground(f"{side} {i}", (x + gap, x + 0.27), sorted((0.02 * s, 0.3 * s)), z=z)
                for side, s in (("left", 1), ("right", -1))
            ]
        surfaces.append(ground("end", (1.12, 2.0), (-0.5, 0.5)))
        first, last, length, height = "start", "end", 1.35, 0.0
    start = mp.model.Stance(position_W=[0.0, 0.0, 0.0], contacts=dict.fromkeys(feet, first))
    goal = mp.model.Stance(position_W=[length, 0.0, height], contacts=dict.fromkeys(feet, last))
    return mp.Scene(name=kind, surfaces=surfaces, start=start, goal=goal)


def skate_m(motion: dict, contacts: dict) -> float:
    """Largest displacement of a foot's frame while it is in contact [m]."""
    worst = 0.0
    for end, body in (("right_foot", "right_ankle_roll_link"), ("left_foot", "left_ankle_roll_link")):
        label = contacts["surface"][:, list(contacts["end_effectors"]).index(end)]
        place = motion["body_pos_w"][:, list(motion["body_names"]).index(body)]
        for stance in np.split(np.arange(len(label)), np.flatnonzero(np.diff(label)) + 1):
            if label[stance[0]] >= 0:
                worst = max(worst, float(np.linalg.norm(place[stance] - place[stance[0]], axis=1).max()))
    return worst


def make(name: str, scene: mp.Scene, folder: Path) -> tuple[dict, str]:
    """Write the files of a motion; what is known about it, and why it is not kept, or nothing."""
    began = time.process_time()
    result = mp.plan(scene, ROBOT, time_limit=10.0)
    known = {"name": name, "terrain": scene.name, "plan_s": time.process_time() - began}
    if result.report.status != mp.Status.solved:
        return known, f"the plan is {result.report.status}"
    began, plan = time.process_time(), result.plan
    try:
        motion = np.load(mp.export(plan, "mjlab", folder / f"{name}.motion.npz", rate_hz=RATE_HZ))
    except mp.InvalidInput as found:
        return known, str(found)
    contacts = np.load(mp.export(plan, "contacts", folder / f"{name}.contacts.npz", rate_hz=RATE_HZ))
    plan.save(folder / f"{name}.plan.npz")
    known |= {"motion_s": (len(motion["joint_pos"]) - 1) / RATE_HZ, "export_s": time.process_time() - began}
    known["skate_m"] = skate_m(motion, contacts)
    known["joint_speed_max"] = float(np.abs(motion["joint_vel"]).max())
    return known, "" if known["skate_m"] < MAX_SKATE_M else f"a foot skates by {known['skate_m']:.4f} m"


def main() -> None:
    parser = argparse.ArgumentParser(description="Reference motions of the G1 with contact labels.")
    parser.add_argument("folder", type=Path, nargs="?", default=Path("references"))
    parser.add_argument("--seconds", type=float, default=20.0, help="motion wanted [s]")
    parser.add_argument("--seed", type=int, default=1, help="seed of the terrains")
    chosen = parser.parse_args()
    chosen.folder.mkdir(parents=True, exist_ok=True)
    rng, kept, refused = np.random.default_rng(chosen.seed), [], []
    kinds = ("flat", "stairs", "stones", "slopes")
    while sum(known["motion_s"] for known in kept) < chosen.seconds and len(refused) <= 10 + len(kept):
        count = len(kept) + len(refused)
        name = f"{count:05d}_{kinds[count % 4]}"
        known, reason = make(name, draw(kinds[count % 4], rng), chosen.folder)
        if reason:
            refused.append({**known, "reason": reason})
            for path in chosen.folder.glob(f"{name}.*"):
                path.unlink()
        else:
            kept.append(known)
        print(f"{name}: {reason or 'kept, {motion_s:.1f} s of motion, feet skate by {skate_m:.1e} m'.format(**known)}")
    spent = sum(known["plan_s"] + known.get("export_s", 0.0) for known in kept + refused)
    total = sum(known["motion_s"] for known in kept)
    (chosen.folder / "index.json").write_text(json.dumps({"rate_hz": RATE_HZ, "kept": kept, "refused": refused}))
    if total < chosen.seconds:
        raise SystemExit(f"only {total:.1f} s of motion: too many of the terrains have no plan")
    print(
        f"{len(kept)} motions, {total:.1f} s, of {spent:.1f} s of processor time: an hour takes {spent / total:.1f} h"
    )


if __name__ == "__main__":
    main()
