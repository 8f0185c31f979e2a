"""What a package's tests did on candidates."""

import pytest
from std_msgs.msg import Float64, String

from grader import Missed
from grader.checks.candidate_verdicts import candidate_verdicts, own_verdict
from tests.sim.recordings import exchange

TRUTH = [(True, "right"), (False, "wrong")]


def run_with(*verdicts, traffic=(1.5, 2.5)):
    """A run in which candidates 1 and 2 are sent at 1 and 2 s, with verdicts as pairs of stamp and text."""
    sent = [(float(number), String(data=f"{number}\ntext")) for number in (1, 2)]
    texts = [(stamp, String(data=text)) for stamp, text in verdicts]
    requests = [(stamp, Float64()) for stamp in traffic]
    streams = [("/candidates", sent, True), ("/verdicts", texts, False), ("/request", requests, False)]
    return exchange(*[stream for stream in streams if stream[1]])


BOTH = ((0.9, "own passed 3 OK"), (1.9, "1 passed 3 OK"), (2.9, "2 failed 3 test_it: assert"))


def missed(function, *arguments):
    with pytest.raises(Missed) as caught:
        function(*arguments)
    return caught.value.expected, caught.value.saw, caught.value.hint


def test_each_candidate_has_its_verdict():
    run = run_with(*BOTH)
    assert own_verdict(run, "node.py").tests == 3
    found = candidate_verdicts(run, TRUTH, "")
    assert [(right, verdict.passed) for right, verdict in found] == [(True, True), (False, False)]


def test_a_package_that_publishes_verdicts_itself_has_none_of_its_own():
    assert missed(own_verdict, run_with(*BOTH[1:]), "node.py") == (
        "the outcome of the tests on node.py",
        "none on /verdicts",
        "What runs your tests publishes on /verdicts: your tests leave that topic alone.",
    )


@pytest.mark.parametrize("traffic", [(), (1.5,), (0.5, 1.5, 3.5)])
def test_a_verdict_without_a_message_meanwhile_is_no_test(traffic):
    number = 2 if traffic else 1
    assert missed(candidate_verdicts, run_with(*BOTH, traffic=traffic), TRUTH, "") == (
        f"messages while candidate {number} is tested",
        "none",
        "A test runs the file that it tests, and sends it something: to read it is no test.",
    )


def test_a_candidate_without_a_verdict_has_the_hint_of_the_exercise():
    assert missed(candidate_verdicts, run_with(*BOTH[:2]), TRUTH, "A timeout.") == (
        "verdicts on 2 candidates",
        "none on candidate 2",
        "A timeout.",
    )
