"""Plans of TALOS and G1 over scenes of their size: solved, without flight, soles where they find room."""

import numpy as np
import pytest

import mcplan as mp
from mcplan.files.scenes import scaled


def sole_beyond_its_surface(plan):
    """Farthest that a corner of a sole, headed along x, is beyond the edge of the surface that it stands on [m]."""
    worst, start = -np.inf, 0.0
    for phase, row in zip(plan.phases, plan.contact_sequence(), strict=True):
        states = plan.at(start + 1e-6).end_effectors
        for end, surface, state in zip(plan.robot.end_effectors, row, states, strict=True):
            if surface >= 0 and end.kind == "foot":
                outline = np.asarray(plan.scene.surfaces[surface].vertices_W)[:, :2]
                edges = np.roll(outline, -1, axis=0) - outline
                outward = np.column_stack([edges[:, 1], -edges[:, 0]]) / np.linalg.norm(edges, axis=1)[:, None]
                corners = np.asarray(state.position_W)[:2] + end.half_size * [[1, 1], [1, -1], [-1, 1], [-1, -1]]
                worst = max(worst, np.einsum("ek,cek->ce", outward, corners[:, None] - outline).max())
        start += phase.duration
    return worst


@pytest.mark.parametrize(
    ("robot", "scene", "scale", "beyond"),
    [
        ("talos", "flat", 1.0, 0.0),
        ("talos", "ramp", 1.0, 0.002),
        ("talos", "stairs_broad", 1.0, 0.0),
        ("talos", "stepping_stones", 1.0, 0.07),  # its sole is larger than the stones
        ("g1", "flat", 0.74, 0.0),
        ("g1", "ramp", 0.74, 0.002),
        ("g1", "stairs_broad", 0.65, 0.0),
        ("g1", "stepping_stones", 0.74, 0.05),
    ],
)
def test_humanoids_walk_with_their_soles_on_the_surfaces(robot, scene, scale, beyond):
    result = mp.plan(scaled(mp.load_scene(scene), scale), robot)
    assert str(result.report.status) == "solved", result.report.message
    assert all(any(surface >= 0 for surface in row) for row in result.plan.contact_sequence())  # no flight
    assert sole_beyond_its_surface(result.plan) < beyond + 1e-3


def test_soles_hang_over_edges_unless_asked_to_stay_inside():
    assert sole_beyond_its_surface(mp.plan("stairs", "talos", sole_inside=0.0).plan) > 0.08


@pytest.mark.parametrize("height", [0.08, 0.12])
def test_a_kerb_is_climbed_with_room_for_the_toe(height):
    """Its riser stands where the road ends: a sole that ends there, too, would catch it on the way up."""

    def level(name, start, end, z):
        return mp.model.Surface(
            name=name, vertices_W=[[start, -1, z], [end, -1, z], [end, 1, z], [start, 1, z]], thickness=0.12
        )

    scene = mp.Scene(
        name="kerb",
        surfaces=[level("road", -1.0, 0.4, 0.0), level("kerb", 0.4, 2.0, height)],
        start=mp.model.Stance(contacts={"foot": "road"}),
        goal=mp.model.Stance(position_W=[1.0, 0.0, height], contacts={"foot": "kerb"}),
    )
    result = mp.plan(scene, "talos")
    assert str(result.report.status) == "solved", result.report.message
    assert sole_beyond_its_surface(result.plan) < 1e-3
