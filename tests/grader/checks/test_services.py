import pytest

from grader import Missed
from grader.checks import calls, responds, serves
from sim import run
from tests.grader.recordings import recording
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


def test_serves_misses_a_service_that_nobody_offers():
    miss = missed(serves, recording(), "/add", ADD)
    assert (miss.expected, miss.saw) == (f"a service /add of type {ADD}", "nobody offers it")


def test_serves_points_at_a_name_that_is_nearly_the_same():
    miss = missed(serves, ran(misfits.MisspeltService, services.done_callback), "/add")
    assert (miss.expected, miss.saw) == ("a service /add", "nobody offers it; there is /ad")
    assert miss.hint == "Is /ad a typing slip? Did you mean /add?"


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
    assert (miss.expected, miss.saw) == (f"a client for /add of type {ADD}", "nobody has a client for it")
    miss = missed(calls, ran(services.Customer), "/add")
    assert (miss.expected, miss.saw) == ("a call of /add", "a client, but no call")
    miss = missed(calls, ran(services.many_calls), "/add", at_least=6)
    assert (miss.expected, miss.saw) == ("6 or more calls of /add", "only 5 in 4 s")
    miss = missed(calls, ran(services.many_calls), "/ad")
    assert (miss.saw, miss.hint) == (
        "nobody has a client for it; there is one for /add", "Is /add a typing slip? Did you mean /ad?",
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
    (misfits.adder_that_nobody_spins, "nobody took the request"),
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


def test_responds_misses_a_service_that_is_not_there():
    assert missed(responds, recording(), "/add").expected == "a service /add"


def test_responds_needs_somebody_who_calls():
    miss = missed(responds, ran(services.Adder), "/add")
    assert (miss.expected, miss.saw) == ("calls of /add that want an answer", "0, and none of them is one")


def test_responds_knows_calls_whose_client_is_unknown():
    assert len(responds(ran(services.Adder, callers.asks_past_the_client), "/add", total)) == 1


def test_responds_judges_two_servers_each():
    miss = missed(responds, ran(callers.two_servers, services.done_callback), "/add", one_more)
    assert (miss.saw, miss.credit) == ("sum=5", 0.5)
