"""A class whose packages are hostile, and one who is honest.

Everybody hands in two packages beside the notebook: `greeter`, which is built, worth 16 points, and
`crate_interfaces`, whose types are built, worth 20. A trick spoils one of them; the rest is right.

tests/marking/hostile/packages.txt says what each gets, word by word.

    python -m tests.marking.hostile.packages    writes the page anew: read what changed, then commit
"""

from __future__ import annotations

import copy
import functools
import os
import re
import tempfile
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

import nbformat

from grader.marking.pool import Pool
from grader.marking.result import Result
from grader.marking.submission.assignment_release import Release
from grader.marking.submission.submitted_files import read_folder
from grader.marking.task import MarkingTask
from tests.exercises.launching.crates import students as crates
from tests.exercises.packages.greeter import students as greeter
from tests.marking.hostile.corpus import SECRET, block, blocks
from tests.marking.tiny import answer, grade

PAGE = Path(__file__).with_name("packages.txt")
SETUP, NODE = "greeter/setup.py", "greeter/greeter/hello.py"
RIGHT = {**greeter.RIGHT, **crates.RIGHT}
RELEASE = Release(
    "11_small",
    {
        "small": nbformat.v4.new_notebook(
            cells=[
                nbformat.v4.new_code_cell("from grader.exercises import launching, packages", id="setup"),
                answer("own", "# yours"),
                grade("greeter-points", 16, 'packages.greeter.grade("ws")'),
                grade("crates-points", 20, 'launching.crates.grade("ws")'),
            ]
        )
    },
)
BY_CHANCE = ("setup_forks", "setup_kills")  # which limit ends them, and with which words
Trick = Callable[[Path], str | None]
"""Changes what was written into ws/src; a text that it returns is the answer's cell."""


def mark(folder: Path, names: Iterable[str]) -> dict[str, Result]:
    """Hand in for those named, and mark them; name to result. The secret is in the class's folder."""
    (folder / ".secret").write_text(SECRET)
    tasks = [_submitted(folder / name, TRICKS[name]) for name in names]
    with Pool(2, secret=SECRET) as pool:
        return {result.student: result for result in pool.mark(tasks)}


def _submitted(place: Path, trick: Trick) -> MarkingTask:
    sources = place / "ws/src"
    _write(sources, RIGHT)
    notebook = copy.deepcopy(RELEASE.notebooks["small"])
    notebook.cells[1].source = trick(sources) or "# mine"
    nbformat.write(notebook, place / "small.ipynb")
    return MarkingTask(place.name, RELEASE, read_folder(place, RELEASE), "00")


def _write(sources: Path, files: Mapping[str, str]) -> None:
    for path, text in files.items():
        (sources / path).parent.mkdir(parents=True, exist_ok=True)
        (sources / path).write_text(text)


def reported(result: Result) -> str:
    """What the page says of one submission, with what was seen where something was missed."""
    cells = [cell for notebook in result.notebooks for cell in notebook.cells]
    missed = [(cell, it) for cell in cells for it in cell.verdicts if it["status"] == "failed"]
    if result.student in BY_CHANCE:
        return block(result)
    lines = [f"  Saw in {cell.exercise}: {it['saw'].rstrip('.')}. {it['hint']}" for cell, it in missed]
    lines = [line.rstrip() for line in lines]
    return re.sub(r"line \d+", "line N", "\n".join([block(result), *lines]))


def page() -> dict[str, str]:
    """Name to what the page says of a submission."""
    return blocks(PAGE)


# -- tricks -----------------------------------------------------------------------------------------


def honest(_: Path) -> None:
    """Nothing is wrong with it."""


def before_setup(text: str, sources: Path) -> None:
    """Lines that setup.py runs before what it should."""
    _write(sources, {SETUP: f"{text}\n{RIGHT[SETUP]}"})


def in_setup(old: str, new: str, sources: Path) -> None:
    """Another text in setup.py."""
    assert old in RIGHT[SETUP]
    _write(sources, {SETUP: RIGHT[SETUP].replace(old, new)})


def in_file(path: str, old: str, new: str, sources: Path) -> None:
    """Another text in a file; all of it without `old`."""
    assert old in RIGHT[path]
    _write(sources, {path: RIGHT[path].replace(old, new) if old else new})


def linked_secret(sources: Path) -> None:
    """A module is a link to the instructor's secret."""
    (sources / NODE).unlink()
    (sources / NODE).symlink_to(sources.parents[2] / ".secret")


def linked_folder(sources: Path) -> None:
    """The package is a link to all that there is."""
    (sources / "all").symlink_to("/")


def pipe(sources: Path) -> None:
    """No one ever writes into it."""
    os.mkfifo(sources / "greeter/pipe")


def thousands_of_files(sources: Path) -> None:
    """All of them are empty."""
    _write(sources, {f"greeter/more/f{number}": "" for number in range(3000)})


