"""A release is made of one version number, twice with the same bytes."""

import hashlib
import zipfile
from pathlib import Path

import pytest

from grader.marking.errors import CommandFailed
from grader.marking.release import handout, make_release
from grader.marking.release.make_release import changes, main, version
from tests.marking.release.test_service_notebooks import publish
from tests.tooling.test_docs import ROOT

WHEELS = (
    "ros2_course_interfaces-0.1.0-1a-cp311",
    "ros2_course_lidar-0.1.0-1b-cp311",
    "ros2_notebook_course-0.1.0-py3",
)
FILES = ["NOTES.md", "SHA256SUMS", "ros2-course.zip", *(f"{name}-any.whl" for name in WHEELS)]


@pytest.fixture
def course(tmp_path, monkeypatch) -> Path:
    """A folder with versions, changes and wheels, and a handout of two files."""
    for name in ("pyproject.toml", "ros_packages/interfaces/pyproject.toml", "sim/world/rays/pyproject.toml"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text((ROOT / name).read_text())
    (tmp_path / ".ci").mkdir()
    (tmp_path / ".ci" / "CHANGELOG.md").write_text(
        "# Changes\n\n## 0.1.0\n\n- A robot.\n\n## 0.0.9\n\n- None.\n"
    )
    (tmp_path / "wheels").mkdir()
    for name in (*WHEELS, "numpy-2-py3"):
        (tmp_path / "wheels" / f"{name}-any.whl").write_text(name)
    (tmp_path / "course" / "00_robot").mkdir(parents=True)
    (tmp_path / "course" / "00_robot" / "goal.py").write_text("goal = 1\n")
    monkeypatch.setattr(make_release, "differences", lambda course: [])
    monkeypatch.setattr(handout, "contents", lambda course: {"LICENSE": b"free\n", "sim/a.py": b""})
    monkeypatch.chdir(tmp_path)
    return tmp_path


def released(course: Path) -> dict[str, bytes]:
    assert main(["--tag", "v0.1.0"]) == 0
    return {path.name: path.read_bytes() for path in (course / "dist" / "release").iterdir()}


def test_a_release_has_wheels_handout_checksums_and_notes_and_is_the_same_the_second_time(course, capsys):
    publish(course, "")
    first = released(course)
    assert sorted(first) == sorted(FILES)
    assert "there are no notebooks for services such as Colab." in capsys.readouterr().out
    sums = dict(reversed(line.split("  ")) for line in first["SHA256SUMS"].decode().splitlines())
    assert sums == {
        name: hashlib.sha256(first[name]).hexdigest()
        for name in FILES
        if name not in ("NOTES.md", "SHA256SUMS")
    }
    notes = first["NOTES.md"].decode()
    assert notes.startswith("- A robot.\n\n## Installation") and f"./{WHEELS[0]}-any.whl ./" in notes
    assert released(course) == first


def test_with_an_address_there_are_notebooks_that_install_from_it(course):
    publish(course, "https://github.com/someone/ros2")
    files = released(course)
    wheel = f"https://github.com/someone/ros2/releases/download/v0.1.0/{WHEELS[2]}-any.whl"
    assert wheel in files["NOTES.md"].decode()
    with zipfile.ZipFile(course / "dist" / "release" / "ros2-course-notebooks.zip") as archive:
        assert archive.namelist() == ["ros2-course/course/00_robot/goal.py"]
    assert (course / "dist" / "notebooks" / "course" / "00_robot" / "goal.py").read_text() == "goal = 1\n"
    publish(course, "")
    assert (
        "ros2-course-notebooks.zip" not in released(course) and not (course / "dist" / "notebooks").exists()
    )


def test_a_site_that_was_built_is_part_of_it(course):
    (course / "site" / "lessons").mkdir(parents=True)
    (course / "site" / "lessons" / "index.html").write_text("<p>")
    assert main(["--site", "site"]) == 0
    with zipfile.ZipFile(course / "dist" / "release" / "ros2-course-site.zip") as archive:
        assert archive.namelist() == ["ros2-course/lessons/index.html"]


@pytest.mark.parametrize(
    ("prepare", "message"),
    [
        (
            lambda course: publish(course, "https://gitlab.com/a/b"),
            "`release` in pyproject.toml is not a repository on GitHub, such as "
            "https://github.com/OWNER/NAME: https://gitlab.com/a/b\n",
        ),
        (
            lambda course: (course / ".ci" / "CHANGELOG.md").write_text("# Changes\n"),
            ".ci/CHANGELOG.md says nothing about 0.1.0: add a section `## 0.1.0`.\n",
        ),
        (
            lambda course: next((course / "wheels").glob("ros2_course_lidar*")).unlink(),
            "wheels/ does not have the three wheels of the course: run `make release`.\n",
        ),
    ],
    ids=["address", "changes", "wheels"],
)
def test_what_a_release_lacks_is_named(course, capsys, prepare, message):
    prepare(course)
    assert main([]) == 1
    assert capsys.readouterr().err == message


def test_a_tag_with_another_number_is_refused(course, capsys):
    assert main(["--tag", "v0.2.0"]) == 1
    assert (
        capsys.readouterr().err == "The tag is v0.2.0, and pyproject.toml has version 0.1.0: tag it v0.1.0.\n"
    )


def test_what_is_compiled_has_the_same_version(course):
    lidar = course / "sim/world/rays/pyproject.toml"
    lidar.write_text(lidar.read_text().replace('version = "0.1.0"', 'version = "0.0.9"'))
    with pytest.raises(CommandFailed) as error:
        version(course)
    assert str(error.value) == (
        "The course is 0.1.0, and ros2-course-lidar is 0.0.9: set the version and the dependency in "
        "pyproject.toml and the version in sim/world/rays/pyproject.toml to the same number."
    )


def test_the_course_has_one_version_and_its_changes_are_described():
    assert changes(ROOT, version(ROOT))
