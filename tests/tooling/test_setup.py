import os
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.patience import PATIENCE

ROOT = Path(__file__).parents[2]
SUPPORTED = ("3.11", "3.12", "3.13", "3.14")
RUNS = """#!/bin/sh
case "$*" in *ensurepip*) exit {venv};; *Python.h*) exit {headers};; esac
echo {version}
exit {unsupported}
"""


class Machine:
    """A machine that has only the commands a test gives it."""

    def __init__(self, folder: Path):
        self.folder = folder
        self.has("uname", "#!/bin/sh\necho Linux x86_64\n")
        self.has("id", "#!/bin/sh\necho 1000\n")

    def has(self, command: str, text: str = "#!/bin/sh\n") -> None:
        file = self.folder / command
        file.write_text(text)
        file.chmod(0o755)

    def has_python(self, command: str, version: str, venv: bool = True, headers: bool = True) -> None:
        lacks = {"venv": not venv, "headers": not headers, "unsupported": version not in SUPPORTED}
        self.has(command, RUNS.format(version=version, **{name: int(lack) for name, lack in lacks.items()}))

    def set_up(self, **variables: str) -> subprocess.CompletedProcess:
        environment = {"PATH": str(self.folder), "WHEELS": str(self.folder / "wheels"), **variables}
        script = [shutil.which("sh"), ROOT / ".ci" / "setup", self.folder / "venv"]
        return subprocess.run(
            script, cwd=ROOT, env=environment, text=True, capture_output=True, timeout=PATIENCE
        )

    def has_wheels(self, pythons: str) -> None:
        """A folder as `make wheels ARGS=--offline` makes it, for these versions of Python."""
        self.has_compiled_wheels()
        (self.folder / "wheels" / "requirements.lock").touch()
        (self.folder / "wheels" / "PYTHONS").write_text(f"{pythons}\n")
        (self.folder / "cat").symlink_to(shutil.which("cat"))

    def has_compiled_wheels(self) -> None:
        """A folder as `make wheels` makes it."""
        (self.folder / "wheels").mkdir()
        (self.folder / "wheels" / "ros2_course_lidar-0.1.0-1a-cp311-abi3-manylinux1_x86_64.whl").touch()

    def complaint(self, **variables: str) -> str:
        done = self.set_up(**variables)
        assert done.returncode == 1
        assert not (self.folder / "venv").exists()
        return done.stderr


@pytest.fixture
def machine(tmp_path: Path) -> Machine:
    return Machine(tmp_path)


def test_another_kind_of_machine_learns_what_to_use(machine):
    machine.has("uname", "#!/bin/sh\necho Darwin arm64\n")
    assert machine.complaint() == (
        "ROS publishes its Python packages for Linux x86_64 only and this machine is Darwin arm64: "
        "use the container in .devcontainer, a Linux x86_64 machine, a virtual one or WSL 2.\n"
    )


def test_an_arm_machine_without_ross_own_packages_learns_where_they_are(machine):
    machine.has("uname", "#!/bin/sh\necho Linux aarch64\n")
    assert machine.complaint(ROS_PREFIX=str(machine.folder)) == (
        "ROS publishes its Python packages for Linux x86_64 only, this machine is Linux aarch64, "
        f"and {machine.folder} has no rclpy: use the container in .devcontainer, which has it.\n"
    )


def test_an_arm_machine_with_them_needs_the_python_that_they_are_for(machine):
    machine.has("uname", "#!/bin/sh\necho Linux aarch64\n")
    (machine.folder / "lib/python3.12/site-packages/rclpy").mkdir(parents=True)
    machine.has_python("python3", "3.13")
    assert machine.complaint(ROS_PREFIX=str(machine.folder)) == (
        f"The packages in {machine.folder} are for Python 3.12, and python3 is 3.13: "
        "name one with `make PYTHON=/path/to/python3.12`.\n"
    )


def test_an_unknown_distribution_is_named(machine):
    assert machine.complaint(DISTRO="humble") == (
        "DISTRO=humble is not a ROS distribution that the course runs on: "
        "say kilted, or leave DISTRO out for Jazzy.\n"
    )


def test_wheels_of_another_python_are_named(machine):
    machine.has_wheels("3.11 3.13")
    machine.has_python("python3", "3.12")
    assert machine.complaint() == (
        f"The packages in {machine.folder}/wheels are for Python 3.11 3.13, and python3 is 3.12: "
        "name one with `make PYTHON=/path/to/python3.11`.\n"
    )


