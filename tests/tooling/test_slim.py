"""What the set-up takes out of an environment, and what it leaves."""

import os
from pathlib import Path

import pytest

from tests.tooling.test_ci import load

slim = load("slim")
PACKAGES = "lib/python3.12/site-packages"


@pytest.fixture
def environment(tmp_path) -> Path:
    for name, content in {
        "lib/libdds.so": b"d" * 60_000,
        "lib/libdds.so.2": b"d" * 60_000,
        "lib/libother.so": b"o" * 60_000,
        "lib/small": b"s",
        "lib/small.2": b"s",
        f"{PACKAGES}/a.libs/libc.so": b"c" * 60_000,
        f"{PACKAGES}/b.libs/libc.so": b"c" * 60_000,
        f"{PACKAGES}/a/__init__.py": b"",
        f"{PACKAGES}/a/tests/__init__.py": b"",
        f"{PACKAGES}/a/tests/more/tests/__init__.py": b"",
        f"{PACKAGES}/a/data/tests/page.html": b"no package of tests",
        "share/jupyter/lab.js.map": b"map",
        "share/jupyter/lab.js": b"script",
    }.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_bytes(content)
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin" / "python").symlink_to(tmp_path / "lib" / "small")
    return tmp_path


def files(environment: Path) -> list[Path]:
    return [path for path in environment.rglob("*") if path.is_file() and not path.is_symlink()]


def names(environment: Path) -> set[str]:
    return {path.relative_to(environment).as_posix() for path in files(environment)}


def test_tests_of_packages_and_maps_of_scripts_go_and_nothing_else(environment):
    before = names(environment)
    slim.remove_unused_files(environment)
    assert before - names(environment) == {
        f"{PACKAGES}/a/tests/__init__.py",
        f"{PACKAGES}/a/tests/more/tests/__init__.py",
        "share/jupyter/lab.js.map",
    }


def test_equal_files_become_one_with_all_its_names(environment):
    before = names(environment)
    slim.join_equal_files(environment)
    assert names(environment) == before
    one, other = environment / "lib/libdds.so", environment / "lib/libdds.so.2"
    assert one.stat().st_ino == other.stat().st_ino
    assert one.read_bytes() == b"d" * 60_000
    assert (environment / "lib/libother.so").stat().st_nlink == 1


def test_libraries_of_a_wheels_own_small_files_and_other_modes_stay_apart(environment):
    os.chmod(environment / "lib/libdds.so", 0o755)
    slim.join_equal_files(environment)
    for name in ("lib/libdds.so", "lib/small", f"{PACKAGES}/a.libs/libc.so"):
        assert (environment / name).stat().st_nlink == 1


def test_a_second_time_changes_nothing(environment):
    slim.join_equal_files(environment)
    before = {path: path.stat().st_ino for path in files(environment)}
    slim.join_equal_files(environment)
    assert {path: path.stat().st_ino for path in files(environment)} == before
