"""What warm processes make before they fork."""

import shutil
import subprocess
import sys

from sim.world import world
from tests.patience import PATIENCE

LOOK = """
import sys
from pathlib import Path

from sim.world import World, world
world._FOLDER = Path(sys.argv[1])
import grader.marking.preload
from sim.ros.messages.template import _make_fill
from sim.ros.robots.sensor_messages import SensorMessages
worlds, fields = World._of_the_course.cache_info().misses, _make_fill.cache_info().misses
SensorMessages(World.load("room").lidar)
print(World._of_the_course.cache_info().misses - worlds, _make_fill.cache_info().misses - fields, fields > 0)
try:
    World.load("mine")
except world.WorldError as error:
    print(error)
"""


def test_worlds_and_messages_are_made_before_and_a_broken_world_holds_up_only_who_runs_in_it(tmp_path):
    shutil.copy(world._FOLDER / "room.toml", tmp_path)
    (tmp_path / "mine.toml").write_text("walls = 3")
    looked = subprocess.run(
        [sys.executable, "-c", LOOK, str(tmp_path)],
        capture_output=True,
        text=True,
        check=False,
        timeout=PATIENCE,
    )
    assert looked.returncode == 0, looked.stderr
    made, reason = looked.stdout.splitlines()
    assert made == "0 0 True"
    assert reason.startswith("mine.toml: ")
