"""Nodes in lock-step simulated time: fibers, the executor in their place, the clock, and why a run ends."""
