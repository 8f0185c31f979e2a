import dataclasses
import math

import pytest
from geometry_msgs.msg import Twist
from std_msgs.msg import Float64, String

from grader import Missed
from grader.checks import lasts, publishes, rate, series, subscribes, within
from grader.checks.topics import keeps_pace, longest_pause
from sim import run
from sim.evidence import Ended, Endpoint, Graph
from tests.exercises.topics.temperature import students as temperature
from tests.sim.recordings import published, recording
from tests.students import misfits


def ticks(stamps, message=None):
    return published("/chatter", [(stamp, message or String()) for stamp in stamps])


def missed(function, *arguments, **options):
    with pytest.raises(Missed) as caught:
        function(*arguments, **options)
    return caught.value


def test_publishes_gives_the_messages():
    received = publishes(run(misfits.Talker, seconds=5, quiet=True), "/chatter", "std_msgs/msg/String")
    assert [item.stamp for item in received] == [1.0, 2.0, 3.0, 4.0, 5.0]


def test_publishes_misses_a_topic_no_one_publishes():
    miss = missed(publishes, recording(), "/chatter")
    assert (miss.expected, miss.saw, miss.hint) == ("messages on /chatter", "no publisher there", "")


def test_publishes_points_at_a_name_that_is_nearly_the_same():
    miss = missed(
        publishes, run(misfits.MisspeltTopic, seconds=2, quiet=True), "/chatter", "std_msgs/msg/String"
    )
    assert miss.expected == "messages of type std_msgs/msg/String on /chatter"
    assert miss.saw == "no publisher there; there is one on /chater"
    assert miss.hint == "Is /chater a typo? Did you mean /chatter?"


def test_publishes_takes_no_connected_topic_for_a_typo():
    run_ = published("/chatters", [(1.0, String())], listeners=["/listener"])
    miss = missed(publishes, run_, "/chatter")
    assert (miss.saw, miss.hint) == ("no publisher there", "")


def test_publishes_misses_another_type():
    miss = missed(publishes, ticks([1.0], Float64()), "/chatter", "std_msgs/msg/String")
    assert miss.saw == "type std_msgs/msg/Float64 on /chatter"
    assert (
        miss.hint
        == "Both ends of a topic must use the same message type: on /chatter it is std_msgs/msg/String."
    )


def test_a_rate_misses_messages_that_no_one_can_receive():
    recorded = run(misfits.NewPublisherEachTime, seconds=5, quiet=True)
    assert len(publishes(recorded, "/chatter")) == 5
    miss = missed(rate, recorded, "/chatter", 1.0)
    assert (miss.expected, miss.saw) == ("1 Hz on /chatter, within 10%", "messages that are never received")
    assert miss.hint.startswith("/talker created 5 publishers on /chatter for 5 messages. Two programs need")
    assert miss.picture == "topics"


@pytest.mark.parametrize("talker", [misfits.NewPublisherForTheNextMessage, temperature.NewPublisherThatWaits])
def test_a_rate_takes_new_publishers_that_were_found_before_they_speak(talker):
    recorded = run(talker, seconds=5.4, quiet=True)
    (topic,) = recorded.topics
    assert len(recorded.graph.publishers(topic)) >= len(recorded.messages(topic)) == 5
    assert rate(recorded, topic, 1.0) == pytest.approx(1.0)


def test_publishes_misses_a_publisher_that_says_nothing():
    miss = missed(publishes, run(misfits.SilentTalker, seconds=2, quiet=True), "/chatter")
    assert (miss.expected, miss.saw) == ("messages on /chatter", "a publisher, but no message")
    assert (miss.guess, miss.picture) == ("", "topics")


def test_publishes_counts():
    miss = missed(publishes, ticks([1.0, 2.0]), "/chatter", at_least=3)
    assert (miss.expected, miss.saw) == ("3 or more messages on /chatter", "only 2 in 10 s")
    assert miss.guess == "Publish in a timer's callback each time it is called, from start to end."


