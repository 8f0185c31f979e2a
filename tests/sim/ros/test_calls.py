"""Calls of services in the recording: who asked, who answered, when, and what."""

import pytest

from sim import run
from tests.sim.ros.evidence import logged, raised, why
from tests.students.engine import callers, services

ADD = "example_interfaces/srv/AddTwoInts"
AT_ONCE = ("/customer", "/adder", 0.0, 0.0, 0.0, 0.0)


def recorded(*programs, seconds=4):
    return run(*programs, seconds=seconds, quiet=True)


def ways(calls):
    """(client, server, asked, taken, answered, received) of each call."""
    return [(c.client, c.server, c.requested, c.taken, c.answered, c.received) for c in calls]


def sums(calls):
    return [(c.request.a, c.request.b, c.response.sum if c.response else None) for c in calls]


@pytest.mark.parametrize("adder", [services.Adder, services.AsyncAdder])
@pytest.mark.parametrize("customer", [services.until_future_complete, services.done_callback])
def test_a_call_has_both_ends_four_stamps_and_both_messages(adder, customer):
    (call,) = recorded(adder, customer).calls
    assert (call.service, call.type, call.raised) == ("/add", ADD, "")
    assert ways([call]) == [AT_ONCE]
    assert sums([call]) == [(2, 3, 5)]


@pytest.mark.parametrize("programs", [
    (services.Adder, callers.AsksAtOnce), (callers.AsksAtOnce, services.Adder),
], ids=["server first", "client first"])  # fmt: skip
def test_a_request_before_two_programs_have_found_each_other_is_lost(programs):
    recording = recorded(*programs, seconds=1.5)
    assert [(call.request.a, call.requested, call.received, call.lost) for call in recording.calls] == [
        (5, 0.0, None, True), (6, 1.0, None, True), (7, 1.0, 1.0, False), (8, 1.5, 1.5, False),
    ]  # fmt: skip
    assert logged(recording) == [(1.0, "sum 7")]


def test_a_program_that_has_the_server_needs_no_time_to_find_it():
    recording = recorded(callers.asks_itself_at_once, seconds=1)
    assert logged(recording) == [(0.0, "sum 5"), (1.0, "sum 6"), (1.0, "sum 7")]


def test_each_reader_gets_a_copy():
    (call,) = recorded(services.Adder, services.done_callback).calls
    call.request.a = call.response.sum = 99
    assert sums([call]) == [(2, 3, 5)]


def test_requests_wait_until_the_server_takes_them():
    calls = recorded(services.SlowAdder, services.many_calls).calls
    assert ways(calls) == [
        ("/customer", "/adder", 0.0, 0.5 * n, 0.5 * (n + 1), 0.5 * (n + 1)) for n in range(5)
    ]
    assert sums(calls) == [(n, 1, n + 1) for n in range(5)]


def test_a_call_that_no_one_answers_has_only_been_asked():
    calls = recorded(services.no_one_answers).calls
    assert ways(calls) == [("/customer", "", 1.5, None, None, None)]
    assert sums(calls) == [(2, 3, None)]


def test_a_call_that_blocks_its_own_answer_is_never_received():
    assert ways(recorded(services.Adder, services.single_exclusive).calls) == [
        ("/customer", "/adder", 1.0, 1.0, 1.0, None)
    ]


def test_a_client_that_is_not_spun_receives_nothing():
    assert ways(recorded(services.Adder, callers.never_spins).calls) == [(*AT_ONCE[:5], None)]


def test_a_call_from_a_thread_is_received():
    recording = recorded(services.Adder, callers.calls_from_a_thread)
    assert logged(recording) == [(1.0, "sum 5")]
    assert ways(recording.calls) == [("/customer", "/adder", 1.0, 1.0, 1.0, 1.0)]


def test_equal_requests_of_two_clients_are_distinguished():
    calls = recorded(services.SlowAdder, callers.First, callers.Second).calls
    assert ways(calls) == [
        ("/customer", "/adder", 0.0, 0.0, 0.5, 0.5), ("/second", "/adder", 0.0, 0.5, 1.0, 1.0),
    ]  # fmt: skip


def test_two_servers_make_two_calls_of_one_request_and_the_first_answer_is_received():
    recording = recorded(callers.two_servers, services.done_callback)
    assert ways(recording.calls) == [AT_ONCE, ("/customer", "/other", 0.0, 0.0, 0.0, None)]
    assert sums(recording.calls) == [(2, 3, 5), (2, 3, 6)]
    assert logged(recording) == [(0.0, "sum 5")]


@pytest.mark.parametrize("server, kept", [(services.Adder, 10), (callers.ShortMemory, 2)])
def test_requests_that_a_full_queue_forgot_are_never_taken(server, kept):
    calls = recorded(server, callers.Flood, seconds=1).calls
    assert [call.server for call in calls] == [""] * (12 - kept) + ["/adder"] * kept
    assert sums(calls) == [(n, 0, n if n >= 12 - kept else None) for n in range(12)]


