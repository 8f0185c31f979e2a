"""`make wheels` writes what the set-up reads."""

import hashlib
import sys
from pathlib import Path

import pytest

from tests.tooling.test_ci import load

wheels = load("wheels")


@pytest.fixture
def collected(tmp_path, monkeypatch) -> Path:
    """wheels/ of three packages, in a folder where an older one lay."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "wheels").mkdir()
    (tmp_path / "wheels" / "old-1.0-py3-none-any.whl").touch()

    def collect(folder: Path) -> None:
        folder.mkdir()
        for name in ("ros_std_msgs-5.3.6-cp312", "uv-0.13.8-py3", "ros2_course_interfaces-1.0.0+f28cb-cp311"):
            (folder / f"{name}-any.whl").write_bytes(name.encode())

    monkeypatch.setattr(wheels, "collect", collect)
    wheels.main()
    return tmp_path / "wheels"


def test_the_folder_names_every_package_with_its_hash_but_uv_which_goes_again(collected):
    assert (collected / "requirements.lock").read_text().splitlines() == [
        f"{name} --hash=sha256:{hashlib.sha256(content).hexdigest()}"
        for name, content in (
            ("ros2-course-interfaces==1.0.0+f28cb", b"ros2_course_interfaces-1.0.0+f28cb-cp311"),
            ("ros-std-msgs==5.3.6", b"ros_std_msgs-5.3.6-cp312"),
        )
    ]
    assert len(list(collected.glob("uv-*.whl"))) == 1


def test_it_says_for_which_python_it_is_and_takes_the_place_of_the_old_one(collected, capsys):
    assert (collected / "PYTHON").read_text() == f"3.{sys.version_info.minor}\n"
    assert not list(collected.glob("old*"))
    assert [path.name for path in collected.parent.iterdir()] == ["wheels"]


def test_it_says_what_it_collected(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(wheels, "collect", lambda folder: folder.mkdir())
    wheels.main()
    python = f"3.{sys.version_info.minor}"
    assert capsys.readouterr().out == f"wheels/: 0 packages, 0 MB, for Python {python}\n"
