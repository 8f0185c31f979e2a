"""Stop before a wall."""

import math

from grader.checks import Missed, otherwise, publishes, series, stands_still
from grader.checks.motion import world_in
from grader.exercise import Exercise, Scenario
from grader.variants import Variants
from grader.worlds.rooms import hall, past_a_post, short_sighted
from sim.evidence import Recording

stop = Exercise("stop", "Stop before the wall", scenarios=[
    Scenario(hall, 30, 1, name="hall"),
    Scenario(lambda seed: short_sighted(hall(seed)), 30, 2, name="short-sighted"),
    Scenario(past_a_post, 12, 3, name="post"),
], variants=Variants(
    {"limit": (1.0, 0.8), "about": ("one meter", "0.8 m")},
    texts=("{limit:g} m", "about {about} from", "msg.ranges) > {limit}", "with {limit} (meters)"),
))


def _any(run: Recording, field: str) -> bool:
    return any(value for _, value in series(run, "/cmd_vel", field))


@stop.check(2, hints={
    "linear.x is negative, which drives backwards: make it positive.":
        lambda run, far: any(speed < 0 for _, speed in series(run, "/cmd_vel", "linear.x")),
    "The commands stop too early, or are too rare: publish one in every callback.":
        lambda run, far: _any(run, "linear.x"),
    "It turns on the spot: linear.x is the forward speed; angular.z is how fast it turns.":
        lambda run, far: _any(run, "angular.z"),
    "linear.x is 0 in all commands. At the start the nearest wall is 2 m away: what does your condition "
    "give then?": otherwise,
})
def sets_off(run: Recording) -> None:
    """The robot drives ahead, with commands on /cmd_vel."""
    publishes(run, "/cmd_vel", "geometry_msgs/msg/Twist")
    far = max(pose.x for pose in run.path)
    if far < 0.5:
        expected = f"a robot that drives ahead while nothing is closer than {stop.drawn.limit:g} m"
        raise Missed(expected, f"it gets {far:.2f} m", picture="path", about=(far,))


@stop.check(3, after=sets_off, only=("hall", "short-sighted"), hints={
    "It stops too early. Compare the nearest distance, min(msg.ranges), with 1.0 (meters).":
        lambda run, gap: gap > stop.drawn.limit,
    "That is late for a robot at 0.3 m/s: do you publish zero at once, in the same callback?":
        lambda run, gap: gap > stop.drawn.limit - 0.25,
    "It stops too late. Compare the nearest distance, min(msg.ranges), with 1.0 (meters).": otherwise,
})
def stops_in_time(run: Recording) -> None:
    """It stops as soon as the wall is closer than 1 m."""
    gap, limit = world_in(run).bounds[2] - run.path[-1].x, stop.drawn.limit
    if run.contacts:
        saw = f"the robot drove into it at {run.contacts[0].stamp:.3g} s"
        hint = (f"Decide again for every scan: ahead while min(msg.ranges) is above {limit}, else 0.0. Is "
                "the comparison the right way round?")
        raise Missed("a stop before the wall", saw, hint, picture="path", unsafe=True)
    if not limit - 0.15 <= gap <= limit + 0.05:
        expected = (f"a stop about {limit - 0.05:.2f} m before the wall: the limit is {limit:g} m, and "
                    "braking takes a few centimeters")
        raise Missed(expected, f"it ends {gap:.2f} m before the wall", picture="path", about=(gap,))


@stop.check(1, after=(sets_off, stops_in_time), only="post",
            guess="min(msg.ranges) looks at all rays, not only at the one ahead.")
def looks_all_round(run: Recording) -> None:
    """It also stops for a post that is nearer than 1 m, but not straight ahead."""
    [post] = world_in(run).circles
    gap = min(math.dist((post.x, post.y), pose[1:3]) for pose in run.path) - post.radius
    limit = stop.drawn.limit
    if not limit - 0.15 <= gap <= limit + 0.05:
        expected = f"a stop about {limit - 0.05:.2f} m from the post"
        raise Missed(expected, f"its smallest distance from it is {gap:.2f} m", picture="path")


@stop.check(2, after=stops_in_time, only=("hall", "short-sighted"))
def publishes_a_stop(run: Recording) -> None:
    """It stays there, and keeps sending zeros."""
    stands_still(run)
    stamp, speed = series(run, "/cmd_vel", "linear.x")[-1]
    if speed or run.ended.stamp - stamp > 0.5:
        expected = "zeros on /cmd_vel as long as the wall is close"
        hint = ("It stood still only because the robot stops by itself when commands end. Publish in every "
                "callback, even when it is a Twist() of zeros.")
        raise Missed(expected, f"{speed:g} m/s as the last command, at {stamp:.3g} s", hint, picture="topics")
