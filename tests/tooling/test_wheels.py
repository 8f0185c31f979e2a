"""`make wheels` writes what pip and the set-up read."""

import hashlib
import sys
from pathlib import Path

import pytest

from tests.tooling.test_ci import load

wheels = load("wheels")
HERE = "{}.{}".format(*sys.version_info)
OTHER = "3.13" if HERE != "3.13" else "3.12"
COURSE_WHEELS = ("ros2_course_interfaces-0.1.0-1f28cb-cp311", "ros2_notebook_course-0.1.0-py3")


@pytest.fixture
def made(tmp_path, monkeypatch):
    """Makes wheels/ where an older one is, with these options; downloads nothing."""

    def write(folder: Path, *names: str) -> None:
        for name in names:
            (folder / f"{name}-any.whl").write_bytes(name.encode())

    def collect(folder: Path, found: dict[str, str]) -> None:
        write(folder, "ros_std_msgs-5.3.6-cp312", "uv-0.13.8-py3")
        write(folder, *(f"numpy-2.4.6-cp{version.replace('.', '')}" for version in found))

    def make(*options: str) -> Path:
        wheels.main(options)
        return tmp_path / "wheels"

    monkeypatch.chdir(tmp_path)
    (tmp_path / "wheels").mkdir()
    write(tmp_path / "wheels", "old-1.0-py3-none")
    monkeypatch.setattr(wheels, "build", lambda folder: write(folder, *COURSE_WHEELS))
    monkeypatch.setattr(wheels, "collect", collect)
    monkeypatch.setattr(wheels, "pythons", lambda: {HERE: sys.executable, OTHER: "/elsewhere/python"})
    return make


def test_the_courses_own_wheels_take_the_place_of_the_old_ones(made, capsys):
    folder = made()
    assert sorted(path.name for path in folder.iterdir()) == [f"{name}-any.whl" for name in COURSE_WHEELS]
    assert [path.name for path in folder.parent.iterdir()] == ["wheels"]
    assert capsys.readouterr().out == "wheels/: 2 packages, 0.0 MB\n"


def test_offline_names_every_other_package_with_its_hashes_but_uv_which_goes_again(made):
    numpy = [f"numpy-2.4.6-cp{version.replace('.', '')}" for version in sorted({HERE, OTHER})]
    digests = [hashlib.sha256(name.encode()).hexdigest() for name in (*numpy, "ros_std_msgs-5.3.6-cp312")]
    folder = made("--offline")
    assert (folder / "requirements.lock").read_text().splitlines() == [
        f"numpy==2.4.6 --hash=sha256:{digests[0]} --hash=sha256:{digests[1]}",
        f"ros-std-msgs==5.3.6 --hash=sha256:{digests[2]}",
    ]
    assert len(list(folder.glob("uv-*.whl"))) == 1


def test_offline_says_for_which_pythons_it_is(made, capsys):
    assert (made("--offline") / "PYTHONS").read_text() == f"{HERE} {OTHER}\n"
    expected = f"wheels/: 6 packages, 0.0 MB, for a set-up without network on Python {HERE}, {OTHER}\n"
    assert capsys.readouterr().out == expected


def test_the_pythons_of_this_machine_are_the_supported_ones_and_this_one_first():
    found = wheels.pythons()
    assert next(iter(found.items())) == (HERE, sys.executable)
    assert set(found) <= {"3.11", "3.12", "3.13", "3.14"}
