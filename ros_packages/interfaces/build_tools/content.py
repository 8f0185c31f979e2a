"""Computes the version of a build from its inputs, so that nothing is built or installed twice."""

import hashlib
from pathlib import Path

from build_tools.toolchain import ros_prefix

ROOT = Path(__file__).resolve().parent.parent
INPUTS = ("setup.py", "pyproject.toml", "build_tools/*", "definitions/*/*/*", "sensor_msgs_py/*")


def version() -> str:
    """Return the wheel's version; its local part is a digest of the sources and of the ROS wheels.

    Raises:
        BuildError: the ROS wheels are not installed.
    """
    digest = hashlib.sha256()
    for file in sorted(file for pattern in INPUTS for file in ROOT.glob(pattern) if file.is_file()):
        content = file.read_bytes()
        digest.update(f"{file.relative_to(ROOT)} {len(content)}\n".encode() + content)
    wheels = ros_prefix().glob("lib/python3*/site-packages/ros_*.dist-info")
    digest.update("\n".join(sorted(wheel.name for wheel in wheels)).encode())
    return f"1.0.0+{digest.hexdigest()[:12]}"
