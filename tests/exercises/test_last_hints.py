"""The last hint of an exercise asks what to decide; it doesn't write the answer."""

import json
import re
from pathlib import Path

import pytest

SOLUTIONS = Path(__file__).parents[2] / "solutions"
RUN = 3  # tokens in a row that count as given away: single names are in the task, too
LAST, ALL = 1 / 3, 4 / 5  # of the answer's tokens, in the last hint and in all three


def tokens(code: str) -> list[str]:
    return re.findall(r"\w+|[^\w\s]", code)


def code_in(hint: str) -> list[str]:
    """Code blocks, and code within sentences."""
    blocks = re.findall(r"```\w*\n(.*?)```", hint, re.S)
    return blocks + re.findall(r"`([^`]+)`", re.sub(r"```.*?```", "", hint, flags=re.S))


def share(answer: str, hints: list[str]) -> float:
    """The part of the answer's tokens that the hints have in the same order, three or more in a row."""
    runs = set()
    for code in (code for hint in hints for code in code_in(hint)):
        words = tokens(code)
        runs |= {tuple(words[begin : begin + RUN]) for begin in range(len(words) - RUN + 1)}
    words = tokens(answer)
    begins = [n for n in range(len(words)) if tuple(words[n : n + RUN]) in runs]
    return len({begin + step for begin in begins for step in range(RUN)}) / len(words)


def answers_and_hints() -> dict[str, tuple[str, list[str]]]:
    """The solution without its comments, and the hints of each exercise, by assignment and exercise."""
    found = {}
    for path in sorted(SOLUTIONS.glob("*/*.ipynb")):
        answer = ""
        for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
            source = "".join(cell["source"])
            parts = re.findall(r"### BEGIN SOLUTION\n(.*?)### END SOLUTION", source, re.S)
            answer += re.sub(r"(^|\s)#.*", "", "".join(parts), flags=re.M)
            if cell["id"].endswith("-hints"):
                hints = re.findall(r"<summary>(.*?</summary>.*?)</details>", source, re.S)
                found[f"{path.stem}/{cell['id'].removesuffix('-hints')}"] = (answer, hints)
                answer = ""
    return found


EXERCISES = answers_and_hints()


@pytest.mark.parametrize("exercise", sorted(EXERCISES))
def test_the_last_hint_leaves_the_decision_to_the_student(exercise):
    answer, hints = EXERCISES[exercise]
    assert len(hints) == 3
    assert "?" in hints[-1], "the last hint asks what to decide"
    assert share(answer, hints[-1:]) <= LAST
    assert share(answer, hints) <= ALL


def test_the_share_of_an_answer():
    answer = "self.count += 1\nself.publisher.publish(self.count)"  # 16 tokens
    assert share(answer, ["in words", "`self.count`"]) == 6 / 16
    assert share(answer, [f"```python\n{answer}\n```"]) == 1.0
