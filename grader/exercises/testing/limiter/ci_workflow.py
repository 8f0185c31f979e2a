"""Reads a workflow of GitHub Actions as data, and looks for commands that test a package. Nothing is run."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

import yaml

from grader.checks.check import Missed

MOST = 20_000  # bytes
COMMANDS = ("colcon build", "colcon test", "colcon test-result")
PATTERNS = tuple(re.compile(command.replace(" ", "[ \t]+") + r"(?![-\w])") for command in COMMANDS)
SETUP = r"(?:source|\.)\s+\S*{}setup\.(?:ba)?sh"
ROS = re.compile(SETUP.format("/opt/ros/jazzy/"))
ROS_OR_BUILT = re.compile(SETUP.format("(?:/opt/ros/jazzy/|install/(?:local_)?)"))
FAILS = re.compile(r"colcon[ \t]+test[ \t][^\n]*--return-code-on-test-failure")
# Actions that build and test by themselves, and what has to name the distribution.
READY_MADE = {"ros-tooling/action-ros-ci": ("with", "target-ros2-distro"),
              "ros-industrial/industrial_ci": ("env", "ROS_DISTRO")}
IGNORED = re.compile(r"(?:test-result|--return-code-on-test-failure)[^\n]*\|\|")


def read_workflow(path: str, data: bytes) -> dict[str, Any]:
    """The workflow in a file. Raises Missed if it can't be read."""
    expected = f"a workflow in {path}"
    if len(data) > MOST:
        raise Missed(expected, f"{len(data)} bytes", f"More than {MOST} bytes are not read: make it shorter.")
    try:
        found = yaml.safe_load(data.decode("utf-8-sig"))
    except (yaml.YAMLError, ValueError, RecursionError) as error:
        line = getattr(getattr(error, "problem_mark", None), "line", None)
        saw = "text that isn't valid YAML" + ("" if line is None else f": line {line + 1}")
        raise Missed(expected, saw, "Indent with spaces, two for each level, never with tabs.") from None
    if not isinstance(found, dict):
        raise Missed(expected, "no keys", "It needs the keys name, on and jobs.")
    return found


def require_tests(workflow: Mapping[Any, Any]) -> None:
    """A job of the workflow builds and tests, and fails if a test fails. Raises Missed."""
    triggers = workflow.get("on", workflow.get(True))  # YAML 1.1 reads the word `on` as true
    if not {"push", "pull_request"} & set(_names(triggers)):
        hint = "`on: [push]` starts it on every push."
        raise Missed("a workflow that starts on push or pull_request", str(triggers)[:60], hint)
    jobs = workflow.get("jobs")
    found = [job for job in jobs.values() if isinstance(job, dict)] if isinstance(jobs, dict) else []
    if not found:
        raise Missed("a job below `jobs:`", "none", "A job needs a name, runs-on, a container and steps.")
    job = max(found, key=_tests_found)
    action = _ready_made(job)
    if action != "ros-industrial/industrial_ci":  # which starts a container of its own
        _has_ros(job)
    if action is None:
        _has_files(job)
        _runs_in_order(_commands(job))
        _sources_ros(job)
    _fails_with_a_test(job)


def _tests_found(job: Mapping[str, Any]) -> int:
    """Return how much of building and testing a job does."""
    done = sum(bool(pattern.search(_commands(job))) for pattern in PATTERNS)
    return done + len(PATTERNS) * any(_action(step) in READY_MADE for step in _steps(job))


def _action(step: Mapping[str, Any]) -> str:
    """The action that a step uses, without its version."""
    return str(step.get("uses", "")).partition("@")[0]


def _ready_made(job: Mapping[str, Any]) -> str | None:
    """The action that builds and tests in this job. Raises Missed if it is set up for no distribution."""
    for step in _steps(job):
        action = _action(step)
        place, key = READY_MADE.get(action, ("", ""))
        if place:
            given = {**(job.get("env") or {}), **(step.get(place) or {})}.get(key)
            if given != "jazzy":
                expected, saw = f"{key}: jazzy for {action}", str(given or "none")
                raise Missed(expected, saw, f"Give it in the step, below `{place}:`.", credit=0.5)
            return action
    return None


def _names(value: Any) -> list[str]:
    return [value] if isinstance(value, str) else [str(name) for name in value or ()]


def _steps(job: Mapping[str, Any]) -> Iterator[Mapping[str, Any]]:
    steps = job.get("steps")
    yield from (step for step in (steps if isinstance(steps, list) else ()) if isinstance(step, dict))


def _commands(job: Mapping[str, Any]) -> str:
    """Return what all steps run, without comments."""
    texts = (str(step.get("run", "")) for step in _steps(job))
    return "\n".join(re.sub(r"(?m)(^|\s)#.*$", "", text) for text in texts)


def _has_files(job: Mapping[str, Any]) -> None:
    uses = [str(step["uses"]) for step in _steps(job) if "uses" in step]
    if not any(name.startswith("actions/checkout@") for name in uses):
        hint = "Add it: without it, none of your files are there."
        raise Missed("a step that uses actions/checkout", ", ".join(uses) or "none", hint)


def _has_ros(job: Mapping[str, Any]) -> None:
    container = job.get("container")
    image = str(container.get("image") if isinstance(container, dict) else container or "")
    sets_up = any(_action(step) == "ros-tooling/setup-ros" for step in _steps(job))
    if not sets_up and not ("ros" in image and "jazzy" in image):
        hint = "`container: ros:jazzy` runs the steps where ROS is installed."
        raise Missed("a container with ROS 2 Jazzy", image or "none", hint)


def _runs_in_order(commands: str) -> None:
    build, test, result = (pattern.search(commands) for pattern in PATTERNS)
    for command, place in zip(COMMANDS, (build, test), strict=False):
        if place is None:
            raise Missed(f"`{command}` in a step", "no such command", "Run it in a step.")
    places = zip((build, test, result), COMMANDS, strict=True)
    found = [(place.start(), name) for place, name in places if place]
    if found != sorted(found):
        expected, saw = (", ".join(name for _, name in these) for these in (found, sorted(found)))
        hint = "Build first, then test, then check the result."
        raise Missed(f"{expected}, in this order", saw, hint, credit=0.5)
    if result is None and not FAILS.search(commands):
        hint = ("colcon test exits with 0 even if a test fails, unless it has --return-code-on-test-failure; "
                "colcon test-result doesn't.")
        raise Missed("`colcon test-result` in a step", "no such command", hint, credit=0.5)


def _sources_ros(job: Mapping[str, Any]) -> None:
    """Each step with colcon build or colcon test first sources what it needs, as each is a new shell."""
    hint = "Each step runs in a new shell: source /opt/ros/jazzy/setup.bash, then call colcon."
    for command, pattern, setup in zip(COMMANDS, PATTERNS[:2], (ROS, ROS_OR_BUILT), strict=False):
        for step in _steps(job):
            commands = _commands({"steps": [step]})
            called = pattern.search(commands)
            if called and not setup.search(commands, 0, called.start()):
                credit = 0.5 if command == "colcon test" else 0.0
                expected = f"source /opt/ros/jazzy/setup.bash before {command}, in the same step"
                raise Missed(expected, "no such line", hint, credit=credit)


def _fails_with_a_test(job: Mapping[str, Any]) -> None:
    steps = [job, *_steps(job)]
    if any(step.get("continue-on-error") not in (None, False) for step in steps) or IGNORED.search(
        _commands(job)
    ):
        hint = "A workflow fails if one of its commands fails: remove whatever hides that."
        raise Missed("a workflow that fails if a test fails", "a failure that is ignored", hint, credit=0.5)
