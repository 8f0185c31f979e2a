"""Look transforms up: where was it, when it was seen? And what if there is no answer?"""

import math
from dataclasses import replace

from grader.checks import Missed, otherwise, publishes, subscribes, tenths
from grader.checks.fields import stamp_words
from grader.checks.frames import broadcasts
from grader.exercise import Exercise, Scenario
from grader.exercises.frames.lookup.sightings import SIGHTINGS, Team
from grader.geometry import Point, Pose2D
from grader.responses import Stimuli, Stimulus, Window, same
from grader.variants import Variants
from sim.evidence import Recording, Seconds, since_start
from sim.network import Network

__all__ = ["Team", "lookup"]

POINT = "geometry_msgs/msg/PointStamped"
SOON, NEAR, LATE = 0.3, 0.05, 0.3  # s, m, m
OUTSIDE = "ExtrapolationException"  # of the times of its transforms
KINDS = 0.6  # of the kinds of refusals; fewer are none
PART = 0.3  # less than this is none
RADIO = Network(delay=0.05, jitter=0.04)  # s; between the student's laptop and the robots


def _scenario(seed: int, network: Network | None = None) -> Scenario:
    return Scenario(None, 6, seed, [Team], network=network)


lookup = Exercise("lookup", "Where was it?", scenarios=[_scenario(1), _scenario(2, RADIO)],
                  variants=Variants(
    {"found": ("/found", "/placed", "/on_map"), "refused": ("/refused", "/failed", "/not_placed")},
    texts=("{found}", "{refused}"),
))


@lookup.check(2, guess="A TransformListener subscribes to both topics: TransformListener(self.buffer, self).")
def subscribes_to_sightings(run: Recording) -> None:
    """The node subscribes to /sighting (PointStamped), /tf and /tf_static."""
    subscribes(run, "/sighting", POINT)
    subscribes(run, "/tf")
    subscribes(run, "/tf_static")


@lookup.check(6, after=subscribes_to_sightings, hints={
    "Publish in the callback what buffer.transform or do_transform_point returns.":
        lambda run, seen: len(seen.responses) != 1,
    "Target first, then source: buffer.transform(msg, 'map').": lambda run, seen: _frame(seen) != "map",
    "That is where it would be now. The robot has driven on since: look up the time of the sighting, "
    "msg.header.stamp, and not the newest, Time().":
        lambda run, seen: math.dist(_answer(seen), _place(run, seen, seen.stamp)) < LATE,
    "That is the point as the camera sees it. Transform it into the frame map.":
        lambda run, seen: same(_answer(seen), (seen.value.point.x, seen.value.point.y)),
    "Target first, then source: lookup_transform('map', msg.header.frame_id, msg.header.stamp).": otherwise,
})
def places_them(run: Recording) -> None:
    """Each sighting by a robot on the map is published on /found (PointStamped): where it was, in map."""
    _require_no_lookup_of_now(run)
    publishes(run, lookup.drawn.found, POINT)
    judged = [seen for seen in _sightings(run) if not _reason(run, seen)]
    shares = [_share(run, seen) for seen in judged]
    wrong = next((seen for seen, share in zip(judged, shares, strict=True) if share < 1.0), None)
    if wrong:
        x, y = _place(run, wrong, _measured(wrong))
        saw = f"{len(wrong.responses)} messages"
        if len(wrong.responses) == 1:
            saw = f"a point in {_frame(wrong) or 'no frame'}"
            if _frame(wrong) == "map":
                saw = "({:.2f}, {:.2f}) m".format(*_answer(wrong))
        expected = f"({x:.2f}, {y:.2f}) m in map, for the sighting at {wrong.stamp:.3g} s"
        right = sum(shares) / len(shares)
        raise Missed(expected, saw, about=(wrong,), credit=right if right >= PART else 0.0)


@lookup.check(5, after=subscribes_to_sightings)
def publishes_refusals(run: Recording) -> None:
    """If the lookup fails, its exception's name is on /refused (String), such as LookupException."""
    publishes(run, lookup.drawn.refused, "std_msgs/msg/String")
    refused = _sightings(run, lookup.drawn.refused)
    reasons = {seen.stamp: _reason(run, seen) for seen in refused}
    right = [seen for seen in refused if seen.values() == [reasons[seen.stamp]] != [""]]
    needless = any(seen.values() for seen in refused if not reasons[seen.stamp])
    kinds = len({reasons[seen.stamp] for seen in right}) / len(set(reasons.values()) - {""})
    for seen in refused:
        reason = reasons[seen.stamp]
        if reason and seen.values() != [reason]:
            age = seen.stamp - _measured(seen)
            what = f"{seen.value.header.frame_id}, {age:.1f} s old"
            expected = f"{reason} for the sighting at {seen.stamp:.3g} s ({what})"
            hint = "type(error).__name__ is the name of its class; TransformException catches all of them."
            credit = 0.0 if needless or kinds < KINDS else tenths(kinds)
            raise Missed(expected, ", ".join(seen.values()) or "nothing", hint, credit=credit)


