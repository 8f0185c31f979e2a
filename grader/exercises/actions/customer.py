"""A client that logs how its goal goes, and that it was rejected."""

from grader.checks import Missed, hinting, sends_goals
from grader.checks.services import sent_at
from grader.companions.action_servers import BusyFibonacci, LateFibonacci
from grader.exercise import Exercise, Scenario
from grader.responses import Window, numbers_in
from grader.responses.course_goals import FIBONACCI, FIBONACCI_TYPE, lines, quoted
from grader.variants import Variants
from sim.evidence import Goal, Recording

SOON = 0.3  # seconds from what a client receives to its log line
FURTHER = 2  # numbers in a line beside those of a sequence, such as a count

customer = Exercise("customer", "A client that receives feedback", scenarios=[
    Scenario(seconds=10, seed=1, companions=[LateFibonacci], name="late"),
    Scenario(seconds=10, seed=2, companions=[BusyFibonacci], name="busy"),
], may_end=True, variants=Variants(
    {"order": (7, 6, 8), "numbers": ("six", "five", "seven")},
    {"rejected": ("rejected", "refused")},
    {"result": ("result", "answer")},
    texts=("of order {order}", "(order={order})", "{numbers} numbers", "the word `{rejected}`",
           "was {rejected}", "the word `{result}`", "log “{result}”", 'info(f"{result}: '),
))


@customer.check(4)
def sends_a_goal_of_seven(run: Recording) -> Goal:
    """The node sends a goal of order 7 to /fibonacci, once there is a server."""
    wanted = customer.drawn.order
    with hinting(f"In ask: self.client.send_goal_async(Fibonacci.Goal(order={wanted}), ...)."):
        goal = sends_goals(run, FIBONACCI, FIBONACCI_TYPE)[-1]
    if not goal.server:
        hint = "A goal without a server is lost: send it only when self.client.server_is_ready() is True."
        saw = f"sent at {goal.requested:.3g} s, before there was a server"
        raise Missed("a goal that the server receives", saw, hint)
    if goal.request.order != wanted:
        hint = f"goal = Fibonacci.Goal(order={wanted})."
        raise Missed(f"order={wanted} in the goal", f"order={goal.request.order}", hint)
    return goal


@customer.check(4, after=sends_a_goal_of_seven, only="late")
def logs_the_progress(run: Recording, goal: Goal) -> None:
    """Each feedback is logged at info level, with its newest number."""
    for row in goal.feedback:
        newest, soon = row.message.sequence[-1], Window.after(row.stamp, SOON)
        texts = lines(run.during(soon.begin, soon.end), "INFO")
        if not any(_tells(text, newest, len(row.message.sequence)) for text in texts):
            hint = ("send_goal_async(goal, feedback_callback=self.on_feedback); in it the numbers are in "
                    "msg.feedback.sequence, and [-1] is the newest.")
            if any(newest in numbers_in(text) for text in texts):
                hint = "A line with this many numbers doesn't say which one is the newest: log that one."
            raise Missed(f"an info line with {newest} at {row.stamp:.3g} s", quoted(texts), hint)


@customer.check(4, after=sends_a_goal_of_seven, only="late")
def logs_the_result(run: Recording, goal: Goal) -> None:
    """The result is logged at info level: the word `result`, and the whole sequence."""
    if goal.ended is None:
        return
    texts, word = lines(run.during(goal.ended), "INFO"), customer.drawn.result
    wanted = list(goal.result.sequence)
    if not any(word in text.lower() and _holds(text, wanted) for text in texts):
        hint = ("In on_result the numbers are in future.result().result.sequence; list(...) makes them "
                "readable.")
        if goal.received is None:
            hint = ("The result wasn't requested. In ask: future.add_done_callback(self.on_response). "
                    "In on_response: goal_handle.get_result_async().add_done_callback(self.on_result).")
        raise Missed(f"an info line with “{word}” and {wanted} after {goal.ended:.3g} s", quoted(texts), hint)


@customer.check(3, after=sends_a_goal_of_seven)
def warns_of_a_rejection(run: Recording, goal: Goal) -> None:
    """A goal that is rejected is logged as a warning with the word `rejected`, and nothing else follows."""
    since, word = run.during(sent_at(goal)), customer.drawn.rejected
    rejected = [text for text in lines(since, "WARN") if word in text.lower()]
    if goal.status == "rejected" and not rejected:
        hint = "In on_response: if not goal_handle.accepted, self.get_logger().warning(...), and return."
        raise Missed(f"a warning with “{word}” after {goal.requested:.3g} s", quoted(lines(since)), hint)
    if goal.status != "rejected" and rejected:
        hint = "Warn only if goal_handle.accepted is False: if not goal_handle.accepted: ..."
        raise Missed("no such warning, because the goal was accepted", f"“{rejected[0]}”", hint)


def _tells(text: str, newest: int, length: int) -> bool:
    """Return whether a text has the newest number, and hardly more than a sequence that is this long."""
    numbers = numbers_in(text)
    return newest in numbers and len(numbers) <= length + FURTHER


def _holds(text: str, numbers: list[int]) -> bool:
    """Return whether a text has these numbers one after the other, and hardly any others."""
    found, length = numbers_in(text), len(numbers)
    few = len(found) <= length + FURTHER
    return few and any(found[begin : begin + length] == numbers for begin in range(FURTHER + 1))
