"""%ros2 in a real kernel: the player that runs while the cell waits, and the last run."""

import pytest
from jupyter_client.manager import start_new_kernel

from tests.patience import PATIENCE
from tests.sim.ros.test_play_in_notebook import Kernel
from tests.sim.ros2.official import OFFICIAL


@pytest.fixture(scope="module")
def kernel():
    manager, client = start_new_kernel(kernel_name="python3", startup_timeout=PATIENCE)
    yield Kernel(manager, client)
    client.stop_channels()
    manager.shutdown_kernel(now=True)


def completed(kernel, line):
    """What the Tab key offers at the end of a line."""
    reply = kernel.client.complete(line, reply=True, timeout=PATIENCE)["content"]
    return [line[: reply["cursor_start"]] + each for each in reply["matches"]]


def test_the_tab_key_completes_verbs_options_and_names(kernel):
    kernel("from tests.sim.ros2.nodes import NODES")
    assert kernel("%ros2 node list").startswith("Nothing has run yet")
    assert completed(kernel, "%ros2 topic ec") == ["%ros2 topic echo"]
    assert completed(kernel, "x = 1\n%ros2 top") == ["x = 1\n%ros2 topic"]
    assert completed(kernel, "%ros2 topic echo --onc") == ["%ros2 topic echo --once"]
    assert "%ros2 topic echo /place" not in completed(kernel, "%ros2 topic echo /pl")
    kernel("recording = run(*NODES, seconds=1, quiet=True)")
    assert completed(kernel, "%ros2 topic echo /pl") == ["%ros2 topic echo /place"]
    assert "%ros2 topic echo /place" not in completed(kernel, "%ros2 topic echo '")
    assert not kernel.errors


def test_it_uses_the_player_and_then_its_recording(kernel):
    kernel("from tests.sim.ros2.nodes import NODES, Listener")
    kernel("data = 3\nplayer = play(*NODES, seconds=60, speed=20, quiet=True)")
    assert kernel("%ros2 node list") == OFFICIAL["node list"]
    assert kernel("%ros2 topic hz /place").startswith("average rate: 10.000\n")
    said = kernel("%ros2 topic pub --once /level std_msgs/msg/Float64 '{data: 2.0}'")
    assert "publishing #1: std_msgs.msg.Float64(data=2.0)\n" in said
    assert kernel("player.stop()\n%ros2 topic echo --field data /level") == "2.0\n---\n"
    said = kernel("%ros2 topic pub --once /level std_msgs/msg/Float64")
    assert said.startswith("Nothing is running any more")
    assert not kernel.errors
