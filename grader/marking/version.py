"""The versions of the code that marks and of its libraries, on which grades may depend."""

import functools
import hashlib
import sys
from importlib import metadata

from sim.course_folders import COURSE, ROS_PACKAGES
from sim.distro import RCLPY_DISTRIBUTION

CODE = COURSE / "grader", COURSE / "sim", ROS_PACKAGES  # the last has tf2_ros and launch
LOCK = "requirements.lock"  # the file with the version of every library
LIBRARIES = (RCLPY_DISTRIBUTION, "numpy", "pymunk", "ipython", "matplotlib")


@functools.cache
def code_version() -> str:
    """A digest of the code that marks: when it changes, submissions are marked again. Computed once."""
    paths = ((folder, path) for folder in CODE for path in folder.rglob("*") if path.is_file())
    files = {str(path.relative_to(folder.parent)): path for folder, path in paths}
    digest = hashlib.sha256()
    for name in sorted(name for name in files if "__pycache__" not in name):
        for part in (name.encode(), files[name].read_bytes()):
            digest.update(len(part).to_bytes(8) + part)
    return digest.hexdigest()


def lock_digest() -> str:
    """SHA-256 of the lock file."""
    return hashlib.sha256((ROS_PACKAGES.parent / LOCK).read_bytes()).hexdigest()


def versions() -> dict[str, str]:
    """The versions of the course, of Python and of the libraries that a grade depends on, by name."""
    python = f"{sys.version_info.major}.{sys.version_info.minor}"
    return {"course": code_version()[:12], "Python": python, **{it: metadata.version(it) for it in LIBRARIES}}
