"""A session in terminals: a program is operated by commands, and what it then does is judged."""

import re
from functools import partial
from itertools import pairwise

from grader.checks import Missed, keeps_clear, publishes, series
from grader.checks.packages import package_of
from grader.checks.topics import longest_pause
from grader.checks.typed import TYPED, first_failure
from grader.exercise import Exercise, Scenario
from grader.exercises.packages.session.watchman_package import FILES, NAME, NUMBER, write_watchman
from grader.responses import same
from grader.variants import Variants
from grader.workspace.installation import typed_in_terminals
from grader.workspace.package import PackageRun
from sim import World
from sim.evidence import Seconds, stamps
from sim.ros2.system import OWN_NAME

__all__ = ["session", "write_watchman"]

FACTS = {  # as `ros2 pkg create` prints them, beside the package's name
    "destination directory": "ws/src", "build type": "ament_python",
    "node_name": "shine", "dependencies": "rclpy, std_msgs",
}
FACT = re.compile(rf"(package name|{'|'.join(FACTS)}): (.*)")
WRONG_FACTS = {
    "package name": "The name is the one word without dashes in front of it.",
    "destination directory": "It is created in the terminal's folder: `cd ws/src` first.",
    "build type": "Without `--build-type ament_python` it is a package of C++.",
    "dependencies": "`--dependencies` takes the names with spaces in between, as the last option.",
    "node_name": "`--node-name` makes a program, with its entry point.",
}

COMMANDS, LOGBOOK, TWIST = "/cmd_vel", "/logbook", "geometry_msgs/msg/Twist"
SLOW = 0.1  # m/s
ON_CTRL_C = 1  # commands of 0, which the program sends when it is ended
LONG, LATE = 5.0, 0.5  # s: at each speed; a command that comes so late
CALL = "It waits for a call: `ros2 service list -t` shows the service, `ros2 interface show` its fields."
BADGE = "It publishes its badge: `ros2 topic list` shows where, and `ros2 topic echo` what."
AGAIN = "Set the parameter while it runs. A value that is given at a start is for another run."

session = Exercise("session", "A session in terminals", package=NAME, scenarios=[
    Scenario(lambda seed: World.generate("room", seed=seed), seconds=90, seed=1,
             prepare=partial(typed_in_terminals, NAME)),
], may_end=True, variants=Variants(
    {"created": ("lantern", "torch", "lamp")},  # the student's own package
    {"fast": (0.25, 0.2)},  # m/s
    texts=("{created}", "{fast} m/s", "pace {fast}"),
))


@session.check(2, hints={
    "There is no command in session.txt: keep there what you typed.": lambda run: not run.prints,
    "It wasn't started: `ros2 run` does it, with the package and the program.":
        lambda run: not any(f"ros2 run {NAME}" in text for _, text in run.prints),
    "It publishes on /drive: `ros2 run` with `--ros-args -r OLD:=NEW` renames a topic.":
        lambda run: bool(run.graph.publishers("/drive")),
})
def starts(run: PackageRun) -> None:
    """The package is built, and its program started: its commands arrive on /cmd_vel."""
    changed = [path for path, text in FILES.items() if package_of(run).sources.get(path) != text.encode()]
    if changed:
        hint = "It works: operate it as it is. Run the cell again that writes it."
        raise Missed("the package as it was given", f"another ws/src/{changed[0]}", hint)
    with first_failure(run):
        try:
            senders = {row.sender for row in publishes(run, COMMANDS, TWIST)}
        except Missed as missed:
            missed.typo = _elsewhere(run)
            raise
        others = [name for name in senders if not _is_the_program(run, name)]
        if others:
            hint = "Start the program with `ros2 run`: it drives by itself."
            saw = f"commands of {others[0]}, which is not the program"
            if f"/{OWN_NAME}" in others:
                saw = "commands of `ros2 topic pub`"
            raise Missed("commands of the program", saw, hint)


@session.check(3, after=starts)
def patrols(run: PackageRun) -> list[tuple[Seconds, float]]:
    """It is sent on patrol: the robot drives at 0.1 m/s for 5 s or longer, and touches nothing."""
    turns = dict(series(run, COMMANDS, "angular.z"))
    driven = [(stamp, speed) for stamp, speed in series(run, COMMANDS, "linear.x") if speed or turns[stamp]]
    with first_failure(run):
        if not driven:
            raise Missed("a robot that drives", "only zero commands", CALL)
        first = next((speed for _, speed in driven if speed), SLOW)
        if not same(first, SLOW):
            raise Missed(f"{SLOW:g} m/s at first", f"{first:g} m/s", "Change its pace while it drives.")
        _lasts(driven[0][0], next((stamp for stamp, speed in driven if speed > first), driven[-1][0]), SLOW)
    keeps_clear(run)
    return driven


