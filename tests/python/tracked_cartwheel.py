"""A cartwheel that a simulated robot can follow, found in seconds since nothing is minimised, and its run."""

from __future__ import annotations

import functools
from dataclasses import replace

import mcplan as mp
from mcplan.planar.tracking import DEFAULT_OPTIONS, PLANNING, PlanarResult, track_whole_body
from mcplan.tracking.options import Options

#: Longer control steps than the default, for speed; the last posture is held for a moment.
QUICK: Options = replace(DEFAULT_OPTIONS, control_step_s=1e-3, hold_s=0.1)


@functools.cache
def cartwheel() -> mp.PlanarPlan:
    return mp.whole_body("cartwheel", minimise="none", **PLANNING).plan


@functools.cache
def tracked() -> PlanarResult:
    return track_whole_body(cartwheel(), QUICK)
