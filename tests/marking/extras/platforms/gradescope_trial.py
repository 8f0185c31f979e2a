"""Runs a built Gradescope autograder on submissions in a root file system laid out as Gradescope does.

    python -m tests.marking.extras.platforms.gradescope_trial ROOT [NAME ...]

ROOT is a root file system, such as mmdebstrap makes it, in which setup.sh of a ZIP for 02_topics has been run
in /autograder/source, with /proc and /dev mounted. Each submission, of which most are hostile, runs with the
capabilities and the filter of system calls that Docker gives a container. Prints the points, the seconds and
the isolation of each, and writes the results beside ROOT. It needs root. It is no test, because it takes a
minute for each submission and a network for setup.sh.
"""
import copy
import json
import shutil
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import jsonschema
import nbformat

from grader.marking.release.samples import submission
from tests.marking.extras.platforms.test_results import GRADESCOPE, METADATA
from tests.marking.hostile import corpus
from tests.marking.sandbox.docker_like import run_in_container
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


def judge(root: Path, write: Callable[[Path], None]) -> tuple[dict | None, str, float]:
    """Run the autograder as Gradescope does: the results, what it printed, and the seconds."""
    top = root / "autograder"
    for name in ("submission", "results"):
        shutil.rmtree(top / name, ignore_errors=True)
        (top / name).mkdir()
    write(top / "submission")
    (top / "submission_metadata.json").write_text(json.dumps(METADATA))
    began = time.monotonic()
    clean = ["env", "-i", "PATH=/usr/bin:/bin", "HOME=/root", "LANG=C.UTF-8"]
    done = run_in_container("chroot", str(root), *clean, "/autograder/run_autograder", timeout=1200)
    path = top / "results" / "results.json"
    found = json.loads(path.read_text()) if path.exists() else None
    return found, (done.stdout + done.stderr).strip(), time.monotonic() - began


def main(root: Path, chosen: list[str]) -> None:
    """Judge all, or those named."""
    kept = root.with_name("gradescope-results")
    kept.mkdir(exist_ok=True)
    for name, write in makers().items():
        if chosen and name not in chosen:
            continue
        found, printed, seconds = judge(root, write)
        about = "no result"
        if found is not None:
            jsonschema.validate(found, GRADESCOPE)
            about = f"{found['score']:g} points, {found['extra_data']['isolation']}"
            (kept / f"{name}.json").write_text(json.dumps(found, indent=1))
        print(f"{name}: {about}, {seconds:.0f} s. {printed.splitlines()[-1:] or ''}", flush=True)


if __name__ == "__main__":
    assert subprocess.run(["id", "-u"], capture_output=True).stdout == b"0\n", "it needs root"
    main(Path(sys.argv[1]).resolve(), sys.argv[2:])
