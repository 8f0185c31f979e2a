"""How long a lesson takes, estimated from what is in it: python -m tests.tooling.lesson_times

It prints, for each notebook of a lesson, what was counted, the estimate, and the time that it shows.
The estimate is for a student who reads everything once, runs every cell, and does everything that is offered.
"""

from __future__ import annotations

import ast
import json
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from grader.course_files.course_notebooks import TIME, course_order

ROOT = Path(__file__).parents[2]
LIMIT = 90  # minutes
DEEPEST = 3  # classes of a lesson, each derived from the one before it

# A minute. Adults read nonfiction silently at about 240 words (Brysbaert, 2019); a text that is full of new
# terms takes twice as long.
WORDS = 120
LINES = 10  # of code, a minute
# Minutes for each of these.
CELL = 0.4  # to run a cell, and to look at its output
TRY = 5.0  # "Try it yourself"
QUESTION = 1.0  # in "Check yourself", a prediction before a run with what came out, or what `explore` found
PLAY = 3.0  # a live robot, or callbacks that are scheduled by hand
SLIDER = 2.0
BUILD = 0.5  # `colcon build`
TERMINAL = 4.0  # a block of commands to type into a terminal

FENCE = re.compile(r"^```.*?^```", re.S | re.M)
WORD = re.compile(r"[A-Za-z][\w'-]*")
IN_TERMINAL = re.compile(r"^(ros2 (run|launch)|python -m sim)", re.M)
SOURCE = re.compile(r"inspect\.getsource\((\w+)\.(\w+)\)")
PREDICTION = re.compile(r"\bpredict\(|\.outcome\(")
MOVES = re.compile(r"\banimate\(|\.replay\(|^@?interact\(|\bplay\(|^drive_one_of_two\(", re.M)
NO_PYTHON = re.compile(r"^[%!].*", re.M)


@dataclass(frozen=True)
class Lesson:
    """What a notebook of a lesson has, counted. moves: the first code cell in which something moves."""

    name: str
    shown: str
    words: int
    lines: int
    cells: int
    tries: int
    questions: int
    predictions: int
    moves: int | None
    plays: int
    sliders: int
    builds: int
    terminals: int
    classes: int
    depth: int

    @property
    def minutes(self) -> float:
        """The estimate."""
        reading = self.words / WORDS + self.lines / LINES + self.cells * CELL
        doing = self.tries * TRY + self.questions * QUESTION + self.plays * PLAY + self.sliders * SLIDER
        return reading + doing + self.builds * BUILD + self.terminals * TERMINAL

    @property
    def shown_minutes(self) -> int:
        """The time that the notebook shows, as "about 75 minutes". Raises ValueError for another form."""
        found = re.fullmatch(r"about (\d+) minutes", self.shown)
        if found is None:
            raise ValueError(f"{self.name}: expected “about 75 minutes”, saw “{self.shown}”")
        return int(found[1])


def lessons() -> list[Lesson]:
    """All notebooks of all lessons, in the order of the course."""
    return [count(path) for path in sorted(ROOT.glob("course/[0-9]*/*.ipynb"), key=course_order)]


def count(path: Path) -> Lesson:
    """What a lesson has."""
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    text = "\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown")
    sources = ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]
    everything = "\n".join(sources)
    sources = [source for source in sources if not PREDICTION.search(source)]
    code = "\n".join(sources)
    printed = [_definition(path.with_name(f"{module}.py"), name) for module, name in SOURCE.findall(code)]
    bases = dict(_bases(path.parent, sources))
    return Lesson(
        name=f"{path.parent.name}/{path.stem}",
        shown=" ".join(TIME.search(text)[1].split()),
        words=len(WORD.findall(FENCE.sub("", text))),
        lines=sum(map(_read, "\n".join([code, *printed]).splitlines())),
        cells=len(sources),
        tries=text.count("**Try it yourself"),
        questions=text.count("<details>") + len(re.findall(r"\b(?:predict|explore)\(", everything)),
        predictions=everything.count("predict("),
        moves=next((n for n, source in enumerate(sources, 1) if MOVES.search(source)), None),
        plays=len(re.findall(r"\b(?:play|schedule)\(", code)),
        sliders=len(re.findall(r"^@?interact\(", code, re.M)),
        builds=code.count("colcon build"),
        terminals=sum(1 for block in FENCE.findall(text) if IN_TERMINAL.search(block)),
        classes=code.count("\nclass ") + code.startswith("class "),
        depth=max((_depth(name, bases) for name in bases), default=0),
    )


def _read(line: str) -> bool:
    """Whether a line of code is one to read."""
    return bool(line.strip()) and not line.startswith(("import ", "from "))


def _definition(file: Path, name: str) -> str:
    """The source of what a module beside the lesson defines."""
    text = file.read_text(encoding="utf-8")
    named = (item for item in ast.parse(text).body if getattr(item, "name", "") == name)
    return ast.get_source_segment(text, next(named)) or ""


def _bases(folder: Path, sources: list[str]) -> Iterator[tuple[str, list[str]]]:
    """The names of the classes of a lesson and of the modules beside it, each with those of its bases."""
    modules = [path.read_text(encoding="utf-8") for path in sorted(folder.glob("*.py"))]
    for source in [*modules, *sources]:
        for item in _body(source):
            if isinstance(item, ast.ClassDef):
                yield item.name, [ast.unparse(base).rpartition(".")[2] for base in item.bases]


def _body(source: str) -> list[ast.stmt]:
    """The statements of a cell; none for one that isn't Python."""
    return [] if source.startswith("%%") else ast.parse(NO_PYTHON.sub("", source)).body


def _depth(name: str, bases: dict[str, list[str]], below: tuple[str, ...] = ()) -> int:
    """How many of these classes are in the longest chain that ends with this one."""
    chain = (*below, name)
    return 1 + max(
        (_depth(base, bases, chain) for base in bases[name] if base in bases and base not in chain), default=0
    )


if __name__ == "__main__":
    print(f"{'':26}minutes  shown              words lines cells tries", end="")
    print(" classes depth plays sliders predict moves")
    for lesson in lessons():
        read = f"{lesson.words:5} {lesson.lines:5} {lesson.cells:5} {lesson.tries:5}"
        print(f"{lesson.name:26}{lesson.minutes:7.0f}  {lesson.shown[:18]:18} {read}", end="")
        print(f"{lesson.classes:8} {lesson.depth:5} {lesson.plays:5} {lesson.sliders:7}", end="")
        print(f" {lesson.predictions:7} {lesson.moves or '':>5}")
