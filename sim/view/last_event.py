"""The last moment at which something happened in a run, after which its replay has nothing to show."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from sim.evidence import Message, Pose, Recording
from sim.view.body_tracks import body_tracks

STILL = 1e-3  # m and rad; a body that moves less is at rest
COMMANDS = ("geometry_msgs/msg/Twist", "geometry_msgs/msg/TwistStamped")  # whose effect is a motion


def last_event(recording: Recording) -> float:
    """The stamp (s) of the last motion, contact, error, log line, call, change of a goal or pen stroke.

    Beside a robot, a message by a student's program counts if it differs from the one before on its topic.
    """
    return max(_moments(recording), default=0.0)


def _moments(recording: Recording) -> Iterator[float]:
    yield from (_last_motion(track) for track in body_tracks(recording) if track)
    for rows in (recording.contacts, recording.errors, recording.logs, *recording.other_contacts.values()):
        yield from (row.stamp for row in rows)  # type: ignore[attr-defined]
    for call in recording.calls_of():
        yield from (stamp for stamp in (call.requested, call.taken, call.answered) if stamp is not None)
    for goal in recording.goals:
        yield from (stamp for stamp, _ in goal.events)
    if recording.drawing is not None:
        yield from (stroke.points[-1][0] for stroke in recording.drawing.strokes if stroke.points)
    if recording.world is None:
        yield from (message.stamp for message in recording.messages()[-1:])
    else:
        yield from _last_changes(recording.messages())


def _last_motion(track: Sequence[Pose]) -> float:
    end = track[-1]
    return next((pose.stamp for pose in reversed(track) if _differ(pose, end)), 0.0)


def _differ(pose: Pose, other: Pose) -> bool:
    return max(abs(a - b) for a, b in zip(pose[1:4], other[1:4], strict=True)) > STILL


def _last_changes(messages: Sequence[Message]) -> Iterator[float]:
    """When the text of each topic of the student's last changed."""
    newest: dict[str, bytes] = {}
    changed: dict[str, float] = {}
    for message in messages:
        if not message.from_course and message.type not in COMMANDS:
            if newest.get(message.topic) != message.raw:
                changed[message.topic] = message.stamp
            newest[message.topic] = message.raw
    yield from changed.values()
