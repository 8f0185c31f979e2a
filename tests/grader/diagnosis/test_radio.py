"""What a network did to messages explains a missed check, and is no flaw of a program."""

import pytest

from grader import Exercise, Scenario
from grader.diagnosis import explain, find_flaw
from sim import Network, Process, run
from tests.students.engine import network

LOST = "123 of 300 messages on /count from /counter to /listener were lost on the network: "
SENTENCES = [
    (
        network.SloppyCounter, network.SloppyListener, {"network": Network(loss=0.4)},
        LOST + "with reliability best_effort at one end, nothing is sent again. Messages that must arrive need reliable at both ends.",
    ),
    (
        network.ShallowCounter, network.Listener, {"network": Network(loss=0.1, delay=0.02), "seconds": 4, "seed": 2},
        "1 of 40 messages on /count from /counter to /listener was lost on the network: both ends are reliable, but newer messages pushed them out of the publisher's history before they could be sent again. A larger depth "
        "keeps them longer.",
    ),
    (
        network.DeepCounter, network.Listener, {"network": Network(loss=0.1, delay=0.02), "seed": 1},
        "On /count a message from /counter reached /listener 3.9 s late: the network lost some, and with reliable at both ends all others wait until these have been sent again. Where only the newest message counts, use best_effort.",
    ),
    (network.Counter, network.Listener, {"network": Network(delay=1.0)}, ""),
]  # fmt: skip


def record(talker, listener, settings):
    return run(Process(talker, host="robot"), listener, quiet=True, **{"seconds": 30} | settings)


@pytest.mark.parametrize(("talker", "listener", "settings", "sentence"), SENTENCES)
def test_what_the_network_did_is_said(talker, listener, settings, sentence):
    recording = record(talker, listener, settings)
    assert explain(recording) == sentence
    assert find_flaw(recording) == ""


def test_what_happens_between_our_own_nodes_is_no_news():
    programs = [network.SloppyCounter, Process(network.SloppyListener, host="base")]
    recording = run(companions=programs, seconds=5, network=Network(loss=0.5), quiet=True)
    assert recording.crossings[0].lost and explain(recording) == ""


ALL_LOST = {"companions": [network.Counter], "network": Network(loss=1.0)}


@pytest.mark.parametrize("more", [ALL_LOST, {"scenarios": [Scenario(seconds=5, **ALL_LOST)]}])
def test_an_exercise_can_have_a_network(more):
    exercise, seen = Exercise("receive", "Receive", seconds=5, **more), []

    @exercise.check(1)
    def receives(recording):
        """The node is there."""
        seen.append((recording.hosts, len(recording.logs)))

    assert exercise.grade(network.Listener) == 1
    assert seen == [({"/counter": "robot", "/listener": "laptop"}, 0)]
