"""Loads the shared libraries of ROS's wheels where the dynamic linker does not find them.

The wheels set LD_LIBRARY_PATH and start Python again. A kernel that was started before they were installed,
as in a notebook service, runs without it, and a system's pip may install to another prefix than its Python's.
The linker reads the variable only when a process starts, but it finds each library that is already loaded.
"""

import os
import re
import sys
from pathlib import Path

VARIABLE = "LD_LIBRARY_PATH"
STARTED_AGAIN = "_ROS_WHEELS_BOOTSTRAP_COMPLETE"  # by the wheels: a process with it is not started again
MODULES = ("rclpy/_rclpy_pybind11*.so", "*/*_s__rosidl_typesupport_c.*so")  # what Python imports of C++
MESSAGES = re.compile(r"lib\w+__rosidl_\w+\.so")  # of message packages: loaded by name when one is used


def site_packages() -> Path | None:
    """The folder that has rclpy; None without it. Nothing is imported for it."""
    places = (Path(place) for place in sys.path if place.endswith("-packages"))
    return next((place for place in places if (place / "rclpy").is_dir()), None)


def load_libraries() -> None:
    """Load the libraries that the linker doesn't find, here and in child processes. Idempotent.

    Does nothing where rclpy is not from a wheel. If a library can't be loaded, importing rclpy says why.
    """
    site = site_packages()
    if site is None or not (site / "ros_wheels_bootstrapper").is_dir():
        return
    folders = [site.parents[2] / "lib", *sorted(site.glob("ros_*.libs"))]
    searched = [path for path in os.environ.get(VARIABLE, "").split(os.pathsep) if path]
    missing = [str(folder) for folder in folders if not {str(folder), str(folder.resolve())} & set(searched)]
    if missing:
        os.environ |= {VARIABLE: os.pathsep.join(missing + searched), STARTED_AGAIN: "1"}
        known = {file.name: file for folder in reversed(folders) for file in folder.glob("lib*.so*")}
        messages = [file for name, file in sorted(known.items()) if MESSAGES.fullmatch(name)]
        modules = [file for pattern in MODULES for file in sorted(site.glob(pattern))]
        for library in (*messages, *modules):
            _load(library, known)


def _load(library: Path, known: dict[str, Path]) -> None:
    """Load a library, and first those that it needs: the linker's message names the next one it can't find.

    Others are not loaded, because wheels have copies of some libraries, and two of them exclude each other.
    """
    import ctypes

    loaded: set[str] = set()
    while True:
        try:
            ctypes.CDLL(str(library))
            return
        except OSError as error:
            needed = str(error).partition(":")[0]
            if needed in loaded or needed not in known:
                return
            loaded.add(needed)
            _load(known[needed], known)
