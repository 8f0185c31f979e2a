import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.patience import PATIENCE

INTERFACES = Path(__file__).resolve().parents[2] / "ros_packages" / "interfaces"
sys.path.append(str(INTERFACES))

ALONE = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "OFF", "FASTDDS_BUILTIN_TRANSPORTS": "UDPv4"}


def run_round_trip(python: str | Path, environment: dict[str, str]) -> dict:
    """Run round_trip.py with this Python and return what it printed."""
    command = [str(python), str(Path(__file__).with_name("round_trip.py")), str(PATIENCE)]
    done = subprocess.run(
        command, env={**environment, **ALONE}, capture_output=True, text=True, timeout=PATIENCE
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.fixture
def definitions() -> Path:
    return INTERFACES / "definitions"


@pytest.fixture(scope="session")
def came_back() -> dict:
    return run_round_trip(sys.executable, dict(os.environ))


@pytest.fixture(scope="session")
def came_back_under():
    """Run the round trip in another virtual environment."""
    # These lead another environment's Python to this one's ROS libraries.
    ros_variables = ("LD_LIBRARY_PATH", "_ROS_WHEELS_BOOTSTRAP_COMPLETE", "VIRTUAL_ENV", "PYTHONPATH")
    clean = {name: value for name, value in os.environ.items() if name not in ros_variables}
    return lambda python: run_round_trip(python, clean)
