"""Parameters that a start gives values to, and that no node has."""

from __future__ import annotations

from sim.evidence import Recording
from sim.nearest import nearest

_OF_EVERY_NODE = ("use_sim_time", "start_type_description_service", "qos_overrides.")


def unknown_parameter(recording: Recording) -> str:
    """A value for a parameter that no node of the student's declares: ROS drops it without a word."""
    rows = [
        row
        for row in recording.parameters
        if row.node not in recording.ours and not row.name.startswith(_OF_EVERY_NODE)
    ]
    declared = {row.name for row in rows if row.declared}
    for _, node, name, _ in rows:
        if name not in declared:
            own = dict.fromkeys(row.name for row in rows if row.declared and row.node == node)
            near = nearest(name, own)
            listed = ", ".join(f"`{other}`" for other in own) or "none"
            meant = f"Did you mean `{near}`?" if near else f"It declares {listed}."
            return (
                f"{node} was started with a value for the parameter `{name}`, which it doesn't declare, and "
                f"ROS drops that without a word. {meant}"
            )
    return ""
