"""What is sent from one host to another is late, lost or sent again, as the network and the QoS say."""

import pytest

from sim import Network, Process, Recording, play, run
from tests.bench import avoider
from tests.sim.ros.evidence import logged
from tests.students.engine import actions, network, services

FAR = Network(delay=0.25)
RADIO = Network(loss=0.2, delay=0.05, jitter=0.02)


def through(between, talker, *listeners, seconds=10, **more):
    talker = Process(talker, host="robot")
    return run(talker, *listeners, seconds=seconds, network=between, quiet=True, **more)


def received(recording):
    return [(round(stamp, 6), int(text)) for stamp, text in logged(recording)]


def crossing(recording):
    (row,) = recording.crossings
    return row


@pytest.fixture(scope="module")
def best_effort():
    return through(RADIO, network.SloppyCounter, network.SloppyListener, seconds=60)


def test_a_delay_makes_messages_late():
    recording = through(FAR, network.Counter, network.Listener, seconds=0.6)
    assert received(recording) == [(0.35, 1), (0.45, 2), (0.55, 3)]
    assert [row.stamp for row in recording.messages("/count")] == pytest.approx(
        [0.1, 0.2, 0.3, 0.4, 0.5, 0.6]
    )
    assert recording.hosts == {"/counter": "robot", "/listener": "laptop"}


def test_programs_of_one_host_need_no_network():
    recording = run(network.Counter, network.Listener, seconds=0.3, network=FAR, quiet=True)
    assert received(recording) == [(0.1, 1), (0.2, 2), (0.3, 3)]
    assert recording.crossings == []


def test_a_run_without_a_network_has_none_of_it():
    recording = through(None, network.Counter, network.Listener, seconds=0.3)
    assert received(recording) == [(0.1, 1), (0.2, 2), (0.3, 3)]
    assert (recording.network, recording.hosts, recording.crossings) == (None, {}, [])


def test_best_effort_loses_the_share_that_the_network_loses_and_what_is_overtaken(best_effort):
    row = crossing(best_effort)
    numbers = [number for _, number in received(best_effort)]
    assert row.sent == 600
    assert row.lost == pytest.approx(0.2 * 600, abs=25)  # five times sqrt(600 * 0.2 * 0.8) is 49
    assert len(numbers) == row.sent - row.lost  # of the last two, one is lost
    assert numbers == sorted(numbers)
    ways = [stamp - number / 10 for stamp, number in received(best_effort)]
    assert 0.03 <= min(ways) < 0.032 and 0.068 < max(ways) <= 0.07
    assert row.late == pytest.approx(max(ways), abs=1e-6)


def test_equal_runs_have_equal_digests_and_other_seeds_other_losses(best_effort, tmp_path):
    again = through(RADIO, network.SloppyCounter, network.SloppyListener, seconds=60)
    assert again.digest == best_effort.digest
    other = through(RADIO, network.SloppyCounter, network.SloppyListener, seconds=60, seed=1)
    assert other.crossings != best_effort.crossings
    loaded = Recording.load(best_effort.save(tmp_path / "radio.mcap"))
    assert (loaded.network, loaded.crossings, loaded.hosts) == (
        best_effort.network, best_effort.crossings, best_effort.hosts,
    )  # fmt: skip


def test_what_others_send_shifts_no_loss(best_effort):
    talkative = [Process(services.Adder, host="robot"), services.many_calls]
    more = through(RADIO, network.SloppyCounter, network.SloppyListener, *talkative, seconds=60)
    assert more.crossings == best_effort.crossings


def test_a_play_loses_the_same(best_effort):
    player = play(
        Process(network.SloppyCounter, host="robot"), network.SloppyListener, seconds=60, network=RADIO,
        quiet=True, speed=1e9,
    )  # fmt: skip
    assert player.result().digest == best_effort.digest


