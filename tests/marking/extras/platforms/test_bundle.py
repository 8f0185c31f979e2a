"""What is in the autograder of a platform, and what it writes for a submission."""
import json
import os
import stat
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from grader.__main__ import main
from grader.marking.errors import CourseError
from grader.marking.extras.platforms import bundle as bundles
from grader.marking.extras.platforms import run
from grader.marking.extras.platforms.bundle import PlatformSettings, bundle
from grader.marking.extras.platforms.core_packages import needed_packages, pinned_requirements
from tests.marking.extras.platforms.test_results import METADATA
from tests.marking.tiny import ROOT

ASSIGNMENT = "02_topics"
WHEELS = ("ros2_course_interfaces-0.1.0-1ab-cp311-abi3-manylinux_2_24_x86_64.whl",
          "ros2_course_lidar-0.1.0-1ab-cp311-abi3-manylinux1_x86_64.whl")  # fmt: skip


@pytest.fixture
def course(tmp_path, monkeypatch) -> Path:
    """A course's folder with the code of this one, a secret, and wheels; the test runs there."""
    folder = tmp_path / "course"
    (folder / "wheels").mkdir(parents=True)
    names = "LICENSE requirements.lock pyproject.toml sim grader exercises ros_packages"
    for name in names.split():
        (folder / name).symlink_to(ROOT / name)
    for name in WHEELS:
        (folder / "wheels" / name).write_bytes(b"a wheel")
    (folder / ".secret").touch(mode=0o600)
    (folder / ".secret").write_text("the secret of this class\n")
    monkeypatch.chdir(folder)
    return folder


def test_the_zip_for_gradescope_has_its_two_scripts_on_top_and_keeps_their_modes(course, capsys):
    assert main(["platform", "gradescope", ASSIGNMENT, "--percent-per-day", "10"]) == 0
    path = Path("dist", f"gradescope-{ASSIGNMENT}.zip")
    assert path.stat().st_mode & 0o077 == 0
    with zipfile.ZipFile(path) as archive:
        modes = {each.filename: stat.S_IMODE(each.external_attr >> 16) for each in archive.infolist()}
        settings = json.loads(archive.read("settings.json"))
        assert archive.read(".secret") == b"the secret of this class\n"
    assert (modes["setup.sh"], modes["run_autograder"], modes[".secret"]) == (0o755, 0o755, 0o600)
    assert settings["percent_per_day"] == 10.0
    assert {f"wheels/{name}" for name in WHEELS} < set(modes)
    assert f"release/{ASSIGNMENT}/topics.ipynb" in modes
    assert "course/grader/marking/extras/one_submission/cli.py" in modes
    assert "private worlds" in capsys.readouterr().out


def test_solutions_other_assignments_tests_and_the_class_are_not_in_it(course):
    names = bundle(course, PlatformSettings(ASSIGNMENT), "")
    tops = {name.split("/")[0] for name in names}
    assert tops == {"course", "release", "wheels", "install.sh", "requirements.txt", "settings.json"}
    assert {name.split("/")[1] for name in names if name.startswith("course/")} == {
        "LICENSE", "requirements.lock", "pyproject.toml", "sim", "grader", "ros_packages"
    }  # fmt: skip
    foreign = "solutions/", "01_nodes", "__pycache__"
    assert [name for name in names if any(part in name for part in foreign)] == []
    assert ".secret" not in names


def test_the_same_course_gives_the_same_bytes(course):
    digests = set()
    for _ in range(2):
        main(["platform", "gradescope", ASSIGNMENT])
        digests.add(Path("dist", f"gradescope-{ASSIGNMENT}.zip").read_bytes())
    assert len(digests) == 1


def test_classroom50_gets_no_secret_and_less_than_ten_megabytes(course, capsys):
    assert main(["platform", "classroom50", ASSIGNMENT]) == 0
    folder = Path("dist", f"classroom50-{ASSIGNMENT}")
    files = [path for path in folder.rglob("*") if path.is_file()]
    assert os.access(folder / "autograder.py", os.X_OK)
    assert not (folder / ".secret").exists()
    assert sum(path.stat().st_size for path in files) < 10e6
    assert "public worlds" in capsys.readouterr().out


