"""Measurements of the planner: how often it succeeds (robustness) and how fast it is (speed, growth)."""

#: The paper's four scenes, in its order.
SCENES = ("flat", "stairs", "gap", "gap_with_rail")
