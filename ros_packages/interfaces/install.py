"""Install the course's ROS interface packages into the Python that runs this.

    python ros_packages/interfaces/install.py

Does nothing if the current content is installed. Otherwise the wheel comes from the user's cache or is built.
"""

import os
import platform
import shutil
import subprocess
import sys
import tempfile
from importlib import metadata
from pathlib import Path

from build_tools.content import ROOT, version
from build_tools.toolchain import BuildError, require_compilers

NAME = "ros2-course-interfaces"


def installed() -> str | None:
    """Return the installed version, or None."""
    try:
        return metadata.version(NAME)
    except metadata.PackageNotFoundError:
        return None


def cached_wheel() -> Path:
    """Return the path of the current content's wheel in the cache; the wheel need not exist."""
    cache = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache", NAME)
    return cache / f"{NAME.replace('-', '_')}-{version()}-cp311-abi3-linux_x86_64.whl"


def build(wheel: Path) -> None:
    """Build the wheel outside the repository and store it in the cache.

    Raises:
        BuildError: a tool is missing, or the build failed; the message contains the output.
    """
    require_compilers()
    with tempfile.TemporaryDirectory() as directory:
        copy = Path(directory, "interfaces")
        shutil.copytree(ROOT, copy, ignore=shutil.ignore_patterns("build", "*.egg-info", "__pycache__"))
        log = Path(directory, "log")
        with log.open("w") as output:
            process = subprocess.Popen(
                [sys.executable, "-c", "from setuptools.build_meta import build_wheel; build_wheel('dist')"],
                cwd=copy,
                # Fixed times in the archive make builds reproducible.
                env={**os.environ, "SOURCE_DATE_EPOCH": "1704067200"},
                stdout=output,
                stderr=subprocess.STDOUT,
            )
        if print_progress(process, copy):
            output = log.read_text()
            raise BuildError(f"{output}\nThe ROS interfaces could not be built; the reason is above.")
        wheel.parent.mkdir(parents=True, exist_ok=True)
        # Moved into the folder and then renamed, so that other processes never see an incomplete wheel.
        partial = wheel.with_suffix(f".{os.getpid()}")
        shutil.move(copy / "dist" / wheel.name, partial)
        partial.replace(wheel)


def print_progress(process: subprocess.Popen, copy: Path) -> int:
    """Print each package when its compilation begins, until the build ends. Return its exit status."""
    started: set[str] = set()
    packages = len(list((copy / "definitions").iterdir()))
    while True:
        try:
            return process.wait(timeout=0.5)
        except subprocess.TimeoutExpired:
            for name in sorted({folder.name for folder in copy.glob("build/temp*/objects/*")} - started):
                started.add(name)
                print(f"  {len(started)} of {packages}: {name}", flush=True)


def install(wheel: Path) -> None:
    """Install the wheel with pip, without changing any other package."""
    options = ["--no-deps", "--no-index", "--force-reinstall", "--quiet", "--root-user-action=ignore"]
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "install", *options, str(wheel)]
    subprocess.run(pip, check=True)


def main() -> None:
    """Install the interface packages, or exit with one sentence that says what to do."""
    try:
        if platform.machine() != "x86_64" or installed() == version():
            return  # on other machines a ROS installation provides them
        wheel = cached_wheel()
        if not wheel.exists():
            print("Building the ROS interfaces, once; this takes half a minute ...", flush=True)
            build(wheel)
        install(wheel)
    except BuildError as error:
        sys.exit(str(error))
    except KeyboardInterrupt:
        sys.exit("Stopped: the ROS interfaces are built when the same command is run again.")


if __name__ == "__main__":
    main()