def test_links_have_networks_of_their_own():
    links = {("robot", "laptop"): Network(delay=0.5), ("laptop", "robot"): Network(delay=0.125)}
    listener = Process(network.Listener, host="robot")
    assert received(through(Network(links=links), network.Counter, network.Listener, seconds=0.7)) == [
        (0.6, 1), (0.7, 2),
    ]  # fmt: skip
    back = run(network.Counter, listener, seconds=0.4, network=Network(links=links), quiet=True)
    assert received(back) == [(0.225, 1), (0.325, 2)]
    both_ways = Network(links={("robot", "base"): Network(delay=0.5)})
    talker = Process(network.Counter, host="base")
    assert received(run(talker, listener, seconds=0.7, network=both_ways, quiet=True)) == [(0.6, 1), (0.7, 2)]


def test_bandwidth_is_shared_and_what_is_too_much_is_lost():
    narrow = Network(bandwidth=40)  # a number takes 8 bytes, so five a second; ten are sent
    recording = through(narrow, network.SloppyCounter, network.SloppyListener, seconds=4)
    assert received(recording)[:3] == [(0.3, 1), (0.5, 2), (0.7, 3)]
    assert crossing(recording).late == pytest.approx(1.2)
    assert crossing(recording).lost == 15


def test_reliable_messages_come_in_order_when_a_heartbeat_has_asked_for_the_lost_ones():
    recording = through(
        Network(loss=0.1, delay=0.02), network.DeepCounter, network.Listener, seconds=20, seed=6
    )
    numbers, row = [number for _, number in received(recording)], crossing(recording)
    assert numbers == list(range(1, len(numbers) + 1))
    assert (row.lost, row.resent) == (0, 17)
    first_late = next((stamp, number) for stamp, number in received(recording) if stamp > number / 10 + 0.021)
    # 3 s after the first message; and the way there, back and there again, with 5 ms for each answer
    assert first_late == (pytest.approx(0.1 + 3 + 0.02 + 0.005 + 0.02 + 0.005 + 0.02), 2)
    assert row.late == pytest.approx(4.97)  # fifty messages fill the history, and then each asks


def test_a_full_history_asks_at_once_and_forgets():
    recording = through(Network(loss=0.3, delay=0.02), network.ShallowCounter, network.Listener, seconds=20)
    row, numbers = crossing(recording), [number for _, number in received(recording)]
    assert numbers == sorted(numbers)
    assert (row.lost, row.resent, row.late) == (41, 32, pytest.approx(0.22))
    assert len(numbers) == row.sent - row.lost - 1  # the last one is under way


def test_one_message_comes_at_last():
    seed = next(s for s in range(20) if crossing(lone(s)).resent)
    ((stamp, number),) = received(lone(seed))
    assert number == 1 and stamp > 3.1


def lone(seed):
    return through(Network(loss=0.5, delay=0.02), network.OneWord, network.Listener, seconds=60, seed=seed)


def test_lifespans_end_on_the_way():
    recording = through(Network(delay=0.5), network.BriefCounter, network.BriefListener, seconds=3)
    assert logged(recording) == []
    assert crossing(recording).expired == 25


def test_the_lifespan_of_the_publisher_ends_no_message_that_is_on_its_way():
    recording = through(Network(delay=0.5), network.BriefCounter, network.Listener, seconds=3)
    assert [text for _, text in logged(recording)] == [str(number) for number in range(1, 26)]
    assert crossing(recording).expired == 0


def test_late_joiners_get_what_is_latched_through_the_network():
    recording = through(FAR, network.LatchingCounter, network.LateListener, seconds=3)
    assert received(recording) == [(2.25, 3), (2.25, 4), (2.25, 5)]
    lossy = through(Network(loss=0.5, delay=0.25), network.LatchingCounter, network.LateListener, seconds=30)
    assert [number for _, number in received(lossy)] == [3, 4, 5]
    assert crossing(lossy).resent > 0


def test_what_is_under_way_arrives_though_its_publisher_has_gone():
    recording = through(FAR, network.speaks_and_leaves, network.Listener, seconds=5)
    assert received(recording) == [(0.35, 1)]
    assert (recording.ended.reason, crossing(recording).resent) == ("time", 0)


