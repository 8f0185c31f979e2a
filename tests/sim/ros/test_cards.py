"""A world's card tells the truth about its topics."""

import re

import pytest

from sim import World, run
from sim.evidence import INFRASTRUCTURE_TOPICS

# A topic's name, but not the second half of a type's: std_msgs/Float64.
TOPIC = re.compile(r"(?<!\w)/[a-z]\w*(?:/\w+)*")


@pytest.mark.parametrize("name", World.names())
def test_the_card_names_every_topic_that_the_world_takes_or_gives_and_no_other(name):
    recording = run(world=name, seconds=0.2, quiet=True)
    line = next(line for line in recording.world.card.splitlines() if line.startswith("Topics:"))
    ends = {end.name for end in recording.graph.endpoints if "service" not in end.kind}
    services = {end.name for end in recording.graph.endpoints if end.kind == "service"}
    clock = {"/clock"} if recording.messages("/clock") else set()
    assert bool(clock) == (name != "turtlesim")
    assert set(TOPIC.findall(line)) - services == ends - INFRASTRUCTURE_TOPICS | clock
