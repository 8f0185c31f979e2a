"""Replays beside each other: what moved, and a ghost."""

from itertools import accumulate

import pytest

from sim import Recording, run
from sim.view.ghost_replay import pack_motion, player, with_ghost
from sim.view.packing import inflated
from tests.students.engine.drivers import Circler, Driver


@pytest.fixture(scope="module")
def straight() -> Recording:
    return run(Driver, world="room", seconds=2, quiet=True)


@pytest.fixture(scope="module")
def circle() -> Recording:
    return run(Circler, world="room", seconds=1, quiet=True)


def positions(track: list[list[int]]) -> list[tuple[int, ...]]:
    """Poses in whole mm and mrad."""
    return list(zip(*(list(accumulate(column)) for column in track), strict=True))


def test_it_has_the_motion_and_nothing_of_the_programs(straight):
    run_ = inflated(pack_motion(straight))
    assert (run_["logs"], run_["topics"], run_["scans"], "graph" in run_) == ([], [], [], False)
    assert run_["marks"] == [[2000, "end", "t = 2 s: the run ended.", None]]
    assert "driver" not in str(run_)
    last = straight.path[-1]
    assert positions(run_["tracks"][0])[-1] == tuple(round(1000 * value) for value in last[1:])


def test_the_ghost_is_where_the_other_robot_was_at_the_same_moment_and_stays_when_that_ends(straight, circle):
    other = inflated(pack_motion(circle))
    both = inflated(with_ghost(pack_motion(straight), pack_motion(circle)))
    assert both["world"]["bodies"][-1]["kind"] == "ghost"
    ghost = dict(zip(accumulate(both["stamps"]), positions(both["tracks"][-1]), strict=True))
    there = dict(zip(accumulate(other["stamps"]), positions(other["tracks"][0]), strict=True))
    common = ghost.keys() & there.keys()
    assert len(common) > 10
    assert {stamp: ghost[stamp] for stamp in common} == {stamp: there[stamp] for stamp in common}
    assert ghost[2000] == there[1000]


def test_a_player_is_inert_and_escapes_its_text(straight):
    packed = pack_motion(straight)
    assert player(packed, "<b>") == f'<div class="ros2-replay" data-replay="{packed}">&lt;b&gt;</div>'
    assert player(packed, "", packed) == (
        f'<div class="ros2-replay" data-replay="{with_ghost(packed, packed)}"></div>'
    )


def test_a_run_in_which_nothing_moved_is_refused():
    with pytest.raises(ValueError, match="nothing has moved in this run yet: it has no pose to draw"):
        pack_motion(Recording(world=run(Driver, world="room", seconds=1, quiet=True).world))