def test_prairielearn_gets_a_dockerfile_and_what_to_enter(course):
    words = ["platform", "prairielearn", ASSIGNMENT, "--exercise", "square", "--seconds", "100"]
    assert main([*words, "--public-worlds"]) == 0
    folder = Path("dist", f"prairielearn-{ASSIGNMENT}")
    info = json.loads((folder / "info.json").read_text())
    assert info["externalGradingOptions"]["timeout"] == 160
    assert json.loads((folder / "settings.json").read_text())["exercises"] == ["square"]
    assert "ENTRYPOINT" in (folder / "Dockerfile").read_text()
    assert not (folder / ".secret").exists()


def test_without_wheels_or_a_release_it_says_what_to_run(course, capsys):
    assert main(["platform", "gradescope", "77_none"]) == 1
    assert capsys.readouterr().err == (
        f"No autograder: expected an assignment in {course}/exercises/77_none, saw no notebook: "
        "run `make exercises` first.\n"
    )
    (course / "wheels" / WHEELS[0]).unlink()
    assert main(["platform", "gradescope", ASSIGNMENT]) == 1
    assert capsys.readouterr().err == (
        "No autograder: expected the wheel of ros2-course-interfaces in wheels/, saw none: "
        "run `make wheels` first.\n"
    )


def test_what_is_installed_is_pinned_and_without_the_lab():
    needed = needed_packages(ROOT)
    assert {"numpy", "pymunk", "ipython", "nbformat", "ros-rclpy", "ros-rmw-fastrtps-cpp"} < needed
    assert not {"jupyterlab", "nbgrader", "cmake", "sqlalchemy"} & needed
    lines = pinned_requirements(ROOT, everything=False)
    assert "numpy==" in lines and "--hash=sha256:" in lines
    assert "jupyterlab==" not in lines
    assert "; (python_full_version" not in lines  # Ubuntu 22.04 has 3.11.0rc1, and an old pip
    assert "jupyterlab==" in pinned_requirements(ROOT, everything=True)


def test_an_assignment_with_packages_needs_all_that_builds_them():
    for name in ("11_packages", "11b_launching", "11c_testing"):
        assert bundles._builds_packages(ROOT / "exercises" / name)
    assert not bundles._builds_packages(ROOT / "exercises" / ASSIGNMENT)


NO_NBGRADER = """
import sys
class Blocker:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in ("nbgrader", "jupyterlab", "sqlalchemy", "nbconvert"):
            raise ModuleNotFoundError(name)
sys.meta_path.insert(0, Blocker())
import grader.marking.extras.platforms.run, grader.marking.preload
"""


