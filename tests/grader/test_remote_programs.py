"""Students' nodes in another process: as here, or one that lies to the grader."""

import functools

import pytest
from rclpy.node import Node

from grader import Exercise, check
from grader.exercise import Scenario
from grader.programs import LocalPrograms, RemotePrograms
from sim.ros.launching.respawned import respawned
from sim.ros.remote import RemoteLost
from tests.sim.ros import test_respawned
from tests.sim.ros.remote.follower_process import FollowerProcess
from tests.sim.ros.remote.test_protocol_errors import answering, self_reports


class Companion(Node):
    """A companion without a mistake."""

    def __init__(self):
        super().__init__("companion")


@check(points=5)
def talks(recording):
    """The node talks."""
    assert recording.messages("/chat"), "this check would be broken"


TALKING = Exercise("talking", "Talking", [talks], seconds=1, companions=[Companion])


def test_a_forged_error_is_not_attributed_to_the_course():
    made_up = ["/companion", "Companion.tick", "ValueError", "no", f'File "{__file__}", line 1, in tick']
    with answering({"answer": None}, self_reports(errors=[made_up])) as remote:
        score = TALKING.judge(RemotePrograms(remote))
    assert (float(score), score.broken) == (0.0, [])


def test_a_lost_process_is_not_attributed_to_the_course():
    with answering({"answer": None}, {"failed": "no"}) as remote, pytest.raises(RemoteLost):
        TALKING.judge(RemotePrograms(remote))


@pytest.mark.parametrize("answer", [5, ["saw"], ["saw", 5], {}, [["saw"], "hint"]])
def test_an_invalid_refusal_is_a_lost_process(answer):
    with answering({"answer": answer}) as remote, pytest.raises(RemoteLost) as lost:
        TALKING.judge(RemotePrograms(remote))
    assert lost.value.reason == "The process with the nodes did not report whether they can be run."


def test_a_refusal_is_shown_unchanged():
    with answering({"answer": ["None", "Write your class."]}) as remote:
        score = TALKING.judge(RemotePrograms(remote))
    assert float(score) == 0.0
    assert (score.verdicts[0].saw, score.verdicts[0].hint) == ("None", "Write your class.")


def test_a_program_in_another_process_is_killed_at_the_same_time():
    scenario = Scenario(None, 5.0, prepare=functools.partial(respawned, 1.0, 2.0, 0.5))
    follower = FollowerProcess()
    with follower.serving(test_respawned.__name__, "Counter") as remote:
        there = test_respawned.counts(scenario.run(RemotePrograms(remote), 0))
    follower.close()
    assert there == test_respawned.counts(scenario.run(LocalPrograms([test_respawned.Counter]), 0))
