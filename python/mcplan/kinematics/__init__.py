"""Postures of a URDF robot along a plan: its model, the plan's samples, inverse kinematics."""
