"""JPlag and Dolos on the ZIP that `likeness` writes: the pairs that they find most alike.

    python -m tests.marking.extras.likeness.other_programs [STUDENTS PAIRS]

prints, for a generated class, how many of the planted pairs each names first, how alike they are at least,
and the next pair. Environment variables say where the programs are: JPLAG is the jar of JPlag 4, which needs
Java 17, and DOLOS a folder in which `npm install @dodona/dolos-lib` was run.
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Callable
from pathlib import Path

from grader.marking.extras.likeness.likeness_pages import write_texts
from grader.marking.extras.likeness.student_texts import read_texts
from grader.marking.submission.assignment_release import load_release
from tests.marking.extras.likeness.generated_class import ASSIGNMENT, hand_in
from tests.marking.tiny import ROOT

JPLAG, DOLOS = os.environ.get("JPLAG", ""), os.environ.get("DOLOS", "")
SCRIPT = Path(__file__).with_name("dolos_pairs.mjs")
Pairs = list[tuple[frozenset[str], float]]  # the most alike first


def jplag_pairs(archive: Path, place: Path, count: int) -> Pairs:
    """The pairs that JPlag finds most alike. It takes a folder, not a ZIP."""
    texts, results = place / "texts", place / "jplag"
    with zipfile.ZipFile(archive) as opened:
        opened.extractall(texts)
    options = ["-l", "python3", "--cluster-skip", "-n", str(count), "-bc", str(texts / "release")]
    command = ["java", "-jar", JPLAG, *options, "-r", str(results), str(texts)]
    subprocess.run(command, check=True, capture_output=True)
    with zipfile.ZipFile(f"{results}.zip") as opened:
        overview = json.loads(opened.read("overview.json"))
    assert overview["failed_submission_names"] == []
    (average,) = [metric for metric in overview["metrics"] if metric["name"] == "AVG"]
    return [
        (frozenset({row["first_submission"], row["second_submission"]}), row["similarity"])
        for row in average["topComparisons"]
    ]


def dolos_pairs(archive: Path, place: Path, count: int) -> Pairs:
    """The pairs that Dolos finds most alike, in the ZIP itself."""
    command = ["node", str(SCRIPT), DOLOS, str(archive), str(count)]
    found = json.loads(subprocess.run(command, check=True, capture_output=True, cwd=place).stdout)
    return [(frozenset({first, second}), likeness) for first, second, likeness in found["rows"]]


PROGRAMS: dict[str, tuple[str, Callable[[Path, Path, int], Pairs]]] = {
    "JPLAG": (JPLAG, jplag_pairs),
    "DOLOS": (DOLOS, dolos_pairs),
}


def generated_zip(place: Path, students: int, pairs: int) -> tuple[Path, set[frozenset[str]]]:
    """The ZIP of a generated class, and its planted pairs."""
    submitted = place / "submitted"
    planted = hand_in(submitted, students, pairs)
    release = load_release(ROOT / "exercises" / ASSIGNMENT)
    texts, _ = read_texts({path.name: path / ASSIGNMENT for path in sorted(submitted.iterdir())}, release)
    write_texts(texts, release, place / "texts.zip")
    return place / "texts.zip", planted


def main(students: int = 300, pairs: int = 10) -> None:
    """Print what each program finds."""
    place = Path(tempfile.mkdtemp())
    archive, planted = generated_zip(place, students, pairs)
    for name, (where, find) in PROGRAMS.items():
        if not where:
            print(f"{name}: the environment variable doesn't say where it is")
            continue
        found = find(archive, place, pairs + 10)
        first = [likeness for pair, likeness in found[:pairs] if pair in planted]
        least, after = min(first, default=0.0), found[pairs][1]
        print(f"{name}: {len(first)} of {pairs} planted pairs first, from {least:.2f}; the next {after:.2f}")
    shutil.rmtree(place)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
