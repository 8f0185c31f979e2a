"""What is probably wrong: functions over a recording that give a sentence for the student, or nothing."""

from collections.abc import Callable, Iterable

from grader.diagnosis import (
    actions,
    activity,
    connections,
    driving,
    first_attempts,
    missed_messages,
    names,
    order_findings,
    owners,
    parameters,
    program_end,
    radio,
    sent_transforms,
    services,
    synchronizers,
    turning,
    two_executors,
)
from grader.diagnosis.bundled import as_course_programs
from grader.diagnosis.faults import find_fault
from sim.evidence import Recording

__all__ = ["explain", "find_fault", "find_flaw"]

# The likelier cause comes first: a typo in a name also leaves a publisher without subscriptions, and so on.
DIAGNOSES = (
    activity.slow_callback,
    names.shared_name,
    owners.two_owners,
    two_executors.two_executors,
    names.topic_name_typo,
    names.service_name_typo,
    parameters.unknown_parameter,
    parameters.misspelt_parameter,
    parameters.whole_parameter,
    parameters.untyped_list,
    connections.incompatible_qos,
    connections.publisher_for_each_message,
    connections.published_too_early,
    missed_messages.sent_before_spinning,
    services.not_offered,
    services.no_server,
    activity.never_spun,
    synchronizers.never_met,
    sent_transforms.zero_stamp,
    sent_transforms.two_broadcasters,
    services.response_not_received,
    actions.no_goal_response,
    actions.no_ending,
    actions.cancel_not_handled,
    actions.cancel_ignored,
    actions.cancel_refused,
    services.empty_answers,
    services.response_dropped,
    activity.ended_early,
    activity.unused_publisher,
    activity.quiet_publisher,
    activity.empty_node,
    radio.lost_on_the_network,
    radio.late_on_the_network,
)
# True of right programs, too: they explain a check that was missed, and are no news without one.
GUESSES = (
    services.response_dropped,
    activity.ended_early,
    activity.quiet_publisher,
    radio.lost_on_the_network,
    radio.late_on_the_network,
)
# In place of a diagnosis, where no missed check says that the difference mattered.
STRICTER = {
    activity.slow_callback: activity.certainly_slow_callback,
    connections.published_too_early: connections.only_message_too_early,
    names.topic_name_typo: names.certain_topic_typo,
}
# Of `tell` only: more exact than the diagnoses, for programs that have just been begun.
FIRST_ATTEMPTS = (first_attempts.publish_not_reached, first_attempts.long_period)
# What no check need ask for.
FLAWS = (
    activity.busy_listener,
    activity.busy_loop,
    driving.refused_command,
    driving.drives_against_it,
    driving.two_drivers,
    driving.rare_commands,
    driving.left_driving,
    turning.endless_turn,
    program_end.ends_in_error,
    names.silent_rosout,
)


def explain(recording: Recording) -> str:
    """The first diagnosis that fits, or "" when none does."""
    return _first(recording, DIAGNOSES)


def find_flaw(recording: Recording) -> str:
    """Return what is certainly wrong in a run without an error, the worst first; "" when nothing is."""
    certain = [STRICTER.get(diagnose, diagnose) for diagnose in DIAGNOSES if diagnose not in GUESSES]
    unused = certain.index(activity.unused_publisher)  # what is likelier comes before
    ordered = (*certain[:unused], *FIRST_ATTEMPTS, *certain[unused:], *FLAWS)
    return _first(recording, ordered) or order_findings.find(recording)


def _first(recording: Recording, diagnoses: Iterable[Callable[[Recording], str]]) -> str:
    students = as_course_programs(recording)
    return next((sentence for diagnose in diagnoses if (sentence := diagnose(students))), "")