def huge_file(sources: Path) -> None:
    """It has 25 GB, and takes no room on the disk."""
    (sources / "greeter/huge").touch()
    os.truncate(sources / "greeter/huge", 25_000_000_000)


def deep_folders(sources: Path) -> None:
    """Folders in folders."""
    _write(sources, {f"greeter/{'a/' * 500}a": ""})


def strange_name(sources: Path) -> None:
    """A name that a terminal would take for a command."""
    _write(sources, {"greeter/\x1b[2J\n`16.0`": ""})


def cell(text: str, _: Path) -> str:
    """What the notebook does before the packages are asked for."""
    return text


ENTITIES = '<!DOCTYPE a [<!ENTITY b "16.0"><!ENTITY c "&b;&b;&b;&b;&b;&b;&b;&b;">]>\n<package format="3">'
OUTSIDE = """
import os, sys
for place in ("/tmp", "/var/tmp", os.path.expanduser("~"), sys.prefix, "../../../../..", "/"):
    try:
        open(os.path.join(place, "left_by_setup"), "w").close()
    except OSError:
        pass
"""
PRINTS = """
import os, sys
print("16.0", flush=True)
print('{"problem": "", "points": 16}\\nFinished <<< greeter [1s]', file=sys.stderr, flush=True)
os._exit(0)
"""
FLOOD = """
import atexit, os
share = os.path.expanduser("~/ws/install/share")
atexit.register(lambda: [open(f"{share}/f{n}", "w").close() for n in range(600) if os.path.isdir(share)])
"""
ANSWERS = """
from grader.workspace import installation
installation.serialize_sources = lambda nodes, name: {"../../.secret": b"", f"{name}/package.xml": b"<a>"}
"""
MORE = "for number in range(3000): open(f'ws/src/greeter/f{number}', 'w').close()"
RUNS = 'execute_process(COMMAND sh -c "touch ran; kill -9 1")\nfile(WRITE /tmp/ran "18.0")\nproject('
GROWS = "set(a b)\n" + "set(a ${a}${a})\n" * 500 + "project("

_partial = functools.partial
TRICKS: dict[str, Trick] = {
    "honest": honest,
    "setup_prints_a_score": _partial(before_setup, PRINTS),
    "setup_writes_outside": _partial(before_setup, OUTSIDE),
    "setup_forks": _partial(before_setup, "import os\nwhile True: os.fork()"),
    "setup_kills": _partial(before_setup, "import os, signal\nos.kill(-1, signal.SIGKILL)"),
    "setup_installs_thousands": _partial(before_setup, FLOOD),
    "setup_installs_the_system": _partial(
        in_setup, "['package.xml'])", "['package.xml', '../../../../etc/passwd', '../../../../proc/version'])"
    ),
    "setup_installs_outside": _partial(
        in_setup, "data_files=[", "data_files=[('../../../../out', ['setup.py']),"
    ),
    "own_setuptools": lambda sources: _write(sources, {"greeter/setuptools.py": PRINTS}),
    "entry_point_with_a_path": _partial(
        in_setup, "'hello = greeter.hello:main'", "'../../../../out = greeter.hello:main'"
    ),
    "entry_point_elsewhere": _partial(in_setup, "greeter.hello:main", "os:getcwd"),
    "entry_point_of_the_course": _partial(
        in_setup, "greeter.hello:main", "grader.exercises.packages:greeter.grade"
    ),
    "entities": _partial(in_file, "greeter/package.xml", '<package format="3">', ENTITIES),
    "linked_secret": linked_secret,
    "linked_folder": linked_folder,
    "pipe": pipe,
    "thousands_of_files": thousands_of_files,
    "huge_file": huge_file,
    "deep_folders": deep_folders,
    "strange_name": strange_name,
    "cell_makes_a_link": _partial(cell, "import os\nos.symlink('/proc', 'ws/src/greeter/all')"),
    "cell_makes_thousands": _partial(cell, MORE),
    "cell_answers_for_the_workspace": _partial(cell, ANSWERS),
    "cmake_runs_programs": _partial(in_file, crates.CMAKE, "project(", RUNS),
    "cmake_grows": _partial(in_file, crates.CMAKE, "project(", GROWS),
    "name_without_end": _partial(in_file, crates.CRATE, "FULL=1", "A" * 150 + "_=1"),
    "definition_without_end": _partial(in_file, crates.CRATE, "", " " * 250_000),
}


def write_page() -> None:
    """Mark everybody, and write down what each gets."""
    with tempfile.TemporaryDirectory() as folder:
        results = mark(Path(folder), TRICKS)
    PAGE.write_text("\n\n".join(reported(results[name]) for name in TRICKS) + "\n", encoding="utf-8")


if __name__ == "__main__":
    write_page()
