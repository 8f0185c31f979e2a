"""Computes a digest of a build's inputs, so that nothing is built or installed twice."""

import hashlib
from collections.abc import Iterable
from pathlib import Path

from build_tools.toolchain import ros_prefix

ROOT = Path(__file__).resolve().parent.parent
INPUTS = ("setup.py", "pyproject.toml", "build_tools/*", "definitions/*/*/*", "sensor_msgs_py/*")


def interfaces_digest() -> str:
    """Return the digest of the interface packages' sources and of the ROS wheels.

    Raises:
        BuildError: the ROS wheels are not installed.
    """
    wheels = ros_prefix().glob("lib/python3*/site-packages/ros_*.dist-info")
    return source_digest(ROOT, INPUTS, "\n".join(sorted(wheel.name for wheel in wheels)))


def source_digest(folder: Path, patterns: Iterable[str], also: str = "") -> str:
    """Return a digest of the folder's files that match, with their names, and of a text: 12 characters."""
    digest = hashlib.sha256()
    for file in sorted(file for pattern in patterns for file in folder.glob(pattern) if file.is_file()):
        content = file.read_bytes()
        digest.update(f"{file.relative_to(folder)} {len(content)}\n".encode() + content)
    return hashlib.sha256(digest.digest() + also.encode()).hexdigest()[:12]
