"""Every world there is, in use: equal each time, without a fault, and with the topics that its card names."""

import re

import pytest

from sim.evidence import is_node_service
from tests.sim.ros import all_worlds

WORLDS = all_worlds.worlds()
OWN = {"/explorer", "/operator"}


@pytest.fixture(scope="module")
def first():
    """Each world's first run."""
    return {name: all_worlds.in_use(world) for name, world in WORLDS.items()}


@pytest.mark.parametrize("name", WORLDS)
def test_equal_runs_in_a_world_are_equal(first, name):
    assert all_worlds.in_use(WORLDS[name]).digest == first[name].digest


@pytest.mark.parametrize("name", WORLDS)
def test_nothing_goes_wrong_in_a_world(first, name):
    recording = first[name]
    assert tuple(recording.ended) == ("time", 15.0, "All 15 s were run.")
    assert recording.errors == []
    assert {line.level for line in recording.logs} == {"INFO"}
    texts = {line.text for line in recording.logs if not line.from_course}
    assert len(texts) == 15  # something new was received each second


@pytest.mark.parametrize("name", WORLDS)
def test_a_card_names_all_topics_and_no_others(first, name):
    (line,) = [line for line in WORLDS[name].card.splitlines() if line.startswith("Topics:")]
    ends = [end for end in first[name].graph.endpoints if end.node not in OWN]
    texts = {word.rstrip("/") for word in re.findall(r"(?<![\w/])/[a-z][a-z0-9_/]*", line)}
    there = {end.name for end in ends if not is_node_service(end.name)} - {"/parameter_events"}
    assert texts == there | ({"/clock"} if first[name].messages("/clock") else set())


def test_the_worlds_are_put_to_use(first):
    """Else equal runs would say little: things are touched and pushed, and everything that can move does."""
    touched = {contact.what for recording in first.values() for contact in recording.contacts}
    assert touched == {"wall", "box", "circle", "robot", "person"}
    pushed = [track for name, track in first["storeroom"].tracks.items() if track[0][1:] != track[-1][1:]]
    assert pushed
    for name in ("convoy", "arm", "joint", "cart_pole"):
        assert all(track[0][1:] != track[-1][1:] for track in first[name].tracks.values())


@pytest.mark.parametrize("name", ["lab", "warehouse", "storeroom", "convoy", "cart_pole", "maze_1"])
def test_another_seed_is_another_run(first, name):
    assert all_worlds.in_use(WORLDS[name], seed=2).digest != first[name].digest
