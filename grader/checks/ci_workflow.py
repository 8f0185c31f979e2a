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
SETUP = re.compile(r"(?:source|\.)\s+/opt/ros/jazzy/setup\.(?:ba)?sh")
IGNORED = re.compile(r"test-result[^\n]*\|\|")


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
    job = max(found, key=lambda job: sum(bool(pattern.search(_commands(job))) for pattern in PATTERNS))
    _has_ros(job)
    _runs_in_order(_commands(job))
    _fails_with_a_test(job)


def _names(value: Any) -> list[str]:
    return [value] if isinstance(value, str) else [str(name) for name in value or ()]


def _steps(job: Mapping[str, Any]) -> Iterator[Mapping[str, Any]]:
    steps = job.get("steps")
    yield from (step for step in (steps if isinstance(steps, list) else ()) if isinstance(step, dict))


def _commands(job: Mapping[str, Any]) -> str:
    """What all steps run, without comments."""
    texts = (str(step.get("run", "")) for step in _steps(job))
    return "\n".join(re.sub(r"(?m)(^|\s)#.*$", "", text) for text in texts)


def _has_ros(job: Mapping[str, Any]) -> None:
    uses = [str(step["uses"]) for step in _steps(job) if "uses" in step]
    if not any(name.startswith("actions/checkout@") for name in uses):
        raise Missed(
            "a step that uses actions/checkout",
            ", ".join(uses) or "none",
            "Add it: without it, none of your files are there.",
        )
    container = job.get("container")
    image = str(container.get("image") if isinstance(container, dict) else container or "")
    if not ("ros" in image and "jazzy" in image) and not any("setup-ros" in name for name in uses):
        hint = "`container: ros:jazzy` runs the steps where ROS is installed."
        raise Missed("a container with ROS 2 Jazzy", image or "none", hint)
    if not SETUP.search(_commands(job)):
        hint = "Each step runs in a new shell: source /opt/ros/jazzy/setup.bash, then call colcon."
        raise Missed("source /opt/ros/jazzy/setup.bash before colcon", "no such line", hint)


def _runs_in_order(commands: str) -> None:
    places = [pattern.search(commands) for pattern in PATTERNS]
    for command, place in zip(COMMANDS, places, strict=True):
        if place is None:
            hint = "colcon test exits with 0 even if a test fails; colcon test-result doesn't." * (
                command == COMMANDS[-1]
            )
            credit = 0.5 if command == COMMANDS[-1] else 0.0
            raise Missed(
                f"`{command}` in a step", "no such command", hint or "Run it in a step.", credit=credit
            )
    starts = [place.start() for place in places if place]
    if starts != sorted(starts):
        found = sorted(COMMANDS, key=lambda command: starts[COMMANDS.index(command)])
        raise Missed(
            f"{', '.join(COMMANDS)}, in this order",
            ", ".join(found),
            "Build first, then test, then check the result.",
            credit=0.5,
        )


def _fails_with_a_test(job: Mapping[str, Any]) -> None:
    steps = [job, *_steps(job)]
    if any(step.get("continue-on-error") not in (None, False) for step in steps) or IGNORED.search(
        _commands(job)
    ):
        hint = "A workflow fails if one of its commands fails: remove whatever hides that."
        raise Missed("a workflow that fails if a test fails", "a failure that is ignored", hint, credit=0.5)
