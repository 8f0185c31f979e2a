"""What was measured of Fast DDS still holds: what the engine does in simulated time rests on it."""

import re
from pathlib import Path

import pytest

from tests.sim.ros import middleware

FACTS = (Path(__file__).parent / "middleware_facts.txt").read_text(encoding="utf-8")
NEAR = 0.3  # s: two real processes


def facts(case: str) -> list[tuple[float, str, str]]:
    """What the text says of a case."""
    lines = FACTS.split(f"== {case}\n")[1].split("\n==")[0].split("\n\n---")[0].splitlines()
    return [(float(line[:5]), line[6], line[8:]) for line in lines]


def by_side(rows: list[tuple[float, str, str]], side: str) -> tuple[list[float], list[str]]:
    """When one side printed something, and what; when a queue is full, the machine's speed decides."""
    mine = [row for row in rows if row[1] == side]
    words = [re.sub(r"missed \d.*", "missed many", row[2]) for row in mine]
    return [max(row[0], 0.0) for row in mine if "refused" not in row[2]], words


@pytest.mark.soak
@pytest.mark.parametrize("case", middleware.CASES)
def test_two_processes_do_what_was_measured(case):
    seen = middleware.observe(case)
    for side in "RW":
        stamps, words = by_side(seen, side)
        expected_stamps, expected = by_side(facts(case), side)
        assert words == expected
        assert stamps == pytest.approx(expected_stamps, abs=NEAR)


def test_every_case_has_its_facts():
    assert re.findall(r"^== (.*)$", FACTS, re.M) == list(middleware.CASES)
