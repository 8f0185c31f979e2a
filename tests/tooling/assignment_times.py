"""How long an assignment takes a student: python -m tests.tooling.assignment_times

It prints, for each assignment, what was counted, the estimate, and the time that its first cell shows.
The estimate is for a student who has read the lesson, and opens every hint.
"""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from pathlib import Path

from grader.course_files.course_notebooks import TIME
from tests.tooling.lesson_times import BUILD, LINES, WORD, WORDS

ROOT = Path(__file__).parents[2]
LIMIT = 150  # minutes

# Minutes for each of these.
LINE = 1.0  # of an answer in Python: to find, write and correct it
SETTING = 0.4  # a line of an answer in another file, which the lesson shows
EXERCISE = 7.0  # to plan it, and to read what each run and each check shows
LOOKS = 4  # at what a package does, each with a build

SETTINGS = re.compile(r"%%writefile \S+(?:(?<!\.py)|setup\.py)$", re.M)
ANSWER = re.compile(r"### BEGIN SOLUTION\n(.*?)### END SOLUTION", re.S)
HOURS = {"an hour": 1.0, "one": 1.0, "two": 2.0, "three": 3.0, "four": 4.0}
PARTS = {"quarter": 0.25, "half": 0.5, "three quarter": 0.75}
SHOWN = re.compile(
    r"about (an hour|one|two|three|four)(?: and (?:an? )?(three quarter|quarter|half))?(?: hours)?"
)


@dataclass(frozen=True)
class Tasks:
    """What an assignment has, counted. settings: lines of answers in files that aren't Python."""

    name: str
    shown: str
    words: int
    given: int
    answers: int
    settings: int
    exercises: int
    builds: int

    @property
    def minutes(self) -> float:
        """The estimate."""
        reading = self.words / WORDS + self.given / LINES
        writing = self.answers * LINE + self.settings * SETTING
        return reading + writing + self.exercises * EXERCISE + self.builds * BUILD * LOOKS

    @property
    def shown_minutes(self) -> float:
        """The time that it shows, as "about two and a half hours". Raises ValueError for another form."""
        found = SHOWN.fullmatch(self.shown)
        if found is None:
            raise ValueError(f"{self.name}: expected “about two and a half hours”, saw “{self.shown}”")
        return 60 * (HOURS[found[1]] + PARTS.get(found[2], 0.0))


def assignments() -> list[Tasks]:
    """All assignments, in the order of the course."""
    return [count(path) for path in sorted(ROOT.glob("solutions/[0-9]*/*.ipynb"))]


def count(path: Path) -> Tasks:
    """What an assignment has."""
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    text = "\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown")
    code = [cell for cell in cells if cell["cell_type"] == "code"]
    graded = [cell for cell in code if cell["metadata"].get("nbgrader", {}).get("grade")]
    sources = ["".join(cell["source"]) for cell in code if cell not in graded]
    files = [source for source in sources if SETTINGS.match(source)]
    written = [_lines("".join(ANSWER.findall(source))) for source in sources]
    settings = sum(_lines("".join(ANSWER.findall(source))) for source in files)
    return Tasks(
        name=path.parent.name,
        shown=" ".join(TIME.search(text)[1].split()),
        words=len(WORD.findall(text)),
        given=_lines("".join(ANSWER.sub("", source) for source in sources)),
        answers=sum(written) - settings,
        settings=settings,
        exercises=len(graded),
        builds=len(graded) if "colcon build" in text else 0,
    )


def _lines(text: str) -> int:
    return sum(1 for line in text.splitlines() if line.strip())


if __name__ == "__main__":
    print(f"{'':16}minutes  shown                              words given lines settings exercises")
    for each in assignments():
        counted = f"{each.words:5} {each.given:5} {each.answers:5} {each.settings:8} {each.exercises:9}"
        print(f"{each.name:16}{each.minutes:7.0f}  {each.shown[:34]:34} {counted}")
