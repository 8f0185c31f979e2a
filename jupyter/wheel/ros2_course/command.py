"""The command ros2-course: an installed course in a folder of one's own.

    ros2-course lab [FOLDER]      copy or update the notebooks and open them in JupyterLab
    ros2-course copy [FOLDER]     copy or update them, for another front end
    ros2-course check             say what this machine lacks

FOLDER is ~/ros2-course by default. Nothing that you changed is overwritten.
"""

import argparse
import importlib.util
import os
import platform
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from shutil import which

HERE = Path(__file__).parent
FILES = HERE if (HERE / "course").is_dir() else HERE.parents[2]  # of a wheel, or of a clone
PACKAGE = "ros2-notebook-course"
FOLDER = "ros2-course"
NO_LAB = (
    "`ros2-course lab` needs JupyterLab, which is not installed: run `pip install '{package}[lab]'`, or "
    "`ros2-course copy {folder}`, and open the notebooks in the front end that you have."
)
# As `make lab` sets them: equal runs need equal dictionary orders and equal sums on every machine.
EQUAL_RUNS = {"PYTHONHASHSEED": "0", "OPENBLAS_NUM_THREADS": "1"}
# A module or a program, what is missing without it, and what to do.
MODULES = (
    ("jupyterlab", "the robot beside the code, Validate and the start page", "pip install '{package}[lab]'"),
    ("colcon_core", "building packages in lesson 11", "pip install '{package}[lab]'"),
)
PROGRAMS = (
    ("g++", "packages with messages of your own, in lesson 11", "apt install build-essential python3-dev"),
    ("bwrap", "the league, which runs several versions of your robot", "apt install bubblewrap"),
)


def main(arguments: list[str] | None = None) -> int:
    """Run the command line; returns the exit status."""
    options = _options(arguments)
    reasons = list(_obstacles())
    for reason in reasons:
        print(reason, file=sys.stderr)
    return 1 if reasons else int(options.function(options))


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser("ros2-course", description="The ROS 2 course in a folder of your own.")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    about = {"lab": (lab, "open the course in JupyterLab"), "copy": (copy, "copy or update the notebooks")}
    for name, (function, help_text) in about.items():
        command = commands.add_parser(name, help=help_text)
        command.add_argument("folder", nargs="?", type=Path, default=Path.home() / FOLDER)
        command.set_defaults(function=function)
    commands.add_parser("check", help="say what this machine lacks").set_defaults(function=check)
    return parser.parse_args(arguments)


def lab(options: argparse.Namespace) -> int:
    """Open the course in JupyterLab, which updates the notebooks first; returns only on an error."""
    from grader.course_files.work_folder import CHOSEN  # imported here because without rclpy it can't be

    if not _has("jupyterlab"):
        print(NO_LAB.format(package=PACKAGE, folder=options.folder), file=sys.stderr)
        return 1
    if _has("colcon_core"):  # colcon and terminals need a ROS prefix, as /opt/ros/jazzy is one
        subprocess.run([sys.executable, FILES / "ros_packages" / "cmake" / "prefix.py"], check=True)
    folders = {"JUPYTER_CONFIG_PATH": str(FILES / "jupyter"), CHOSEN: str(options.folder.absolute())}
    os.execve(sys.executable, [sys.executable, "-m", "jupyterlab"], {**os.environ, **EQUAL_RUNS, **folders})


def enter(folder: str) -> None:
    """Make a folder of the course, such as course/01_nodes, the working folder of a running kernel.

    A notebook service opens a notebook without the files beside it, so they are copied to ros2-course/ first.
    Does nothing where the notebook is in that folder, and in a clone, where such a notebook may be marked.
    """
    here = Path.cwd()
    if here.parts[-2:] == Path(folder).parts or FILES != HERE:
        return
    _copy_to(here / FOLDER)
    os.chdir(here / FOLDER / folder)
    if "" not in sys.path:  # which stands for the working folder
        sys.path.insert(0, "")


def copy(options: argparse.Namespace) -> int:
    """Copy or update the notebooks."""
    _copy_to(options.folder)
    print(f"The notebooks are in {options.folder}: start with course/00_robot/lesson.ipynb.")
    return 0


def _copy_to(folder: Path) -> None:
    from grader.course_files.work_folder import CHOSEN, update_work_folder

    os.environ[CHOSEN] = str(folder.absolute())
    for sentence in update_work_folder(FILES):
        print(sentence)


def check(options: argparse.Namespace) -> int:
    """Print what is missing here of what some notebooks use."""
    print("\n".join(_absent()) or "Nothing is missing.")
    return 0


def _obstacles() -> Iterator[str]:
    """Why no robot can drive here."""
    system = f"{platform.system()} {platform.machine()}"
    if not _has("rclpy") and system != "Linux x86_64":
        yield (
            f"rclpy is published for Linux x86_64 only, and this machine is {system}: "
            "use WSL 2 on Windows, or the container of the course."
        )
    for name in ("rclpy", "lidar_rays", "example_interfaces"):
        if not _has(name) and system == "Linux x86_64":
            repair = f"pip install --force-reinstall {PACKAGE}"
            yield f"{name} is missing, without which nothing runs: run `{repair}`."


def _absent() -> Iterator[str]:
    """What this machine lacks of what some notebooks use."""
    missing = [row for row in MODULES if not _has(row[0])] + [row for row in PROGRAMS if not which(row[0])]
    for name, use, command in missing:
        yield f"{name} is missing, for {use}: run `{command.format(package=PACKAGE)}`."


def _has(module: str) -> bool:
    return importlib.util.find_spec(module) is not None
