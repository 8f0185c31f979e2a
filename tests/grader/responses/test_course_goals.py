"""Goals that the course's clients send, and what is said of each."""

import pytest
from example_interfaces.action import Fibonacci

from grader import Missed
from grader.responses.course_goals import (
    FIBONACCI,
    FIBONACCI_TYPE,
    fibonacci_offered,
    goal_text,
    has_the_result,
    is_succeeded,
    lines,
    offered,
    picked,
    quoted,
    sequence,
)
from sim.evidence import Endpoint, Goal, Graph
from sim.ros.messages.codec import encode
from tests.sim.recordings import logged, recording

SERVER = Endpoint("action server", "/server", FIBONACCI, FIBONACCI_TYPE, {})
GOAL = "the goal (order=4) at 1 s"


def goal(order=4, numbers=None, *, requested=1.0, from_course=True, status="succeeded"):
    events = [(1.0, "accepted"), (2.0, status)]
    raw = encode(Fibonacci.Goal(order=order))
    found = Goal(FIBONACCI, FIBONACCI_TYPE, "/client", "00" * 16, raw, requested, "/server", events)
    found.requested_by_course = from_course
    found.raw_result = None if numbers is None else encode(Fibonacci.Result(sequence=numbers))
    return found


def missed(function, *arguments):
    with pytest.raises(Missed) as caught:
        function(*arguments)
    return caught.value


def test_the_courses_goals_for_a_server_are_given():
    own, other = goal(), goal(from_course=False)
    run = recording(goals=[other, own], graph=Graph(["/server"], [SERVER]))
    assert offered(run, FIBONACCI, FIBONACCI_TYPE) == [own]
    assert fibonacci_offered(run) == [own]
    for miss in (
        missed(offered, recording(goals=[own]), FIBONACCI, FIBONACCI_TYPE),
        missed(fibonacci_offered, recording(goals=[own])),
    ):
        assert miss.expected == f"an action server /fibonacci of type {FIBONACCI_TYPE}"
    assert miss.hint == (
        'ActionServer(self, Fibonacci, "/fibonacci", self.execute): node, type, name and callback.'
    )


def test_a_server_that_is_gone_before_a_goal_is_missed():
    miss = missed(picked, recording(goals=[goal(from_course=False)]), FIBONACCI)
    assert (miss.expected, miss.saw) == (
        "a server of /fibonacci that receives goals",
        "it had exited before a goal could be sent",
    )
    assert miss.guess == (
        "The node has to keep running: end main() with rclpy.spin(node), or executor.spin() with parentheses."
    )


def test_goals_that_were_never_sent_are_missed_as_an_earlier_one_has_not_ended():
    run = recording(goals=[goal(3), goal(4)])
    assert picked(run, FIBONACCI, lambda one: one.request.order == 4) == run.goals[1:]
    miss = missed(picked, run, FIBONACCI, lambda one: one.request.order == 9)
    assert miss.expected == "every goal for /fibonacci brought to an end, so that the next one can be sent"
    assert miss.saw == "only 2 sent in 10 s"
    assert miss.guess == "Each goal has to end: call succeed(), canceled() or abort(), and then return."


def test_the_sequence_goes_to_the_number_of_its_order_and_has_two_numbers_at_least():
    assert [sequence(order) for order in (0, 1, 2, 6)] == [[0, 1], [0, 1], [0, 1, 1], [0, 1, 1, 2, 3, 5, 8]]


def test_a_goal_is_shown_with_its_order_and_its_time():
    assert goal_text(goal(7)) == "the goal (order=7) at 1 s"
    assert goal_text(goal(7, requested=None)) == "the goal (order=7) at 0 s"


def test_a_goal_that_did_not_succeed_is_missed():
    is_succeeded(goal())
    miss = missed(is_succeeded, goal(status="aborted"))
    assert (miss.expected, miss.saw) == (f"{GOAL} succeeded", "aborted at 2 s")
    assert miss.guess == "Call goal_handle.succeed() before you return the result."


def test_lines_are_those_of_the_student_at_a_level_or_at_all():
    run = logged((1.0, "INFO", "one"), (2.0, "WARN", "two"), (3.0, "INFO", "three"))
    run.logs[2] = run.logs[2]._replace(from_course=True)
    assert (lines(run), lines(run, "WARN"), lines(run, "ERROR")) == (["one", "two"], ["two"], [])


def test_the_first_three_lines_are_quoted():
    assert quoted(["a", "b", "c", "d"]) == "“a”, “b”, “c”"
    assert quoted([]) == "no line"


@pytest.mark.parametrize(
    ("numbers", "guess"),
    [
        ([], "The result is empty: put the numbers into its field, Fibonacci.Result(sequence=sequence)."),
        ([0, 1, 1, 2], "The last number is missing: for order 5 the sequence ends with F(5), its sixth number."),
        ([0, 1, 1, 2, 3, 5], "There is one number too many: stop when the sequence contains F(order)."),
        ([0, 1, 2, 3, 5], "Each number is the sum of the two before it; the first two are 0 and 1."),
        ([0, 1, 1], "Each number is the sum of the two before it; the first two are 0 and 1."),
    ],
)
def test_a_wrong_result_has_a_guess_for_each_usual_mistake(numbers, guess):
    miss = missed(has_the_result, goal(4, numbers))
    assert miss.expected == f"[0, 1, 1, 2, 3] as the result of {GOAL}"
    assert (miss.saw, miss.guess) == (f"{numbers}", guess)


def test_the_right_result_passes_and_none_at_all_is_missed():
    has_the_result(goal(4, [0, 1, 1, 2, 3]))
    miss = missed(has_the_result, goal(4))
    assert (miss.saw, miss.guess) == (
        "no result; succeeded at 2 s",
        "End execute with: return Fibonacci.Result(sequence=sequence).",
    )
