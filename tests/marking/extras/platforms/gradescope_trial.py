"""Judges twenty submissions, most of them hostile, with a Gradescope autograder as Gradescope does.

    python -m tests.marking.extras.platforms.gradescope_trial FOLDER dist/gradescope-02_topics.zip [NAME ...]

In FOLDER/root it makes a root file system laid out as Gradescope's, runs setup.sh there unless that was done
before, and then run_autograder for each submission; see containers.py. Prints the points, the seconds and the
isolation of each, and writes the results to FOLDER/results. It is no test, because it takes a minute for each
submission; test_containers.py judges one of them. It needs root.
"""
import copy
import json
import shutil
import sys
import time
from collections.abc import Callable
from pathlib import Path

import jsonschema
import nbformat

from grader.marking.release.samples import submission
from tests.marking.extras.platforms import containers
from tests.marking.extras.platforms.test_results import GRADESCOPE, METADATA
from tests.marking.hostile import corpus
from tests.marking.tiny import ROOT

ASSIGNMENT, NOTEBOOK = "02_topics", "topics.ipynb"
TRICKS = (
    *("secret_reader", "solution_reader", "fork_bomb", "kills_its_parent", "network", "memory_bomb"),
    *("forged_recording", "printed_score", "wire_forger", "ends_the_process", "disk_bomb", "thread_bomb"),
)
DAMAGES = (
    corpus.broken_json,
    corpus.missing_notebook,
    corpus.edited_test_cell,
    corpus.renamed_notebook,
)
READS = """# %% after square
import os, pathlib
found = []
for place in ("/autograder", "/autograder/source/.secret", "/autograder/results", "/proc/1/environ",
              "/autograder/source/release", "/opt/ros2-course/course/grader/exercises/topics/__init__.py"):
    try:
        found.append(os.listdir(place) if os.path.isdir(place) else open(place).read(80))
    except OSError as error:
        found.append(type(error).__name__)
print("READ", found)
"""


def makers() -> dict[str, Callable[[Path], None]]:
    """How each submission is written into its folder."""
    starter = nbformat.read(ROOT / "exercises" / ASSIGNMENT / NOTEBOOK, 4)
    solution = nbformat.read(ROOT / "solutions" / ASSIGNMENT / NOTEBOOK, 4)
    half = submission(solution, starter, 0.5)
    made = {
        name: corpus._writer(submission(solution, starter, share)) for name, share in corpus.HONEST.items()
    }
    made["reads_everything"] = corpus._writer(corpus.with_trick(half, READS))
    for name in TRICKS:
        text = (ROOT / "tests" / "students" / "hostile" / f"{name}.py").read_text(encoding="utf-8")
        made[name] = corpus._writer(corpus.with_trick(half, text))
    for trick in DAMAGES:
        made[trick.__name__] = lambda place, trick=trick: trick(place, copy.deepcopy(half))
    return made


def install(place: Path, archive: Path) -> Path:
    """Make the root file system and run setup.sh in it, unless that was done before; returns its root."""
    root = place / "root"
    if not (root / "autograder" / "run_autograder").exists():
        containers.make_root(root)
        containers.put_bundle(archive, root / "autograder" / "source")
        done = containers.run(root, "/autograder/source/setup.sh", HOME="/root")
        assert done.returncode == 0, done.stdout + done.stderr
        shutil.copy(root / "autograder" / "source" / "run_autograder", root / "autograder")
    return root


def judge(root: Path, write: Callable[[Path], None]) -> tuple[dict | None, str, float]:
    """Run the autograder as Gradescope does: the results, what it printed, and the seconds."""
    top = root / "autograder"
    containers.lay_out(top, "submission", "results")
    write(top / "submission")
    (top / "submission_metadata.json").write_text(json.dumps(METADATA))
    began = time.monotonic()
    done = containers.run(root, "env", "-C", "/autograder", "/autograder/run_autograder", HOME="/root")
    path = top / "results" / "results.json"
    found = json.loads(path.read_text()) if path.exists() else None
    return found, (done.stdout + done.stderr).strip(), time.monotonic() - began


def main(place: Path, archive: Path, chosen: list[str]) -> None:
    """Judge all, or those named."""
    root = install(place, archive)
    kept = place / "results"
    kept.mkdir(exist_ok=True)
    for name, write in makers().items():
        if chosen and name not in chosen:
            continue
        found, printed, seconds = judge(root, write)
        (kept / f"{name}.txt").write_text(printed)
        about = f"no result. {printed.splitlines()[-1:]}"
        if found is not None:
            jsonschema.validate(found, GRADESCOPE)
            about = f"{found['score']:g} points, {found['extra_data']['isolation']}"
            (kept / f"{name}.json").write_text(json.dumps(found, indent=1))
        print(f"{name}: {about}, {seconds:.0f} s", flush=True)


if __name__ == "__main__":
    assert not containers.missing(), containers.missing()
    main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(), sys.argv[3:])
