import pytest
from rclpy.node import Node

from grader.checks.shift import Job, Shift
from grader.marking.extras.league.contest import Contest, counted, game_of
from sim import World, run
from tests.bench.capstone import work
from tests.students.engine.drivers import Driver


class Idle(Node):
    def __init__(self):
        super().__init__("idle")


def job(number: int, over: float | None, status: str = "delivered") -> Job:
    return Job(number, 10.0 * number, 200.0, over, over, status)


def shift(met_person: float | None) -> Shift:
    jobs = (job(1, 40.0), job(2, 90.0), job(3, 95.0, "expired"), job(4, None, "waiting"))
    return Shift(jobs, {}, met_person, (), 1.0, {})


@pytest.mark.parametrize(
    ("met", "waited"), [(None, [30.0, 70.0]), (91.0, [30.0, 70.0]), (60.0, [30.0]), (40.0, [])]
)
def test_what_is_delivered_after_a_person_was_touched_does_not_count(met, waited):
    assert counted(shift(met)) == waited


def test_a_game_is_what_a_run_in_a_warehouse_shows():
    recording = work(7, 40.0)
    game = game_of(recording)
    assert (game.delivered, game.people, game.contacts, game.why) == (1, 0, 0, "")
    assert 20.0 < game.waited < 40.0 < 100 * game.way
    assert game.digest == recording.digest
    assert game.replay


def test_where_nothing_is_delivered_the_likely_reason_is_reported():
    idle = run(Idle, world=World.generate("warehouse", seed=7), seconds=1, quiet=True)
    why = "/idle has no publisher, no subscription and no timer: nothing can happen in it."
    assert game_of(idle).why == why


def test_another_run_is_refused():
    with pytest.raises(ValueError, match="this run has no warehouse"):
        game_of(run(Driver, world="room", seconds=1, quiet=True))


def test_all_play_in_the_same_warehouses_which_the_words_decide():
    def seeds(contest: Contest) -> list[int]:
        return [seed for _, seed in contest.rounds()]

    assert seeds(Contest()) == list(range(10))
    assert seeds(Contest("words", 3)) == seeds(Contest("words", 10))[:3]
    assert not set(seeds(Contest("words"))) & set(seeds(Contest("other words")))
