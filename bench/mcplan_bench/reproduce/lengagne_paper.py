"""What Lengagne et al. print in Tables I to IV and section III-C."""

from __future__ import annotations

from typing import NamedTuple

#: The paper's motions by their names here, in its order.
MOTIONS = ("cartwheel", "climbing", "walking")

#: The paper's three weightings of contact forces, by their names here.
CASES = {1: "uniform", 2: "per_body", 3: "per_point"}


class Kinematic(NamedTuple):
    """A row of Tables I and II."""

    parameters: int
    constraints: int
    iterations: int
    time_s: float
    status: str


class Dynamic(NamedTuple):
    """A row of Table III."""

    parameters: int
    constraints: int
    iterations: int
    time_s: float
    status: str


class Full(NamedTuple):
    """A row of Table IV; the unit of its criterion is not given."""

    iterations: int
    time_s: float
    criterion: float
    status: str


#: Free-flyer as parameters: (motion, N_eq).
TABLE_1 = {
    ("cartwheel", 0): Kinematic(108, 246, 11, 1.7, "OK"),
    ("cartwheel", 1): Kinematic(108, 294, 200, 29.9, "MAX ITER"),
    ("cartwheel", 2): Kinematic(108, 342, 44, 6.9, "FAILED"),
    ("cartwheel", 3): Kinematic(108, 390, 106, 16.8, "FAILED"),
    ("climbing", 0): Kinematic(397, 942, 42, 22.6, "OK"),
    ("climbing", 1): Kinematic(397, 1200, 112, 60.7, "FAILED"),
    ("climbing", 2): Kinematic(397, 1458, 114, 62.2, "FAILED"),
    ("climbing", 3): Kinematic(397, 1716, 170, 94.4, "FAILED"),
    ("walking", 0): Kinematic(397, 840, 6, 3.8, "OK"),
    ("walking", 1): Kinematic(397, 996, 11, 6.5, "OK"),
    ("walking", 2): Kinematic(397, 1152, 18, 9.8, "OK"),
    ("walking", 3): Kinematic(397, 1308, 18, 10.0, "OK"),
}

#: Free-flyer from the joints: (motion, N_eq).
TABLE_2 = {
    ("cartwheel", 0): Kinematic(82, 246, 3, 1.6, "OK"),
    ("cartwheel", 1): Kinematic(82, 294, 4, 2.1, "OK"),
    ("cartwheel", 2): Kinematic(82, 342, 4, 2.0, "OK"),
    ("cartwheel", 3): Kinematic(82, 390, 4, 2.1, "OK"),
    ("climbing", 0): Kinematic(298, 942, 39, 62.6, "OK"),
    ("climbing", 1): Kinematic(298, 1200, 68, 126.7, "OK"),
    ("climbing", 2): Kinematic(298, 1458, 50, 77.4, "OK"),
    ("climbing", 3): Kinematic(298, 1716, 45, 63.9, "OK"),
    ("walking", 0): Kinematic(298, 840, 4, 6.5, "OK"),
    ("walking", 1): Kinematic(298, 996, 7, 11.0, "OK"),
    ("walking", 2): Kinematic(298, 1152, 6, 9.0, "OK"),
    ("walking", 3): Kinematic(298, 1308, 6, 9.8, "OK"),
}

#: With dynamics, nothing minimised: (motion, case).
TABLE_3 = {
    ("cartwheel", 1): Dynamic(82, 406, 40, 54.2, "OK"),
    ("cartwheel", 2): Dynamic(84, 406, 32, 48.5, "OK"),
    ("cartwheel", 3): Dynamic(89, 406, 45, 68.7, "OK"),
    ("climbing", 1): Dynamic(298, 1802, 1000, 5618.8, "MAX ITER"),
    ("climbing", 2): Dynamic(312, 1802, 177, 1055.8, "OK"),
    ("climbing", 3): Dynamic(335, 1802, 82, 533.3, "OK"),
    ("walking", 1): Dynamic(298, 1360, 196, 902.4, "OK"),
    ("walking", 2): Dynamic(303, 1360, 87, 440.6, "OK"),
    ("walking", 3): Dynamic(317, 1360, 31, 165.6, "OK"),
}

#: Full motions: (motion, case). Climbing was not run with case 1.
TABLE_4 = {
    ("cartwheel", 1): Full(84, 218.4, 67.6, "OK"),
    ("cartwheel", 2): Full(245, 709.2, 53.4, "OK"),
    ("cartwheel", 3): Full(422, 1247.0, 49.9, "OK"),
    ("climbing", 2): Full(1572, 19609.1, 736.5, "OK"),
    ("climbing", 3): Full(878, 11427.2, 527.3, "OK"),
    ("walking", 1): Full(238, 2299.8, 188.7, "OK"),
    ("walking", 2): Full(352, 3546.8, 171.9, "OK"),
    ("walking", 3): Full(494, 5194.6, 154.1, "OK"),
}

#: Section III-C, contact forces as parameters of the cartwheel; the text gives no time.
FORCES_AS_PARAMETERS = {"parameters": 338, "constraints": 496, "iterations": 1000, "status": "MAX ITER"}