@lookup.check(3, after=publishes_refusals)
def carries_on(run: Recording) -> None:
    """Nothing else is published, and the node keeps running to the end."""
    reasons, settled = [_reason(run, seen) for seen in _sightings(run)], Window(0.0, run.ended.stamp - SOON)
    placed, drawn = reasons.count(""), lookup.drawn
    for topic, count in ((drawn.found, placed), (drawn.refused, len(reasons) - placed)):
        sent = settled.rows(run.messages(topic))
        if len(sent) > count:
            hint = ("Each sighting gives either a point or a refusal: publish the point in try, the refusal "
                    "in except.")
            raise Missed(f"{count} messages on {topic}", f"{len(sent)}", hint)


@lookup.check(2, after=places_them)
def keeps_the_stamp(run: Recording) -> None:
    """The point on the map has the stamp of its sighting: the time at which it was there."""
    stamps = [_measured(seen) for seen in _sightings(run)]
    for row in Window(0.0, run.ended.stamp - SOON).rows(run.messages(lookup.drawn.found)):
        stamp = row.message.header.stamp
        if not any(same(since_start(stamp), known) for known in stamps):
            hint = ("buffer.transform keeps the stamp; what do_transform_point returns has the stamp of the "
                    "lookup, so set it yourself.")
            raise Missed("a stamp of one of the sightings", stamp_words(stamp), hint)


def _require_no_lookup_of_now(run: Recording) -> None:
    """Over a network, the transforms of now arrive only later: a lookup of them finds none."""
    refused = _sightings(run, lookup.drawn.refused)
    early = (seen for seen in refused if seen.values() == [OUTSIDE] and not _reason(run, seen))
    seen = next(early, None)
    if seen and not run.messages(lookup.drawn.found):
        hint = ("The transforms come over a network, so the one for now isn't there yet: look up the time of "
                "the sighting, msg.header.stamp.")
        expected = f"the place of the sighting at {seen.stamp:.3g} s"
        raise Missed(expected, f"{seen.seen()} on {lookup.drawn.refused}", hint)


def _sightings(run: Recording, topic: str = "") -> list[Stimulus]:
    """The sightings, with what was published after each on a topic; where it is, if no other is given."""
    answers = topic or lookup.drawn.found
    sightings = Stimuli("/sighting", answered_on=answers, within=SOON, what="sightings of all kinds")
    return sightings(run, at_least=len(SIGHTINGS))


def _measured(seen: Stimulus) -> Seconds:
    return since_start(seen.value.header.stamp)


def _frame(seen: Stimulus) -> str:
    """The frame of the first response."""
    return str(seen.responses[0].message.header.frame_id)


def _answer(seen: Stimulus) -> Point:
    """The point of the first response."""
    point = seen.responses[0].message.point
    return point.x, point.y


def _share(run: Recording, seen: Stimulus) -> float:
    """Return how right a response is: half, if the point was there later, or if it comes twice."""
    if len(seen.responses) == 2 and all(row.message == seen.responses[0].message for row in seen.responses):
        return _share(run, replace(seen, responses=seen.responses[:1])) / 2
    if len(seen.responses) != 1 or _frame(seen) != "map":
        return 0.0
    if math.dist(_answer(seen), _place(run, seen, _measured(seen))) <= NEAR:
        return 1.0
    return 0.5 if math.dist(_answer(seen), _place(run, seen, seen.stamp)) < LATE else 0.0


def _reason(run: Recording, seen: Stimulus) -> str:
    """The name of the exception of a lookup; empty for one that succeeds."""
    sent = broadcasts(run, "/tf", f"{_robot(seen)}/base_link", from_course=True)
    trees = {one.message.header.frame_id for one in sent}
    if "map" not in trees:
        return "ConnectivityException" if trees else "LookupException"
    return OUTSIDE if _measured(seen) < 0 else ""


def _robot(seen: Stimulus) -> str:
    return str(seen.value.header.frame_id).partition("/")[0]


def _place(run: Recording, seen: Stimulus, when: Seconds) -> Point:
    """Return where the point was in the map at a time, by the transforms of the course."""
    camera = broadcasts(run, "/tf_static", f"{_robot(seen)}/camera", from_course=True)[-1].pose
    return _base(run, _robot(seen), when).point(camera.point((seen.value.point.x, seen.value.point.y)))


def _base(run: Recording, robot: str, when: Seconds) -> Pose2D:
    """The pose of a robot at a time, between the two transforms around it."""
    sent = broadcasts(run, "/tf", f"{robot}/base_link", from_course=True)
    before = max((one for one in sent if one.measured <= when), key=lambda one: one.measured, default=sent[0])
    after = min((one for one in sent if one.measured > when), key=lambda one: one.measured, default=before)
    span = after.measured - before.measured
    return before.pose.towards(after.pose, (when - before.measured) / span if span else 0.0)
