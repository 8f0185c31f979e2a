"""Install the course's ROS interface packages into the Python that runs this.

    python ros_packages/interfaces/install.py

Nothing happens when this very content is installed. Else the wheel comes from the user's cache, or is built.
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
    """Return where the wheel of the present content is kept, whether it is there or not."""
    cache = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache", NAME)
    return cache / f"{NAME.replace('-', '_')}-{version()}-cp311-abi3-linux_x86_64.whl"


def build(wheel: Path) -> None:
    """Build the wheel, outside the repository, and put it into the cache.

    Raises:
        BuildError: a tool is missing, or the build failed; the message holds what it printed.
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
                # Fixed times in the archive make two builds equal, byte by byte.
                env={**os.environ, "SOURCE_DATE_EPOCH": "1704067200"},
                stdout=output,
                stderr=subprocess.STDOUT,
            )
        if tell_packages(process, copy):
            said = log.read_text()
            raise BuildError(f"{said}\nThe ROS interfaces could not be built; the reason is above.")
        wheel.parent.mkdir(parents=True, exist_ok=True)
        # First beside its place, then renamed: another process never sees half a wheel.
        half = wheel.with_suffix(f".{os.getpid()}")
        shutil.move(copy / "dist" / wheel.name, half)
        half.replace(wheel)


def tell_packages(process: subprocess.Popen, copy: Path) -> int:
    """Print each package as its compilation begins, until the build ends; return the build's exit status."""
    told: set[str] = set()
    packages = len(list((copy / "definitions").iterdir()))
    while True:
        try:
            return process.wait(timeout=0.5)
        except subprocess.TimeoutExpired:
            for name in sorted({folder.name for folder in copy.glob("build/temp*/objects/*")} - told):
                told.add(name)
                print(f"  {len(told)} of {packages}: {name}", flush=True)


def install(wheel: Path) -> None:
    """Install the wheel with pip, without touching any other package."""
    options = ["--no-deps", "--no-index", "--force-reinstall", "--quiet", "--root-user-action=ignore"]
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "install", *options, str(wheel)]
    subprocess.run(pip, check=True)


def main() -> None:
    """Install what is not installed yet, or stop with one sentence that says what to do."""
    try:
        if platform.machine() != "x86_64" or installed() == version():
            return  # elsewhere rclpy is ROS's own, and so are all interfaces
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
