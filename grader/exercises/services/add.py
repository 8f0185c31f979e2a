"""A service in one line, which adds."""

from grader.checks import course_calls, offers, wrong_response
from grader.checks.services import call_text, response_fields
from grader.companions.service_clients import Questioner
from grader.exercise import Exercise
from sim.evidence import Recording

ADD = "/add_two_ints"

add = Exercise("add", "A service in one line", seconds=6, companions=[Questioner], seeds=(1, 2),
               names_count=True)


@add.check(4)
def offers_to_add(run: Recording) -> None:
    """The node offers the service /add_two_ints of type AddTwoInts."""
    offers(run, ADD, "example_interfaces/srv/AddTwoInts")


@add.check(4, after=offers_to_add, guess="response.sum = request.a + request.b, and then return response.")
def adds(run: Recording) -> None:
    """Every request gets the sum of its two numbers."""
    for call in course_calls(run, ADD):
        total = call.request.a + call.request.b
        if response_fields(call).get("sum") != total:
            raise wrong_response(f"sum={total} for {call_text(call)}", call)
