"""What is probably wrong: functions over a recording that give a sentence for the student, or nothing."""

from grader.diagnosis import activity, connections, names
from grader.diagnosis.faults import find_fault
from sim.recording import Recording

__all__ = ["explain", "find_fault"]

# The likelier cause stands first: a slip in a name also leaves a publisher without listeners, and so on.
DIAGNOSES = (
    activity.slow_callback,
    names.typing_slip,
    connections.incompatible_qos,
    activity.never_spun,
    activity.ended_early,
    activity.unused_publisher,
    activity.empty_node,
)


def explain(recording: Recording) -> str:
    """The first diagnosis that fits, or "" when none does."""
    return next((sentence for diagnose in DIAGNOSES if (sentence := diagnose(recording))), "")