def test_subscribes_finds_the_subscription():
    ends = subscribes(run(misfits.Listener, seconds=1, quiet=True), "/chatter", "std_msgs/msg/String")
    assert [end.node for end in ends] == ["/listener"]


def test_subscribes_misses_with_what_is_listened_to():
    graph = Graph(["/listener"], [Endpoint("subscription", "/listener", "/cmd", "std_msgs/msg/String", {})])
    miss = missed(subscribes, recording(graph=graph), "/robot/command", "std_msgs/msg/String")
    assert miss.expected == "a subscription to /robot/command of type std_msgs/msg/String"
    assert miss.saw == "no subscription there; there is one to /cmd"


def test_rate_is_measured_in_simulated_time():
    assert rate(run(misfits.Talker, seconds=10, quiet=True), "/chatter", 1.0) == 1.0


def test_rate_misses_another_rate_and_tells_the_period():
    miss = missed(rate, ticks([0.5 * n for n in range(1, 21)]), "/chatter", 1.0)
    assert miss.expected == "1 Hz on /chatter, within 10%"
    assert miss.saw == "2 Hz (20 messages in 10 s)"
    assert miss.hint == "A timer with a period of 1 s gives 1 Hz: the period is 1 / rate, in seconds."
    assert miss.picture == "topics"


def test_rate_blames_a_callback_that_sleeps():
    miss = missed(rate, run(misfits.SleepyTalker, seconds=10, quiet=True), "/chatter", 1.0)
    assert miss.hint.startswith("The timer of /talker fired 3 times in 10 s; 10 were due. Most likely")


def test_rate_misses_a_node_that_falls_silent():
    miss = missed(rate, ticks([1.0, 2.0, 3.0]), "/chatter", 1.0)
    assert miss.saw == "no message for 7 s, from 3 s on"
    assert miss.hint == "Publish from start to end, in the callback of a timer."
    assert miss.picture == "topics"


def test_a_rate_needs_two_messages():
    assert missed(rate, ticks([1.0]), "/chatter", 1.0).expected == "2 or more messages on /chatter"
    cut = dataclasses.replace(ticks([1.0, 2.0]), ended=Ended("hang", 2.0, "The callback tick never returned."))
    assert rate(cut, "/chatter", 1.0) == 1.0


@pytest.mark.parametrize("hz", [0.5, 2.0])
def test_a_rate_may_be_a_tenth_off_or_as_much_as_is_said(hz):
    def at(factor):
        return ticks([n / hz / factor for n in range(1, int(10 * hz * factor) + 1)])

    assert rate(at(1.09), "/chatter", hz) == pytest.approx(1.09 * hz)
    assert rate(at(0.91), "/chatter", hz) == pytest.approx(0.91 * hz)
    fast = missed(rate, at(1.12), "/chatter", hz)
    hint = f"A timer with a period of {1 / hz:g} s gives {hz:g} Hz: the period is 1 / rate, in seconds."
    assert (fast.expected, fast.hint) == (f"{hz:g} Hz on /chatter, within 10%", hint)
    assert missed(rate, at(0.88), "/chatter", hz).hint == hint
    assert rate(at(1.12), "/chatter", hz, tolerance=0.2) == pytest.approx(1.12 * hz)


@pytest.mark.parametrize("hz", [1.0, 2.0])
@pytest.mark.parametrize("where", ["at the start", "between", "at the end"])
def test_a_rate_allows_a_pause_of_two_and_a_half_periods(hz, where):
    def pausing(periods):
        shift = {"at the start": 0, "between": 15}.get(where, 30)
        stamps = [(n + (1 if n < shift else periods)) / hz for n in range(30)]
        end = stamps[-1] + (periods / hz if where == "at the end" else 0.1)
        return published("/chatter", [(stamp, String()) for stamp in stamps], seconds=end)

    assert rate(pausing(2.4), "/chatter", hz) == pytest.approx(hz, rel=0.1)
    since = {"at the start": 0.0, "between": 15 / hz}.get(where, 30 / hz)
    saw = f"no message for {2.6 / hz:.3g} s, from {since:.3g} s on"
    assert missed(rate, pausing(2.6), "/chatter", hz).saw == saw


