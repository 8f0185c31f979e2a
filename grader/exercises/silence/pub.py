"""One ros2 command that drives the robot."""

import itertools
import math
import re

from grader.checks import Missed, keeps_clear, publishes, series, tenths, traveled
from grader.checks.topics import longest_pause
from grader.exercise import Exercise
from grader.geometry.near import is_near
from grader.variants import Variants
from sim.evidence import Recording, stamps
from sim.ros2.system import OWN_NAME

TWIST, COMMANDS = "geometry_msgs/msg/Twist", "/cmd_vel"
NEAR, ROUND = 0.08, 6.0  # m from the circle; rad of it that are driven, and turned
# What ros2 prints about a command that is wrong.
COMPLAINT = re.compile(
    "error:|command not found|is not a command|can't be read|populate field|is invalid|is not what it looks"
)
STRAIGHT = "Driving ahead without turning ends at a wall: give both linear.x and angular.z."
WIDE = "Radius = speed / turn. For {} m at {} m/s, how many rad/s is that?"
TIMEOUT = 0.5  # s after which the robot stops without a command

pub = Exercise("pub", "Drive with one command", world="room", seconds=12, extra_allowed=True, may_end=True,
               variants=Variants(
    {"radius": (0.5, 0.4, 0.5), "speed": (0.3, 0.3, 0.35), "turn": (0.6, 0.75, 0.7)},
    texts=("{radius} m radius", "{speed} m/s", "= {radius} m · turn",
           "{{linear: {{x: {speed}}}, angular: {{z: {turn}}}}}"),
))


@pub.check(3)
def can_be_read(run: Recording) -> None:
    """The command is valid, and publishes Twist messages on /cmd_vel."""
    try:
        publishes(run, COMMANDS, TWIST)
    except Missed as missed:
        printed = [line.strip() for _, text in run.prints for line in text.splitlines() if line.strip()]
        wrong = next((line for line in printed if COMPLAINT.search(line)), "")
        if wrong:
            raise Missed(missed.expected, f"“{wrong}”", _how_to_read(wrong)) from None
        missed.guess = "`ros2 topic pub` publishes; `echo` and `hz` subscribe."
        raise
    nodes = [end.node for end in run.graph.publishers(COMMANDS) if not end.from_course]
    if f"/{OWN_NAME}" not in run.graph.nodes:
        hint = 'The answer is a string: return "ros2 topic pub ...".'
        raise Missed("a string that begins with ros2, and no node", f"the node {nodes[0]}", hint)


@pub.check(3, after=can_be_read)
def comes_often_enough(run: Recording) -> None:
    """The commands come often enough, from start to end, that the robot never stops in between."""
    pause, since = longest_pause(stamps(run.messages(COMMANDS)))
    if pause > TIMEOUT or len(run.messages(COMMANDS)) < 2:
        expected = f"a command every {TIMEOUT:g} s or more often: without commands the robot stops"
        saw = f"{pause:.3g} s without one, from {since:.3g} s on" if pause else "one command"
        hint = "Without --rate, `pub` publishes once a second; with --once, a single time. Give --rate 10."
        raise Missed(expected, saw, hint, picture="topics")
    last = stamps(run.messages(COMMANDS))[-1]
    if last + 2 * TIMEOUT < run.seconds and not _is_round(run):
        hint = ("Without --times it publishes until it is stopped; with --times, give enough messages for "
                "the whole circle.")
        raise Missed("commands to the end, or once around", f"the last one at {last:.3g} s", hint,
                     credit=tenths(last / run.seconds))


@pub.check(4, after=can_be_read)
def drives_the_circle(run: Recording) -> None:
    """The robot drives once around a circle of 0.5 m radius, to the left, and touches nothing."""
    turns = any(turn for _, turn in series(run, COMMANDS, "angular.z"))
    radius = pub.drawn.radius
    keeps_clear(run, _wide() if turns else STRAIGHT)
    far = [abs(math.dist((pose.x, pose.y), (0.0, radius)) - radius) for pose in run.path]
    turned, length = _turned(run), traveled(run)
    if max(far) > NEAR or not _is_round(run):
        way = f"a path of {math.tau * radius:.2f} m around a circle"
        saw = f"a path of {length:.2f} m and a turn of {math.degrees(turned):.0f} degrees, up to "
        saw += f"{max(far):.2f} m off the circle"
        hint = _why_no_circle(run, turned)
        raise Missed(f"{way}, which is a turn of 360 degrees to the left", saw, hint, picture="path")


@pub.check(2, after=drives_the_circle)
def drives_at_the_speed(run: Recording) -> None:
    """It drives at 0.3 m/s."""
    speeds, drawn = [speed for _, speed in series(run, COMMANDS, "linear.x")], pub.drawn
    wrong = next((speed for speed in speeds if not is_near(speed, drawn.speed, 0.01)), None)
    if wrong is not None:
        hint = (f"Speed = radius times turn: at {drawn.speed} m/s a radius of {drawn.radius} m needs "
                f"{drawn.turn} rad/s.")
        raise Missed(f"linear.x {drawn.speed}", f"{wrong:g}", hint)


def _turned(run: Recording) -> float:
    """By how much the robot has turned to the left, in rad."""
    steps = itertools.pairwise(run.path)
    return sum(math.remainder(after.yaw - before.yaw, math.tau) for before, after in steps)


def _is_round(run: Recording) -> bool:
    """Return whether the robot came once round a circle, whatever its radius is."""
    return _turned(run) >= ROUND and traveled(run) >= ROUND * pub.drawn.radius


def _how_to_read(wrong: str) -> str:
    """Return what to do about an error message of ros2."""
    if "unrecognized arguments" in wrong:
        return ("The shell must see the values as one word: put quotes around them, '{...}', because they "
                "contain spaces.")
    if "needs a space" in wrong:
        return "YAML needs a space after each colon: {x: 0.3}, not {x:0.3}."
    if "populate field" in wrong:
        return "`ros2 interface show geometry_msgs/msg/Twist` shows the fields of the message."
    if "type is invalid" in wrong:
        return "A type has three parts, package/msg/Name: `ros2 topic info /cmd_vel` shows it."
    if "command not found" in wrong or "is not a command" in wrong:
        return 'Return a string that begins with the word ros2: return "ros2 topic pub ...".'
    return ("Read the error; `ros2 topic pub --help` shows which arguments the command takes, and in which "
            "order.")


def _why_no_circle(run: Recording, turned: float) -> str:
    """The usual reasons for another path."""
    turns = [turn for _, turn in series(run, COMMANDS, "angular.z")]
    if not any(turns):
        return ("It never turns: angular.z is the turning speed, in rad/s. (angular.x and y do nothing on "
                "the ground.)")
    if turned < 0:
        return "It turns right. A positive angular.z turns left."
    if not any(speed for _, speed in series(run, COMMANDS, "linear.x")):
        return "It turns on the spot: linear.x is the forward speed."
    pause, _ = longest_pause(stamps(run.messages(COMMANDS)))
    if pause > TIMEOUT:
        return "It stops between two commands, as the line above says: fix that one first."
    last = stamps(run.messages(COMMANDS))[-1]
    if last < run.ended.stamp - 2 * TIMEOUT:
        return f"The last command came at {last:.3g} s: without --times it continues until it is stopped."
    return _wide()


def _wide() -> str:
    return WIDE.format(pub.drawn.radius, pub.drawn.speed)
