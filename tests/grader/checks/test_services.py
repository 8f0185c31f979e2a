import pytest
from example_interfaces.srv import AddTwoInts
from std_srvs.srv import SetBool

from grader import Missed
from grader.checks import calls, responds, serves
from grader.checks.services import (
    course_calls,
    has_client,
    is_refusal,
    is_success,
    offers,
    response_fields,
    wrong_response,
)
from sim import run
from sim.evidence import Call, Endpoint, Graph
from sim.ros.messages.codec import encode
from tests.sim.recordings import recording
from tests.students import service_misfits as misfits
from tests.students.engine import callers, services

ADD = "example_interfaces/srv/AddTwoInts"


def ran(*programs, seconds=4):
    return run(*programs, seconds=seconds, quiet=True)


def missed(function, *arguments, **options):
    with pytest.raises(Missed) as caught:
        function(*arguments, **options)
    return caught.value


def total(request):
    return {"sum": request.a + request.b}


def one_more(request):
    return {"sum": request.a + request.b + 1}


def test_serves_finds_the_server():
    (end,) = serves(ran(services.Adder), "/add", ADD)
    assert (end.node, end.name, end.type) == ("/adder", "/add", ADD)


def test_serves_misses_a_service_that_no_one_offers():
    miss = missed(serves, recording(), "/add", ADD)
    assert (miss.expected, miss.saw) == (f"a service /add of type {ADD}", "no server for it")


def test_serves_points_at_a_name_that_is_nearly_the_same():
    miss = missed(serves, ran(misfits.MisspeltService, services.done_callback), "/add")
    assert (miss.expected, miss.saw) == ("a service /add", "no server for it; there is one for /ad")
    assert miss.hint == "Is /ad a typo? Did you mean /add?"


def test_serves_misses_another_type():
    miss = missed(serves, ran(services.Adder), "/add", "std_srvs/srv/Trigger")
    assert miss.saw == f"type {ADD} on /add"
    assert miss.hint == "Both ends of a service must use the same type: on /add it is std_srvs/srv/Trigger."


def test_calls_gives_the_calls():
    assert [call.request.a for call in calls(ran(services.many_calls), "/add", ADD, at_least=5)] == [
        0,
        1,
        2,
        3,
        4,
    ]


def test_calls_misses_a_client_and_its_calls():
    miss = missed(calls, ran(services.Adder), "/add", ADD)
    assert (miss.expected, miss.saw) == (f"a client for /add of type {ADD}", "no client for it")
    miss = missed(calls, ran(services.Customer), "/add")
    assert (miss.expected, miss.saw) == ("a call of /add", "a client, but no call")
    miss = missed(calls, ran(services.many_calls), "/add", at_least=6)
    assert (miss.expected, miss.saw) == ("6 or more calls of /add", "only 5 in 4 s")
    miss = missed(calls, ran(services.many_calls), "/ad")
    assert (miss.saw, miss.hint) == (
        "no client for it; there is one for /add", "Is /add a typo? Did you mean /ad?",
    )  # fmt: skip


def test_responds_gives_the_calls_that_were_answered_right():
    assert len(responds(ran(services.SlowAdder, services.many_calls), "/add", total, within=2.5)) == 5


def test_responds_misses_the_first_wrong_answer_and_gives_credit_for_the_others():
    miss = missed(responds, ran(services.Adder, services.many_calls), "/add", lambda request: {"sum": 1})
    assert miss.expected == "sum=1 as the answer to /add (a=1, b=1) at 0 s"
    assert (miss.saw, miss.hint, miss.credit) == ("sum=2", "", pytest.approx(0.2))


def test_responds_judges_only_the_calls_that_are_picked():
    record = ran(services.Adder, services.many_calls)
    picked = responds(record, "/add", lambda request: {"sum": 1}, where=lambda call: call.request.a == 0)
    assert len(picked) == 1


def test_responds_misses_an_answer_that_comes_late():
    miss = missed(responds, ran(services.SlowAdder, services.done_callback), "/add", within=0.4)
    assert miss.expected == "an answer to /add (a=2, b=3) at 0 s within 0.4 s"
    assert (miss.saw, miss.credit) == ("an answer after 0.5 s", 0.0)


@pytest.mark.parametrize("server, saw", [
    (callers.Raises, "the callback raised ValueError"),
    (misfits.adder_that_no_one_spins, "no server received the request"),
])  # fmt: skip
def test_responds_misses_an_answer_that_never_comes(server, saw):
    assert missed(responds, ran(server, services.done_callback), "/add").saw == saw


def test_responds_misses_a_callback_that_does_not_return():
    class Sleepy(services.Adder):
        wait = 100.0

    assert missed(responds, ran(Sleepy, services.done_callback), "/add").saw == "no answer"


def test_responds_leaves_out_what_is_not_due_at_the_end():
    record = ran(services.SlowAdder, services.many_calls, seconds=1.2)
    assert len(responds(record, "/add", total, within=1.5)) == 2


def called(requested, answered, *, taken=None, sum=0, seconds=4.0):
    """A run with a call of /add."""
    raw, response = encode(AddTwoInts.Request(a=1)), encode(AddTwoInts.Response(sum=sum))
    call = Call("/add", ADD, "/customer", raw, requested, "/adder", taken, answered)
    call.raw_response = None if answered is None else response
    return recording(calls=[call], seconds=seconds)


def test_responds_allows_half_a_second_since_the_request():
    assert responds(called(2.0, 2.5), "/add")
    miss = missed(responds, called(2.0, 2.51), "/add")
    assert miss.expected == "an answer to /add (a=1, b=0) at 2 s within 0.5 s"
    assert miss.saw == "an answer after 0.51 s"
    assert responds(called(2.0, 2.51), "/add", within=0.6)


