"""Wait for transforms that come late, without blocking the callbacks that bring them."""


from grader.checks import Missed, hinting, publishes, subscribes
from grader.checks.fields import stamp_words
from grader.checks.frames import Broadcast, broadcasts
from grader.companions.moving_frames import SlowLocalization
from grader.exercise import Exercise
from grader.geometry import Point
from grader.geometry.near import is_near
from grader.responses import EDGE, Stimuli, Stimulus, Window, last_before, same
from sim.evidence import Message, Recording, Seconds, since_start

POINT = "geometry_msgs/msg/PointStamped"
NEAR, SOON, AT_ONCE = 0.03, 1.2, 0.2  # m, s, s
OFTEN, ELSEWHERE = 0.4, 0.3  # of the points: published more than once; where it was at another moment
LATER = ("The transform arrives half a second after the detection: store the detection, and try again later. "
         "A callback that waits in a loop keeps its own node from receiving the transform. Keep each "
         "detection's "
         "own stamp.")

delayed = Exercise("delayed", "Too early to look up", seconds=6, companions=[SlowLocalization], seeds=(1, 2))
detections = Stimuli("/detection", answered_on="/found", within=SOON, what="detections")


@delayed.check(2, guess="A TransformListener subscribes to /tf: TransformListener(self.buffer, self).")
def subscribes_to_detections(run: Recording) -> None:
    """The node subscribes to /detection (PointStamped) and /tf."""
    subscribes(run, "/detection", POINT)
    subscribes(run, "/tf")


@delayed.check(8, after=subscribes_to_detections)
def places_them(run: Recording) -> None:
    """Each detection is on /found (PointStamped), once and within 1.2 s: where it was then, in map."""
    with hinting(LATER):
        publishes(run, "/found", POINT)
    seen = detections(run, at_least=5)
    _require_places(run, seen)
    counts = [len(_answers(run, one)) for one in seen]
    if set(counts) != {1}:
        saw, credit = f"{counts.count(1)} of {len(seen)}", 0.0
        if max(counts) > 1:
            saw, credit = f"{max(counts)} for one of them", OFTEN if min(counts) else 0.0
        raise Missed(f"one message for each of {len(seen)} detections", saw, LATER, credit=credit)


@delayed.check(2, after=places_them)
def keeps_the_stamp(run: Recording) -> None:
    """Each has the stamp of its detection: the time at which it was there."""
    stamps = [_measured(one.message) for one in detections(run, at_least=5)]
    for row in Window(0.0, run.ended.stamp - SOON).rows(run.messages("/found")):
        if not any(same(_measured(row), stamp) for stamp in stamps):
            hint = "Keep the detection's header, and copy it: found.header.stamp = msg.header.stamp."
            raise Missed("the stamp of a detection", stamp_words(row.message.header.stamp), hint)


@delayed.check(4, after=places_them)
def waits_no_longer_than_needed(run: Recording) -> None:
    """It is published as soon as its transform is available, within 0.2 s."""
    for seen in detections(run, at_least=5):
        for answer in _answers(run, seen)[:1]:
            ready = next(one.stamp for one in _robot(run) if one.measured >= _measured(seen.message) - EDGE)
            what = f"the detection of {seen.stamp:.3g} s on /found"
            if answer.stamp < ready - EDGE:
                hint = ("The robot's pose at that time wasn't known yet. Wait for a transform at the time of "
                        "the detection.")
                raise Missed(f"{what} not before {ready:.3g} s", f"at {answer.stamp:.3g} s", hint)
            if answer.stamp > ready + AT_ONCE:
                hint = "Try again in a timer of 0.05 s, or await what wait_for_transform_async returns."
                raise Missed(f"{what} by {ready + AT_ONCE:.3g} s", f"at {answer.stamp:.3g} s", hint)


def _require_places(run: Recording, seen: list[Stimulus]) -> None:
    """Raise Missed for the first answer with another place than where the point was."""
    for one in seen:
        for answer in _answers(run, one)[:1]:
            point, frame = answer.message.point, answer.message.header.frame_id
            x, y = _point(min(_robot(run), key=lambda sent: abs(sent.measured - _measured(one.message))), one)
            if frame != "map" or not is_near((point.x, point.y), (x, y), NEAR):
                newest = last_before(_robot(run), one.stamp)
                was_there = newest is not None and is_near((point.x, point.y), _point(newest, one), NEAR)
                expected = f"({x:.2f}, {y:.2f}) m in map, for the detection at {one.stamp:.3g} s"
                saw = f"({point.x:.2f}, {point.y:.2f}) m in {frame or 'no frame'}"
                hint = ("Time() gives the newest transform that has arrived, and that one is half a second "
                        "old: the robot was somewhere else. Wait for the time of the detection, "
                        "msg.header.stamp.")
                raise Missed(expected, saw, hint, credit=ELSEWHERE if was_there else 0.0)


def _answers(run: Recording, seen: Stimulus) -> list[Message]:
    """The responses with the stamp of a detection; where no response has one, the one in its turn."""
    stamps = [_measured(one.message) for one in detections(run, at_least=5)]
    found = run.messages("/found")
    if any(same(_measured(row), stamp) for row in found for stamp in stamps):
        return [row for row in seen.responses if same(_measured(row), _measured(seen.message))]
    turn = next(turn for turn, stamp in enumerate(stamps) if same(stamp, _measured(seen.message)))
    return [row for row in found[turn : turn + 1] if row in seen.responses]


def _measured(row: Message) -> Seconds:
    return since_start(row.message.header.stamp)


def _robot(run: Recording) -> list[Broadcast]:
    return broadcasts(run, "/tf", "base_link", from_course=True)


def _point(sent: Broadcast, seen: Stimulus) -> Point:
    """A detected point in the map, with the robot where a transform puts it."""
    return sent.pose.point((seen.value.point.x, seen.value.point.y))
