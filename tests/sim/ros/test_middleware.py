"""What was measured of Fast DDS still holds: what the engine does in simulated time rests on it."""

import json
import re
import time
from pathlib import Path

import pytest
import rclpy

from sim import run
from tests.sim.ros import middleware
from tests.sim.ros.one_sided import ONE_SIDED

FACTS = (Path(__file__).parent / "middleware_facts.txt").read_text(encoding="utf-8")
NEAR = 0.3  # s: two real processes


def facts(case: str) -> list[tuple[float, str, str]]:
    """What the text says of a case."""
    lines = FACTS.split(f"== {case}\n")[1].split("\n==")[0].split("\n\n---")[0].splitlines()
    return [(float(line[:5]), line[6], line[8:]) for line in lines]


def by_side(rows: list[tuple[float, str, str]], side: str) -> tuple[list[float], list[str]]:
    """When one side printed something, and what; not when a full queue or an acknowledgment decides."""
    mine = [row for row in rows if row[1] == side]
    words = [re.sub(r"missed \d.*", "missed many", row[2]) for row in mine]
    return [max(row[0], 0.0) for row in mine if not re.search("refused|acknowledged", row[2])], words


@pytest.mark.soak
@pytest.mark.parametrize("case", middleware.CASES)
def test_two_processes_do_what_was_measured(case):
    seen = middleware.observe(case)
    for side in "RW":
        stamps, words = by_side(seen, side)
        expected_stamps, expected = by_side(facts(case), side)
        assert words == expected
        assert stamps == pytest.approx(expected_stamps, abs=NEAR)


OF_THE_SPEAKER = "offered", "lost", "is asked", "leaves"


def in_a_run(case: str, monkeypatch: pytest.MonkeyPatch) -> list[tuple[float, str, str]]:
    """What both sides print in simulated time, in which they find each other at once."""

    def program(side):
        def main():
            monkeypatch.setattr(middleware, "BEGIN", time.time() + 1.0)
            rclpy.init()
            side(case)

        return main

    recording = run(program(middleware.listen), program(middleware.speak), seconds=8, quiet=True)
    assert recording.errors == []
    rows = map(json.loads, "".join(text for _, text in recording.prints).splitlines())
    return [(at, "W" if words.startswith(OF_THE_SPEAKER) else "R", words) for at, words in rows]


@pytest.mark.parametrize("case", ONE_SIDED)
def test_a_run_does_with_a_policy_at_one_end_what_two_processes_do(case, monkeypatch):
    seen = in_a_run(case, monkeypatch)
    for side in "RW":
        (stamps, words), (expected_stamps, expected) = by_side(seen, side), by_side(facts(case), side)
        assert words == expected
        assert stamps == pytest.approx(expected_stamps, abs=NEAR)


def test_every_case_has_its_facts():
    assert re.findall(r"^== (.*)$", FACTS, re.M) == list(middleware.CASES)
