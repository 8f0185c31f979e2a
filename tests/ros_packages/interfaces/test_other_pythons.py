"""The wheel that one Python built works under the others."""

import shutil
import subprocess
import sys
from importlib import metadata
from pathlib import Path

import install
import pytest

from tests.patience import PATIENCE

UV = shutil.which("uv", path=str(Path(sys.executable).parent))


def interpreter(minor: str) -> str | None:
    """A Python of this version that runs; a version manager's shim may exist and not run."""
    candidates = [shutil.which(f"python{minor}"), *Path.home().glob(f".pyenv/versions/{minor}.*/bin/python")]
    for candidate in filter(None, candidates):
        command = [str(candidate), "-c", f"import sys; sys.exit(sys.version_info[:2] != (3, {minor[2:]}))"]
        if subprocess.run(command, capture_output=True, check=False, timeout=PATIENCE).returncode == 0:
            return str(candidate)
    return None


OTHERS = {
    minor: found
    for minor in ("3.11", "3.12", "3.13", "3.14")
    if minor != f"3.{sys.version_info.minor}" and (found := interpreter(minor))
}


def environment(python: str, directory: Path) -> Path:
    """A virtual environment with the same ROS wheels as this one's and our wheel; returns its Python."""
    wheel = install.INTERFACES.ready_wheel() or install.INTERFACES.build()
    ros = [
        f"{name}=={metadata.version(name.split('[')[0])}"
        for name in ("ros-jazzy-rclpy[fastrtps]", "ros-jazzy-common-interfaces", "numpy")
    ]
    made = directory / "bin" / "python"
    subprocess.run([UV, "venv", "--quiet", "--python", python, directory], check=True, timeout=PATIENCE)
    command = [UV, "pip", "install", "--no-config", "--quiet", "--python", made, *ros, wheel]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=PATIENCE)
    if done.returncode:
        pytest.skip(f"the ROS wheels could not be installed: {done.stderr.strip()}")
    return made


@pytest.mark.soak
@pytest.mark.skipif(not UV, reason="uv, which makes the other environments, is not installed")
@pytest.mark.parametrize("minor", OTHERS)
def test_the_wheel_works_under_another_python(minor, tmp_path, came_back, came_back_under):
    assert came_back_under(environment(OTHERS[minor], tmp_path / "environment")) == came_back