@session.check(2, after=patrols)
def changes_pace(run: PackageRun, driven: list[tuple[Seconds, float]]) -> None:
    """While it drives, and without another start, its pace becomes 0.25 m/s, for 5 s or longer."""
    fast = session.drawn.fast
    with first_failure(run):
        later = [(stamp, speed) for stamp, speed in driven if speed and not same(speed, SLOW)]
        if not later:
            hint = "The pace is a parameter of its node: `ros2 param list`, then `ros2 param set`."
            raise Missed(f"{fast:g} m/s after some time", f"{SLOW:g} m/s to the end", hint)
        since = later[0][0]
        for stamp, speed in driven:
            if stamp >= since and speed and not same(speed, fast):
                expected = f"{fast:g} m/s from {since:.3g} s on"
                hint = f"Set it once, to {fast}. Are two programs driving?"
                raise Missed(expected, f"{speed:g} m/s at {stamp:.3g} s", hint)
        pause, at = longest_pause(stamps(run.during(driven[0][0], driven[-1][0]).messages(COMMANDS)))
        if pause > LATE:
            raise Missed("commands without a pause", f"none for {pause:.3g} s, from {at:.3g} s on", AGAIN)
        _lasts(since, driven[-1][0], fast)


@session.check(2, after=starts, hints={BADGE: lambda run: True})
def signs(run: PackageRun) -> None:
    """The number of its badge is in a String on /logbook."""
    with first_failure(run):
        texts = [row.message.data for row in publishes(run, LOGBOOK, "std_msgs/msg/String")]
        if not any(NUMBER in text for text in texts):
            raise Missed("the number of its badge", f"“{texts[0][:60]}”")


@session.check(2)
def creates(run: PackageRun) -> None:
    """With `ros2 pkg create` the package lantern is created in ws/src; it is built, its program started."""
    shown = "".join(text for _, text in run.prints).splitlines()
    blocks = _created(shown)
    created = session.drawn.created
    facts = next((each for each in blocks if each.get("package name") == created), (*blocks, {})[0])
    wanted = {"package name": created, **FACTS} if facts else {}
    for name, right in wanted.items():
        seen = facts.get(name, "nothing")
        if not _fits(name, right, seen):
            raise Missed(f"{name}: {right}", f"{name}: {seen}", WRONG_FACTS[name])
    with first_failure(run):
        if not facts:
            hint = "Part 1 of lesson 11a uses it, and `ros2 pkg create --help` shows its options."
            raise Missed(f"`ros2 pkg create`, for the package {created}", "no new package", hint)
        if f"Hi from {created}." not in shown:
            hint = "A new package is built, and sourced, like any other; then `ros2 run` starts its program."
            raise Missed(f"“Hi from {created}.”, which its program prints", "no such line", hint)


def _created(shown: list[str]) -> list[dict[str, str]]:
    """What `ros2 pkg create` reported of each package that it created."""
    found: list[dict[str, str]] = []
    for before, line in pairwise(shown):
        if line.startswith("going to create") and re.match(TYPED, before):
            found.append({})
        elif found and (fact := FACT.fullmatch(line)):
            found[-1].setdefault(fact[1], fact[2])
    return found


def _fits(name: str, right: str, seen: str) -> bool:
    if name == "dependencies":
        return {*right.split(", ")} <= {*re.findall(r"'([^']*)'", seen)}
    return seen == right or (name == "destination directory" and seen.endswith(f"/{right}"))


@session.check(1, after=patrols)
def ends(run: PackageRun, driven: list[tuple[Seconds, float]]) -> None:
    """At the end the patrol is called off, and then no program runs any more."""
    last = driven[-1][0]
    with first_failure(run):
        if sum(row.stamp > last for row in run.messages(COMMANDS)) <= ON_CTRL_C:
            hint = "Call its service once more before Ctrl-C, to halt it."
            raise Missed("zero commands at the end", f"a robot that drives until {last:.3g} s", hint)
        if run.all_exited_at is None:
            hint = "Ctrl-C ends a program: a line Ctrl-C, below a line that names its terminal."
            raise Missed("no program at the end", f"one that still runs after {run.seconds:g} s", hint)


def _elsewhere(run: PackageRun) -> tuple[str, str] | None:
    """Its own topic and the right one, where it, and no one else, publishes its commands on another one."""
    ends = [end for end in run.graph.publishers() if end.type == TWIST and not end.from_course]
    topics = {end.name for end in ends}
    is_program = all(_is_the_program(run, end.node, end.name) for end in ends)
    return ("/drive", COMMANDS) if len(topics) == 1 and is_program else None


def _is_the_program(run: PackageRun, node: str, topic: str = COMMANDS) -> bool:
    """Return whether a node offers what the program offers, once for each publisher of commands that it has.

    A name can be given to any node, such as that of `ros2 topic pub`.
    """
    own = [end for end in run.graph.endpoints if end.node == node]
    servers = [end for end in own if end.kind == "service" and end.type == "std_srvs/srv/SetBool"]
    return len(servers) >= sum(end.kind == "publisher" and end.name == topic for end in own) > 0


def _lasts(begin: Seconds, end: Seconds, speed: float) -> None:
    """Raise Missed if the robot doesn't drive at this speed long enough."""
    if end - begin < LONG - LATE:
        hint = "`sleep 6` waits for 6 s before the next line is typed."
        raise Missed(f"{LONG:g} s or longer at {speed:g} m/s", f"{end - begin:.3g} s", hint)