def test_responds_counts_from_when_it_was_taken_where_no_request_was_seen():
    assert responds(called(None, 2.5, taken=2.0), "/add")
    miss = missed(responds, called(None, 2.75, taken=2.0), "/add")
    assert (miss.expected, miss.saw) == (
        "an answer to /add (a=1, b=0) at 2 s within 0.5 s", "an answer after 0.75 s",
    )  # fmt: skip
    assert missed(responds, called(None, 0.75), "/add").saw == "an answer after 0.75 s"


def test_responds_wants_an_answer_that_was_due_when_the_run_ended():
    assert missed(responds, called(3.5, None, taken=3.5), "/add").saw == "no answer"
    assert missed(responds, called(3.6, None, taken=3.6), "/add").expected == "a service /add"


def test_responds_shows_every_wrong_field():
    raw, response = encode(SetBool.Request()), encode(SetBool.Response(message="on"))
    call = Call("/arm", "std_srvs/srv/SetBool", "/a", raw, 1.0, "/b", 1.0, 1.0, 1.0, response)
    miss = missed(responds, recording(calls=[call]), "/arm", lambda request: {"success": True, "message": "off"})
    assert miss.expected == "success=True, message='off' as the answer to /arm (data=False) at 1 s"
    assert miss.saw == "success=False, message='on'"


def test_responds_misses_a_service_that_is_not_there():
    assert missed(responds, recording(), "/add").expected == "a service /add"


def test_responds_needs_someone_who_calls():
    miss = missed(responds, ran(services.Adder), "/add")
    assert (miss.expected, miss.saw) == ("calls of /add that should get a response", "0, but none like that")


def test_responds_knows_calls_whose_client_is_unknown():
    assert len(responds(ran(services.Adder, callers.asks_past_the_client), "/add", total)) == 1


def test_responds_judges_two_servers_each():
    miss = missed(responds, ran(callers.two_servers, services.done_callback), "/add", one_more)
    assert (miss.saw, miss.credit) == ("sum=5", 0.5)


def arm(message=None, *, requested=1.0, taken=1.0, by_course=True, success=False):
    """A call of /arm; without a message it was not answered."""
    raw = encode(SetBool.Request(data=True))
    call = Call("/arm", "std_srvs/srv/SetBool", "/pilot", raw, requested, "/robot", taken)
    call.requested_by_course = by_course
    if message is not None:
        call.answered, call.raw_response = 1.5, encode(SetBool.Response(success=success, message=message))
    return call


def test_the_courses_calls_are_those_that_the_course_requested():
    own, other = arm(), arm(by_course=False)
    assert course_calls(recording(calls=[other, own]), "/arm") == [own]
    expected = "a run that lasts until /arm is called"
    miss = missed(course_calls, recording(calls=[other]), "/arm")
    assert (miss.expected, miss.saw) == (expected, "All of it was run.")
    miss = missed(course_calls, recording(calls=[own]), "/arm", 2)
    assert miss.expected == f"{expected} 2 times"
    assert course_calls(recording(calls=[own, own]), "/arm", 2) == [own, own]


def test_who_offers_no_service_of_the_type_sees_how_to_make_one():
    offers(ran(services.Adder), "/add", ADD)
    miss = missed(offers, recording(), "/add", ADD)
    assert (miss.expected, miss.saw) == (f"a service /add of type {ADD}", "no server for it")
    assert miss.hint == 'self.create_service(AddTwoInts, "/add", self.callback) creates one.'


def test_who_has_no_client_of_the_type_sees_how_to_make_one():
    ends = [Endpoint("client", "/customer", "/arm", "std_srvs/srv/SetBool", {})]
    made, unseen = arm(by_course=False), arm(requested=None)
    run = recording(calls=[made, unseen], graph=Graph(["/customer"], ends))
    assert has_client(run, "/arm", "std_srvs/srv/SetBool") == [made]
    miss = missed(has_client, recording(), "/arm", "std_srvs/srv/SetBool")
    assert miss.expected == "a client for /arm of type std_srvs/srv/SetBool"
    assert miss.hint == 'self.client = self.create_client(SetBool, "/arm") creates one.'


@pytest.mark.parametrize(
    ("call", "fields", "success", "refusal"),
    [
        (arm("on", success=True), {"success": True, "message": "on"}, True, False),
        (arm("off"), {"success": False, "message": "off"}, False, True),
        (arm(), {}, False, False),
    ],
)
def test_a_response_is_a_success_or_a_refusal_and_without_one_it_is_neither(call, fields, success, refusal):
    assert (response_fields(call), is_success(call), is_refusal(call)) == (fields, success, refusal)


STUCK = (
    "The service's callback hasn't returned: it waits, or is stuck in a loop. Let it store the request in self, and return the response at once."
)


def test_a_wrong_response_is_shown_and_its_call_is_what_the_miss_is_about():
    call = arm("off")
    miss = wrong_response("it is on", call, "Switch it on.", credit=0.5)
    assert (miss.expected, miss.saw) == ("it is on", "success=False, message='off'")
    assert (miss.hint, miss.guess, miss.credit, miss.about) == ("", "Switch it on.", 0.5, (call,))
    assert wrong_response("it is on", call).credit == 0.0


def test_where_there_is_no_response_the_callback_is_stuck_or_was_never_called():
    for call, hint in ((arm(), STUCK), (arm(taken=None), "")):
        miss = wrong_response("it is on", call)
        assert (miss.saw, miss.hint) == ("no answer", hint)