@pytest.mark.filterwarnings("ignore:failed to send response")
def test_a_client_that_went_away_receives_nothing():
    recording = recorded(services.SlowAdder, callers.goes_away)
    assert ways(recording.calls) == [("/customer", "/adder", 0.0, 0.0, 0.5, None)]
    assert recording.errors == []


def test_an_answer_after_the_timeout_is_not_received():
    recording = recorded(services.SlowAdder, callers.gives_up)
    assert logged(recording) == [(0.2, "None")]
    assert ways(recording.calls) == [("/customer", "/adder", 0.0, 0.0, 0.5, None)]


@pytest.mark.parametrize("server, error", [
    (callers.Raises, ("ValueError", "no sum today")),
    (callers.ReturnsText, ("TypeError", (
        "Expected <class 'example_interfaces.srv._add_two_ints.AddTwoInts_Response'>, got <class 'str'>"
    ))),
    (callers.ReturnsAnOddResponse, ("KeyError", "'read once'")),
], ids=lambda value: getattr(value, "__name__", ""))  # fmt: skip
def test_a_callback_that_fails_is_named_in_its_call(server, error):
    recording = recorded(server, services.done_callback)
    assert raised(recording) == [(0.0, "/adder", f"{server.__name__}.add", *error)]
    assert [call.raised for call in recording.calls] == [error[0]]
    assert ways(recording.calls) == [("/customer", "/adder", 0.0, 0.0, None, None)]


def test_a_callback_can_not_change_what_was_asked():
    assert sums(recorded(callers.ChangesTheRequest, services.done_callback).calls) == [(2, 3, 5)]


def test_what_is_no_request_is_refused_in_words():
    recording = recorded(services.Adder, callers.asks_with_text)
    words = "Expected <class 'example_interfaces.srv._add_two_ints.AddTwoInts_Request'>, got <class 'str'>"
    assert logged(recording) == [(0.0, words)]
    assert raised(recording) == [(0.0, "/customer", "asks_with_text", "TypeError", words)]
    assert recording.calls == []


def test_a_request_sent_past_rclpys_client_has_no_client():
    (call,) = recorded(services.Adder, callers.asks_past_the_client).calls
    assert ways([call]) == [("", "/adder", None, 0.0, 0.0, None)]
    assert sums([call]) == [(2, 3, 5)]


@pytest.mark.filterwarnings("ignore:failed to send response")
def test_calls_without_end_are_stopped():
    recording = recorded(services.Adder, callers.CallsForEver)
    assert why(recording) == (
        "livelock", 1.0, "/customer sent 20000 messages at t = 1 s without letting time advance.",
    )  # fmt: skip
    assert len(recording.calls) == 20000


def test_a_client_with_a_method_of_the_students_own_is_recorded():
    assert sums(recorded(services.Adder, callers.OwnCall).calls) == [(1, 1, 2), (2, 2, 4)]


def test_a_client_that_forgot_what_it_waits_for_receives_nothing():
    assert ways(recorded(services.Adder, callers.ForgetsPendingRequests).calls) == [(*AT_ONCE[:5], None)]


def test_a_service_that_was_destroyed_takes_no_more():
    recording = recorded(callers.DestroysItsService, callers.OncePerSecond)
    assert ways(recording.calls) == [
        ("/customer", "/adder", 1.0, 1.0, 1.0, 1.0),
        *(("/customer", "", second, None, None, None) for second in (2.0, 3.0, 4.0)),
    ]
    assert [call.lost for call in recording.calls] == [False, True, True, True]


def test_a_request_before_there_is_a_server_is_lost():
    assert recorded(services.done_callback, services.late_adder).calls[0].lost
    assert not recorded(services.Adder, services.done_callback).calls[0].lost


def test_services_of_every_node_are_there_when_asked_for():
    recording = recorded(services.Wheel, services.parameter_services)
    assert recording.calls_of() == []
    (call,) = recording.calls_of("/wheel/set_parameters")
    assert ways([call]) == [("/asker", "/wheel", 0.0, 0.0, 0.0, 0.0)]
    assert call.request.parameters[0].value.double_value == 0.5
    assert call.response.results[0].successful


def test_calls_are_found_by_service_client_and_server():
    recording = recorded(services.SlowAdder, callers.First, callers.Second)
    first, second = recording.calls
    assert recording.calls_of() == recording.calls_of("/add", server="/adder") == [first, second]
    assert recording.calls_of(client="/second") == [second]
    assert recording.calls_of("add") == recording.calls_of(server="/customer") == []


def test_until_sees_the_calls_so_far():
    recording = run(
        services.SlowAdder, services.many_calls, seconds=9, quiet=True,
        until=lambda recording: sum(call.received is not None for call in recording.calls) == 2,
    )  # fmt: skip
    assert (recording.ended.reason, recording.ended.stamp) == ("goal", 1.0)
