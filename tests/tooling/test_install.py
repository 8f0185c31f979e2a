"""install.py is silent when there is nothing to do and clear when it cannot go on."""

import os
import platform
import shutil
import signal
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from tests.patience import PATIENCE

INTERFACES = Path(__file__).parents[2] / "ros_packages" / "interfaces"
sys.path.append(str(INTERFACES))
import install  # noqa: E402


@pytest.fixture
def changed(tmp_path) -> Path:
    """A copy of interfaces/ with one more package, so that its content is not installed and not cached."""
    copy = tmp_path / "ros_packages" / "interfaces"
    shutil.copytree(INTERFACES, copy, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copytree(install.LIDAR_FOLDER, tmp_path / "sim/world/rays")
    message = copy / "definitions" / "a_msgs" / "msg" / "Broken.msg"
    message.parent.mkdir(parents=True)
    message.write_text("int32 two names\n", encoding="utf-8")
    return copy


def run(script: Path, *python: str, **variables: str) -> subprocess.CompletedProcess:
    command = [sys.executable, *python, str(script / "install.py")]
    environment = {**os.environ, **variables}
    return subprocess.run(command, env=environment, capture_output=True, text=True, timeout=PATIENCE)


def files(directory: Path) -> set[Path]:
    return {path for path in directory.rglob("*") if "__pycache__" not in path.parts}


@pytest.mark.parametrize("package", install.COMPILED, ids=lambda package: package.name)
def test_the_content_at_hand_is_what_is_installed(package):
    assert package.installed() == package.build_number()


def test_two_builds_in_different_folders_have_the_same_bytes(tmp_path, monkeypatch):
    built = []
    for name in "first", "second":
        monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / name))
        built.append(install.LIDAR.build().read_bytes())
    assert built[0] == built[1]


def test_a_second_call_is_silent_and_leaves_no_file_behind():
    before = files(INTERFACES)
    done = run(INTERFACES)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    assert files(INTERFACES) == before


def test_a_second_call_loads_nothing_that_a_build_or_an_installation_needs():
    """Every `make` begins with it, so it is to be quick."""
    program = "import sys, install; install.main(); print(*{name.split('.')[0] for name in sys.modules})"
    words = [sys.executable, "-c", program]
    loaded = subprocess.check_output(words, cwd=INTERFACES, text=True, timeout=PATIENCE).split()
    assert "install" in loaded
    assert {"setuptools", "pip", "numpy", "em", "rclpy", "rosidl_adapter", "rosidl_parser"}.isdisjoint(loaded)


def test_a_change_of_any_source_gives_another_build_number(changed):
    program = "import install; print(*(package.build_number() for package in install.COMPILED))"
    words = [sys.executable, "-c", program]
    other = subprocess.check_output(words, cwd=changed, text=True, timeout=PATIENCE).split()
    here = [package.build_number() for package in install.COMPILED]
    assert [a == b for a, b in zip(here, other, strict=True)] == [False, True]


def test_without_a_compiler_it_stops_with_one_sentence(changed, tmp_path):
    done = run(changed, PATH=str(tmp_path), XDG_CACHE_HOME=str(tmp_path / "cache"))
    sudo = "sudo " if os.geteuid() else ""
    assert done.returncode == 1
    assert done.stderr == (
        "Building the ROS interfaces needs gcc, g++ and Python.h, but gcc and g++ are missing: "
        f"run `{sudo}apt install build-essential python3-dev` and try again.\n"
    )


def test_without_the_ros_wheels_it_stops_with_one_sentence():
    done = run(INTERFACES, "-S")
    assert done.returncode == 1
    assert done.stderr == (
        "Building the ROS interfaces needs the ROS wheels, but rosidl_generator_c is missing: "
        "run `pip install 'ros-jazzy-rclpy[fastrtps]' ros-jazzy-common-interfaces` and try again.\n"
    )