def test_judging_imports_nothing_of_the_lab():
    done = subprocess.run([sys.executable, "-c", NO_NBGRADER], cwd=ROOT, capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")


REPORT = {
    "points": 3.0, "max_points": 4.0, "points_after_lateness": 3.0, "late": None, "verdict": "marked",
    "reason": "", "repairs": [], "flags": [], "exercises": [], "needs_look": False, "points_by_hand": 0.0,
    "isolation": "bubblewrap", "evidence": {"release": "ab"}, "seconds": 1.0, "assignment": ASSIGNMENT,
}  # fmt: skip


@pytest.fixture
def judge(monkeypatch):
    """A `mark-one` that writes a report without judging; returns the words that it got."""
    got: list[list[str]] = []

    def mark_one(words: list[str]) -> int:
        got.append(words)
        Path(words[words.index("--out") + 1]).write_text(json.dumps(REPORT))
        return 0

    monkeypatch.setattr(run.mark_one, "main", mark_one)
    return got


def test_of_gradescope_come_name_and_times_and_there_go_the_results(course, judge, capsys):
    root = course / "autograder"
    root.mkdir(mode=0o755)
    (root / "submission_metadata.json").write_text(json.dumps(METADATA))
    settings = PlatformSettings(ASSIGNMENT, ("square",), percent_per_day=10)
    assert run.execute(run.run_gradescope(settings, root), settings) == 0
    (words,) = judge
    assert words[0] == str(root / "submission")
    named = dict(zip(words[1::2], words[2::2], strict=True))
    assert named["--student"] == "ann@example.org"
    assert named["--due"] == METADATA["assignment"]["due_date"]
    assert (named["--handed-in"], named["--secret"]) == (METADATA["created_at"], ".secret")
    assert named["--exercise"] == "square"
    assert json.loads((root / "results" / "results.json").read_text())["score"] == 3.0
    assert stat.S_IMODE(root.stat().st_mode) == 0o700
    assert capsys.readouterr().out == (
        "3 of 4 points; isolation: bubblewrap\nIsolation: bubblewrap.\nEvidence: release ab.\n"
    )


def test_prairielearn_and_classroom50_get_their_own(course, judge, monkeypatch, capsys):
    root = course / "grade"
    (root / "data").mkdir(parents=True)
    (root / "data" / "data.json").write_text('{"variant_seed": 7}')
    settings = PlatformSettings(ASSIGNMENT)
    assert run.execute(run.run_prairielearn(settings, root), settings) == 0
    assert json.loads((root / "results" / "results.json").read_text())["score"] == 0.75
    monkeypatch.setenv("USERNAME", "ann")
    assert run.execute(run.run_classroom50(settings, course), settings) == 0
    assert json.loads((course / "result.json").read_text())["score"] == 0
    assert (course / "release-body.md").read_text().startswith("### 02_topics: 3 of 4 points\n")
    assert [words[words.index("--student") + 1] for words in judge] == ["variant 7", "ann"]
    assert capsys.readouterr().out == 2 * "3 of 4 points; isolation: bubblewrap\n"  # students may read it


def test_what_was_not_judged_has_no_result(course, monkeypatch):
    root = course / "grade"
    root.mkdir()
    monkeypatch.setattr(run.mark_one, "main", lambda words: 1)
    settings = PlatformSettings(ASSIGNMENT)
    assert run.execute(run.run_prairielearn(settings, root), settings) == 1
    assert not (root / "results").exists()


def test_settings_are_read_as_they_were_written(course):
    written = PlatformSettings(ASSIGNMENT, ("square",), 90.0, "hidden", 5.0)
    for name, content in bundle(course, written, "").items():
        if name == "settings.json":
            Path(name).write_bytes(content)
    assert PlatformSettings.read(course) == written
    with pytest.raises(CourseError):
        bundle(course, PlatformSettings("nothing"), "")


AUTOGRADER = bundles.FILES / "autograder.py"


def start_autograder(folder: Path, bundle_folder: Path, **user: object) -> tuple[int, str]:
    """The exit status and what goes to stderr, in a student's checkout."""
    path = "" if user else os.environ["PATH"]
    clean = ["/usr/bin/env", "-i", f"PATH={path}", f"CLASSROOM50_BUNDLE_DIR={bundle_folder}"]
    command = [*clean, "/usr/bin/python3", "-c", AUTOGRADER.read_text(encoding="utf-8")]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False, **user)
    return done.returncode, done.stderr


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can become another user")
def test_classroom50s_autograder_without_root_says_what_it_needs(tmp_path):
    unprivileged = {"user": 65534, "group": 65534, "extra_groups": []}
    assert start_autograder(Path("/"), tmp_path, **unprivileged) == (
        1, "::error::The autograder did not judge: expected root, or sudo without a password.\n"
    )  # fmt: skip


@pytest.mark.skipif(os.geteuid() != 0, reason="as another user it needs sudo")
def test_classroom50s_autograder_says_why_it_could_not_be_installed(tmp_path):
    bundle_folder, checkout = tmp_path / "bundle", tmp_path / "checkout"
    bundle_folder.mkdir()
    checkout.mkdir()
    (bundle_folder / "install.sh").write_text("exit 7\n")
    status, wrong = start_autograder(checkout, bundle_folder)
    assert status == 1
    why = "it could not be installed here: status 7 of `sh "
    assert wrong.startswith(f"::error::The autograder did not judge: {why}")
    assert wrong.endswith("/source/install.sh /opt/ros2-course`.\n")
    assert list(checkout.iterdir()) == []
