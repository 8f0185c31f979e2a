"""Nodes that two executors spin."""

from __future__ import annotations

from sim.evidence import TAKEN_OVER, Recording


def two_executors(recording: Recording) -> str:
    """A node that a second executor took away from the one that spins it."""
    row = next((row for row in recording.node_facts if row.fact == TAKEN_OVER), None)
    if row is None or row.node in recording.course_nodes:
        return ""
    return (
        f"At {row.stamp:.3g} s a second executor took over {row.node}, and the first one, which also spins, "
        "no longer runs any of its callbacks: a node belongs to one executor. Spin it with one. "
        "`rclpy.spin_once(node)` and `rclpy.spin_until_future_complete(node, future)` use an executor of "
        "their own unless you pass `executor=node.executor`."
    )
