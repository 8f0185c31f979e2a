"""The autograders of all three platforms, installed and run in root file systems laid out as there.

Needs root, mmdebstrap, PyPI and what `make wheels` builds; gradescope_trial.py judges more submissions.
"""
import contextlib
import copy
import json
import os
from pathlib import Path

import jsonschema
import nbformat
import pytest

from grader.__main__ import main
from grader.marking.release.samples import submission
from tests.marking.extras.platforms import containers
from tests.marking.extras.platforms.gradescope_trial import READS, install
from tests.marking.extras.platforms.gradescope_trial import judge as judge_on_gradescope
from tests.marking.extras.platforms.test_results import CLASSROOM50, PRAIRIELEARN, RUNNER
from tests.marking.hostile import corpus
from tests.marking.tiny import ROOT

ASSIGNMENT, NOTEBOOK = "02_topics", "topics.ipynb"
SECRET = "the secret of this container"
ISOLATIONS = ("bubblewrap", "separate user with Landlock", "separate user")
COURSE = ("LICENSE", "requirements.lock", "pyproject.toml", "sim", "grader", "exercises", "ros_packages")
MISSING = "Expected the notebook `topics.ipynb`, saw none. Hand it in under this name."

pytestmark = [
    pytest.mark.soak,
    pytest.mark.skipif(bool(containers.missing()), reason=containers.missing() or "-"),
    pytest.mark.skipif(not [*(ROOT / "wheels").glob("ros2_course_*.whl")], reason="run `make wheels` first"),
]


@pytest.fixture(scope="module")
def course(tmp_path_factory) -> Path:
    """The folder of this course with a secret of its own."""
    folder = tmp_path_factory.mktemp("course")
    for name in (*COURSE, "wheels"):
        (folder / name).symlink_to(ROOT / name)
    (folder / ".secret").touch(mode=0o600)
    (folder / ".secret").write_text(SECRET)
    return folder


def bundle(course: Path, *words: str) -> Path:
    """What the command writes for a platform."""
    with contextlib.chdir(course):
        assert main(["platform", words[0], ASSIGNMENT, *words[1:]]) == 0
    (made,) = (course / "dist").glob(f"{words[0]}-*")
    return made


@pytest.fixture(scope="module")
def root(course, tmp_path_factory) -> Path:
    """A root file system in which Gradescope's setup.sh was run."""
    place = tmp_path_factory.mktemp("container")
    return install(place, bundle(course, "gradescope", "--exercise", "greeting"))


def half_right():
    """A submission of which half is right, and its cells that read everything."""
    starter = nbformat.read(ROOT / "exercises" / ASSIGNMENT / NOTEBOOK, 4)
    return submission(nbformat.read(ROOT / "solutions" / ASSIGNMENT / NOTEBOOK, 4), starter, 0.5)


def write(place: Path, *, reads: bool = False) -> None:
    """Hand in what is half right. reads: and tries to read everything of the container's."""
    notebook = corpus.with_trick(half_right(), READS) if reads else copy.deepcopy(half_right())
    nbformat.write(notebook, place / NOTEBOOK)


def test_gradescope_sets_up_and_judges(root):
    found, printed, _ = judge_on_gradescope(root, lambda place: write(place, reads=True))
    assert found is not None, printed
    assert (found["score"], found["extra_data"]["verdict"]) == (8.0, "marked")
    assert found["extra_data"]["isolation"] in ISOLATIONS[1:]  # Docker allows no namespaces
    assert "Isolation: separate user" in printed
    assert SECRET not in json.dumps(found) + printed


@pytest.fixture(scope="module")
def prairielearn(course, root) -> Path:
    """The root file system with PrairieLearn's image as the Dockerfile makes it."""
    source = root / "autograder" / "source"
    containers.put_bundle(bundle(course, "prairielearn", "--exercise", "greeting"), source)
    done = containers.run(root, "sh", "/autograder/source/install.sh", HOME="/root")
    assert done.returncode == 0, done.stdout + done.stderr
    return root


def grade_on_prairielearn(root: Path, *, hand_in: bool = True) -> tuple[dict, str]:
    containers.lay_out(root / "grade", "student", "data")
    (root / "grade" / "data" / "data.json").write_text(json.dumps({"variant_seed": "4711", "options": {}}))
    if hand_in:
        write(root / "grade" / "student")
    done = containers.run(root, "/autograder/source/entrypoint.sh", HOME="/root")
    assert done.returncode == 0, done.stdout + done.stderr
    found = json.loads((root / "grade" / "results" / "results.json").read_text())
    jsonschema.validate(found, PRAIRIELEARN)
    return found, done.stdout + done.stderr


def test_prairielearn_grades_without_a_network(prairielearn):
    found, printed = grade_on_prairielearn(prairielearn)
    assert (found["gradable"], found["score"]) == (True, 1.0)
    assert {test["points"] == test["max_points"] for test in found["tests"]} == {True}
    assert SECRET not in json.dumps(found) + printed


def test_prairielearn_gets_no_points_for_an_upload_without_a_notebook(prairielearn):
    found, _ = grade_on_prairielearn(prairielearn, hand_in=False)
    assert found == {"gradable": False, "format_errors": [MISSING]}


@pytest.mark.parametrize("contained", [True, False], ids=["as root in a container", "by sudo on a machine"])
def test_classroom50_judges_a_checkout(course, root, contained):
    place = root / "home" / "runner"
    place.mkdir(exist_ok=True)
    containers.put_bundle(bundle(course, "classroom50", "--exercise", "greeting"), place / "bundle")
    containers.lay_out(place, "checkout")
    write(place / "checkout")
    runner = [] if contained else ["setpriv", "--reuid=1001", "--regid=1001", "--clear-groups"]
    if not contained:
        containers.run(root, "/usr/sbin/useradd", "--uid", "1001", "runner")
        (root / "etc" / "sudoers.d" / "runner").write_text("runner ALL=(ALL) NOPASSWD: ALL\n")
        for path in (place, place / "checkout", place / "checkout" / NOTEBOOK):
            os.chown(path, 1001, 1001)
    command = [*runner, "env", "-C", "/home/runner/checkout", "python3", "/home/runner/bundle/autograder.py"]
    variables = RUNNER | {"ASSIGNMENT_TYPE": "individual", "CLASSROOM50_BUNDLE_DIR": "/home/runner/bundle"}
    done = containers.run(root, *command, contained=contained, **variables)
    assert done.returncode == 0, done.stdout + done.stderr
    path = place / "checkout" / "result.json"
    found = json.loads(path.read_text())
    jsonschema.validate(found, CLASSROOM50)
    assert (found["score"], found["max-score"], found["owner"]) == (16, 16, "ann")
    assert [test["test-name"] for test in found["tests"]] == ["greeting"]
    assert "isolation: " in done.stdout
    for written in (path, path.with_name("release-body.md")):
        assert written.stat().st_uid == (0 if contained else 1001)  # the runner completes them