def test_a_definition_with_an_error_stops_the_build_and_the_reason_is_shown(changed, tmp_path):
    before = files(changed)
    done = run(changed, XDG_CACHE_HOME=str(tmp_path / "cache"))
    assert done.returncode == 1
    assert "Broken.msg" in done.stderr
    assert "The interface package a_msgs could not be built; the reason is above.\n" in done.stderr
    assert done.stderr.endswith("\nThe ROS interfaces could not be built; the reason is above.\n")
    assert files(changed) == before
    assert not (tmp_path / "cache").exists()


def test_without_an_installed_wheel_there_is_no_build_number():
    assert replace(install.LIDAR, name="ros2-course-that-nothing-installed").installed() is None


def test_a_ready_wheel_is_that_of_the_current_content_and_of_this_machine(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setenv("WHEELS", str(tmp_path))
    number = install.LIDAR.build_number()
    for build, machine in ((number, "sparc"), ("1aaaaaaaaaaaa", "x86_64")):
        (tmp_path / f"ros2_course_lidar-0.1.0-{build}-cp311-abi3-manylinux1_{machine}.whl").touch()
    assert install.LIDAR.ready_wheel() is None
    ready = tmp_path / f"ros2_course_lidar-0.1.0-{number}-cp311-abi3-manylinux1_{platform.machine()}.whl"
    ready.touch()
    assert install.LIDAR.ready_wheel() == ready


def test_a_build_prints_the_current_package_and_returns_its_exit_status(tmp_path, capsys):
    for name in ("a_msgs", "b_msgs", "c_msgs"):
        (tmp_path / "definitions" / name).mkdir(parents=True)
    program = (
        "import pathlib, sys, time\n"
        "for name in ('b_msgs', 'a_msgs'):\n"
        "    pathlib.Path('build/temp.x/objects', name).mkdir(parents=True)\n"
        "    while pathlib.Path('go') not in pathlib.Path().iterdir(): time.sleep(0.05)\n"
        "    pathlib.Path('go').unlink()\n"
        "sys.exit(3)\n"
    )
    process = subprocess.Popen([sys.executable, "-c", program], cwd=tmp_path)
    output, wait = "", process.wait

    def continue_when_printed(timeout):
        nonlocal output
        output += capsys.readouterr().out
        if output.count("\n") > continue_when_printed.times:
            continue_when_printed.times += 1
            (tmp_path / "go").touch()
        return wait(timeout)

    continue_when_printed.times = 0
    process.wait = continue_when_printed
    assert install.print_progress(process, tmp_path) == 3
    assert output == "  1 of 3: b_msgs\n  2 of 3: a_msgs\n"


def test_a_packages_folder_of_launch_files_hides_nothing(tmp_path):
    """Of a workspace that is sourced, such a folder may be on the path before all else."""
    (tmp_path / "launch").mkdir()
    program = [sys.executable, "-c", "import launch; print(launch.__file__)"]
    output = subprocess.check_output(program, env={**os.environ, "PYTHONPATH": str(tmp_path)}, text=True)
    assert output.strip() == str(Path(install.ROOT.parent, "python", "launch", "__init__.py"))


def test_ctrl_c_stops_the_build_with_one_sentence(changed, tmp_path):
    (changed / "definitions" / "a_msgs" / "msg" / "Broken.msg").write_text("int32 whole\n", encoding="utf-8")
    words = [sys.executable, "-u", str(changed / "install.py")]
    with subprocess.Popen(
        words, env={**os.environ, "XDG_CACHE_HOME": str(tmp_path / "cache")}, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    ) as terminal:  # fmt: skip
        assert [terminal.stdout.readline() for _ in range(2)][1] == "  1 of 10: a_msgs\n"
        os.killpg(terminal.pid, signal.SIGINT)
        output = terminal.communicate(timeout=PATIENCE)[1]
    assert output == "Stopped: what is compiled is built when the same command is run again.\n"
    assert terminal.returncode == 1
    assert not (tmp_path / "cache").exists()