def test_rate_misses_a_burst_at_one_moment():
    miss = missed(rate, ticks([1.0] * 10), "/chatter", 1.0)
    assert (miss.saw, miss.hint) == ("0 Hz (10 messages in 10 s)", "")


def test_a_pace_of_10_hz_has_a_hint_of_its_own_unless_a_callback_is_slow():
    keeps_pace(ticks([0.1 * n for n in range(1, 101)]), "/chatter", "Keep up.")
    for hz in (8.8, 11.2):
        miss = missed(keeps_pace, ticks([n / hz for n in range(1, int(10 * hz) + 1)]), "/chatter", "Keep up.")
        assert (miss.expected, miss.hint) == ("10 Hz on /chatter, within 10%", "Keep up.")
    slow = missed(keeps_pace, run(misfits.SleepyTalker, seconds=10, quiet=True), "/chatter", "Keep up.")
    assert slow.hint.startswith("The timer of /talker fired 3 times in 10 s; 10 were due.")


def test_the_longest_pause_is_between_two_moments_in_a_row():
    assert longest_pause([0.0, 1.0, 3.5, 4.0]) == (2.5, 1.0)
    assert longest_pause([1.0]) == longest_pause([]) == (0.0, 0.0)


def test_within_gives_the_values():
    run_ = published("/cmd_vel", [(1.0, twist(0.2)), (2.0, twist(0.4))])
    assert within(run_, "/cmd_vel", "linear.x", 0.2, 0.4) == [0.2, 0.4]


def test_within_misses_the_first_value_outside():
    run_ = published(
        "/temperature", [(1.0, Float64(data=22.0)), (2.0, Float64(data=25.5)), (3.0, Float64(data=26.0))]
    )
    miss = missed(within, run_, "/temperature", "data", 20, 25, unit="degrees C")
    assert miss.expected == "data on /temperature from 20 to 25 degrees C"
    assert miss.saw == "25.5 degrees C at 2 s; 2 of 3 are outside"
    assert (miss.hint, miss.picture) == ("", "topics")
    assert missed(within, run_, "/temperature", "data", 25, 30).saw == "22 at 1 s; 1 of 3 are outside"


def test_within_misses_a_topic_no_one_publishes():
    assert missed(within, recording(), "/temperature", "data", 20, 25).saw == "no publisher there"


def test_within_lets_no_nan_pass():
    miss = missed(
        within, published("/temperature", [(1.0, Float64(data=math.nan))]), "/temperature", "data", 20, 25
    )
    assert miss.saw == "nan at 1 s; 1 of 1 are outside"
    assert miss.hint == "NaN means that a calculation had no result."


def test_series_reads_nested_fields():
    assert series(published("/cmd_vel", [(1.0, twist(0.2))]), "/cmd_vel", "linear.x") == [(1.0, 0.2)]


def twist(speed):
    message = Twist()
    message.linear.x = speed
    return message


def test_lasts_is_content_with_messages_until_the_end():
    lasts(ticks([0.5, 9.0]), "/chatter")
    lasts(ticks([0.5]), "/chatter", pause=9.5)


def test_lasts_tells_the_last_message():
    miss = missed(lasts, ticks([0.5, 8.9]), "/chatter")
    assert miss.expected == "messages on /chatter until the end, at 10 s"
    assert miss.saw == "the last one at 8.9 s"
    assert miss.guess == "Publish from start to end, in a callback that is called again and again."
    assert miss.picture == "topics"


def test_lasts_wants_no_more_of_a_run_that_was_cut_short():
    cut = dataclasses.replace(ticks([0.5]), ended=Ended("hang", 1.0, "The callback tick never returned."))
    lasts(cut, "/chatter")
