"""Plots of plans, of how they were found, and of runs."""