def test_what_is_lost_stays_lost_when_its_publisher_has_gone():
    recording = through(Network(loss=1.0), network.speaks_and_leaves, network.Listener, seconds=5)
    assert (logged(recording), crossing(recording).resent) == ([], 0)


def test_what_is_under_way_to_one_that_has_gone_reaches_no_one():
    recording = through(FAR, network.Counter, network.listens_for_a_moment, seconds=5)
    assert (logged(recording), recording.errors) == ([], [])
    assert crossing(recording).sent == 1


def test_a_robot_drives_over_the_radio():
    recording = run(avoider.Avoider, world="room", seconds=5, network=RADIO, quiet=True)
    ways = {(row.topic, row.sender): row for row in recording.crossings}
    assert ways["/scan", "/robot"].lost and ways["/cmd_vel", "/avoider"].resent
    assert recording.path[-1] != recording.path[0]


def test_a_publisher_that_keeps_all_is_stopped_by_a_full_history():
    recording = through(Network(loss=1.0), network.KeepsAll, network.ReceivesAll)
    ((stamp, words),) = logged(recording)
    assert words == "5001: RCLError Failed to publish: cannot publish data"
    assert stamp == pytest.approx(1 + 4.0 + 0.1)  # from the 1001st on a message takes a millisecond


def test_a_publisher_can_wait_for_acknowledgments():
    recording = through(FAR, network.AsksWhetherAllHaveIt, network.Listener)
    words = [(line.stamp, line.text) for line in recording.logs if line.node == "counter"]
    assert words == [
        (1.1, "all have it: False"),
        (pytest.approx(3.1 + 0.25 + 0.005 + 0.25), "all have it: True"),
    ]


def test_requests_and_responses_are_late_and_never_lost():
    far = through(FAR, services.Adder, services.done_callback, seconds=20)
    (call,) = far.calls_of("/add")
    assert (call.taken - call.requested, call.received - call.answered) == (0.25, 0.25)
    radio = through(Network(loss=0.4), services.Adder, services.many_calls, seconds=200)
    calls = radio.calls_of("/add")
    assert calls and all(call.received is not None for call in calls)
    assert any(call.received - call.requested >= 3 for call in calls)


def test_goals_feedback_and_results_are_late():
    recording = through(FAR, actions.Server, actions.Client, seconds=8)
    (goal,) = recording.goals
    accepted = goal.at("accepted") - goal.requested
    assert (accepted, goal.answered - goal.requested) == (0.25, 0.5)
    assert goal.received - goal.ended == 0.25
    (early, *_) = (line.stamp for line in recording.logs if line.text.startswith("feedback"))
    assert early == goal.feedback[0].stamp + 0.25


@pytest.mark.parametrize(
    ("make", "error", "words"),
    [
        (lambda: Network(loss=1.5), ValueError, "loss must be a share from 0 to 1; it is 1.5."),
        (lambda: Network(loss="much"), TypeError, "loss must be a share from 0 to 1; it is 'much'."),
        (lambda: Network(delay=-1), ValueError, "delay must be seconds, 0 or more; it is -1."),
        (lambda: Network(jitter=float("nan")), ValueError, "jitter must be seconds, 0 or more; it is nan."),
        (
            lambda: Network(bandwidth=0),
            ValueError,
            "bandwidth must be bytes per second, more than 0, or None; it is 0.",
        ),
        (
            lambda: Network(links={"robot": RADIO}),
            ValueError,
            'links are between two hosts, as in ("laptop", "robot"); this is \'robot\'.',
        ),
        (
            lambda: Network(links={("a", "b"): 0.5}),
            TypeError,
            "The link ('a', 'b') must be a Network without links; it is 0.5.",
        ),
        (
            lambda: run(network.Counter, network=0.2),
            TypeError,
            "network must be a Network, such as Network(loss=0.2); it is 0.2.",
        ),
    ],
)
def test_what_no_network_can_do_is_refused(make, error, words):
    with pytest.raises(error) as raised:
        make()
    assert str(raised.value) == words
