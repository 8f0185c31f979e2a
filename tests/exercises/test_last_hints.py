"""The last hint of an exercise shows the shape of the answer, and leaves at least one line open."""

import json
import re
from pathlib import Path

import pytest

SOLUTIONS = Path(__file__).parents[2] / "solutions"
GAP = "..."
SHORT = 9  # letters: lines such as `else:` and `return x` are in many answers
# Their last hint has no code: it says what to count, to compare or to look at.
IN_WORDS = {"packages/patrol", "delivery/blueprint", "delivery/deliver"}


def squeezed(text: str) -> str:
    return re.sub(r"[\s`]", "", text)


def answers_and_hints() -> dict[str, tuple[list[str], list[str]]]:
    """The lines of the solution and the hints of each exercise, by assignment and exercise."""
    found = {}
    for path in sorted(SOLUTIONS.glob("*/*.ipynb")):
        lines: list[str] = []
        for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
            source = "".join(cell["source"])
            for part in re.findall(r"### BEGIN SOLUTION\n(.*?)### END SOLUTION", source, re.S):
                lines += [line.strip() for line in part.splitlines()]
            if cell["id"].endswith("-hints"):
                hints = re.findall(r"</summary>(.*?)</details>", source, re.S)
                found[f"{path.stem}/{cell['id'].removesuffix('-hints')}"] = (lines, hints)
                lines = []
    return found


EXERCISES = answers_and_hints()


@pytest.mark.parametrize("exercise", sorted(EXERCISES))
def test_the_last_hint_leaves_a_line_open(exercise):
    lines, hints = EXERCISES[exercise]
    assert len(hints) == 3
    assert (GAP in hints[-1]) == (exercise not in IN_WORDS)
    code = [line for line in lines if len(squeezed(line)) >= SHORT and not line.startswith("#")]
    shown = squeezed("".join(hints))
    assert [line for line in code if squeezed(line) not in shown], "the hints together are the whole answer"