@pytest.mark.parametrize("offline", [True, False])
def test_with_wheels_no_compiler_is_asked_for(machine, offline):
    machine.has_wheels("3.11 3.12") if offline else machine.has_compiled_wheels()
    machine.has_python("python3.12", "3.12", venv=False, headers=False)
    assert machine.complaint().startswith("python3.12 cannot make virtual environments")


def test_without_a_supported_python_it_says_which_to_install(machine):
    machine.has_python("python3", "3.10")
    assert machine.complaint() == (
        "No Python 3.11 to 3.14 runs here: install one, or name one with `make PYTHON=/path/to/python3.12`.\n"
    )


def test_a_named_python_that_does_not_run_is_named(machine):
    machine.has_python("python3", "3.12")
    assert machine.complaint(PYTHON="/nowhere/python") == (
        "PYTHON=/nowhere/python is not a Python 3.11 to 3.14 that runs: "
        "name another one, or leave PYTHON out.\n"
    )


def test_a_python_that_exists_but_does_not_run_is_passed_over(machine):
    machine.has("python3.12", "#!/bin/sh\necho 'python3.12: command not found' >&2\nexit 127\n")
    machine.has_python("python3.13", "3.13", venv=False)
    assert machine.complaint() == (
        "python3.13 cannot make virtual environments: "
        "install its venv module with `sudo apt install python3.13-venv`.\n"
    )


def test_root_does_not_need_sudo(machine):
    machine.has("id", "#!/bin/sh\necho 0\n")
    machine.has_python("python3", "3.11", venv=False)
    assert machine.complaint().endswith("with `apt install python3.11-venv`.\n")


def test_a_missing_compiler_is_named_before_anything_is_installed(machine):
    machine.has_python("python3.12", "3.12")
    machine.has("gcc")
    assert machine.complaint() == (
        "No g++, and the ROS interfaces of the course are compiled here: install it with "
        f"`sudo apt install build-essential`, or put a release's wheels in {machine.folder}/wheels/.\n"
    )


def test_a_python_without_its_headers_learns_which_package_has_them(machine):
    machine.has_python("python3.12", "3.12", headers=False)
    machine.has("gcc")
    machine.has("g++")
    assert machine.complaint() == (
        "python3.12 has no Python.h, with which the lidar of the course is compiled: "
        "install it with `sudo apt install python3.12-dev`.\n"
    )


def test_what_was_set_up_from_these_very_files_needs_nothing_and_is_left_alone(machine):
    """As in a container, which has no compilers any more, and whose files may look new."""
    files = ["requirements.lock", "pyproject.toml", ".ci/setup", "sim/absent_packages.toml"]
    for pattern in ("cmake/*.*", "cmake/*/*", "interfaces/definitions/*/*/*"):
        files += sorted(str(path.relative_to(ROOT)) for path in ROOT.glob(f"ros_packages/{pattern}"))
    content = b"".join((ROOT / name).read_bytes() for name in files)
    sum_of_all = subprocess.check_output(["cksum"], input=content, text=False).decode()
    for command in ("cat", "cksum"):
        (machine.folder / command).symlink_to(shutil.which(command))
    (machine.folder / "venv").mkdir()
    (machine.folder / "venv" / ".requirements").write_text(sum_of_all)
    done = machine.set_up()
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    (machine.folder / "venv" / ".requirements").write_text("another sum\n")
    assert machine.set_up().returncode == 1


def test_a_second_set_up_has_nothing_to_do(tmp_path):
    environment = {**os.environ, "MAKEFLAGS": "", "LC_ALL": "C"}
    for stamp in (".requirements", ".interfaces"):
        (tmp_path / stamp).touch()
    make = ["make", f"VENV={tmp_path}", "setup"]
    done = subprocess.run(make, cwd=ROOT, env=environment, capture_output=True, text=True, timeout=PATIENCE)
    assert (done.returncode, done.stderr) == (0, "")
    assert "Nothing to be done for 'setup'.\n" in done.stdout
    assert sorted(path.name for path in tmp_path.iterdir()) == [".interfaces", ".requirements"]


def test_make_alone_lists_the_targets():
    done = subprocess.run(["make"], cwd=ROOT, check=True, capture_output=True, text=True, timeout=PATIENCE)
    targets = {line.split()[0] for line in done.stdout.splitlines()}
    assert {"lab", "test", "solutions", "demo", "exercises", "handout", "wheels", "lint", "clean"} <= targets
