"""The requirements of a build: compilers, Python's headers and the ROS wheels."""

import importlib.util
import os
import shutil
import sysconfig
from pathlib import Path

GENERATOR = "rosidl_generator_c"


class BuildError(RuntimeError):
    """A build can't continue; the message says what to do."""


def require_compilers(about: str = "the ROS interfaces") -> None:
    """Raise BuildError unless gcc, g++ and Python.h are installed, with which `about` is built."""
    header = Path(sysconfig.get_path("include"), "Python.h")
    missing = [tool for tool in ("gcc", "g++") if not shutil.which(tool)]
    missing += [] if header.is_file() else ["Python.h"]
    if missing:
        # A container's root user usually has no sudo.
        sudo = "sudo " if os.geteuid() else ""
        raise BuildError(
            f"Building {about} needs gcc, g++ and Python.h, but {' and '.join(missing)} "
            f"{'is' if len(missing) == 1 else 'are'} missing: "
            f"run `{sudo}apt install build-essential python3-dev` and try again."
        )


def ros_prefix() -> Path:
    """Return the directory whose share/, include/ and lib/ contain the files of the ROS wheels.

    Raises:
        BuildError: the ROS wheels are not installed.
    """
    spec = importlib.util.find_spec(GENERATOR)
    above = Path(spec.origin).parents if spec and spec.origin else ()
    for prefix in above:
        if (prefix / "share" / GENERATOR / "resource").is_dir():
            return prefix
    raise BuildError(
        f"Building the ROS interfaces needs the ROS wheels, but {GENERATOR} is missing: "
        "run `pip install 'ros-jazzy-rclpy[fastrtps]' ros-jazzy-common-interfaces` and try again."
    )
