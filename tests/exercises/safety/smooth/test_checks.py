"""The checks of `smooth` at their edges: times, numbers of commands, limits and tolerances."""

import math

import pytest
from geometry_msgs.msg import Twist, Vector3

from grader.checks import judge
from grader.exercises.safety import smooth
from tests.sim.recordings import exchange

TICKS = [0.05 * (n + 1) for n in range(40)]  # s


def twists(speeds, stamps=TICKS):
    """A command at each of these times: linear.x, or a pair of linear.x and angular.z."""
    pairs = [speed if isinstance(speed, tuple) else (speed, 0.0) for speed in speeds]
    commands = [Twist(linear=Vector3(x=x), angular=Vector3(z=z)) for x, z in pairs]
    return list(zip(stamps, commands, strict=True))


def verdict(name, wanted, sent, stamps=TICKS):
    run = exchange(("/cmd_vel_raw", twists(wanted), True), ("/cmd_vel", twists(sent, stamps), False))
    return next(verdict for verdict in judge(smooth.checks, run) if verdict.name == name)


def passes(*arguments):
    return verdict(*arguments).status == "passed"


def missed(*arguments):
    """What was expected and seen, and the first words of the hint."""
    found = verdict(*arguments)
    assert found.status == "failed"
    return found.expected, found.saw, found.hint.split(":")[0]


def ramp(speed, step=0.025, count=40):
    """The commands that speed up gently."""
    return [math.copysign(min(step * (n + 1), abs(speed)), speed) for n in range(count)]


def ending(commands, *last):
    """The commands, with others at the end."""
    return [*commands[: -len(last)], *last]


STEADY, RAMP = [0.2] * 40, ramp(0.2)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_limiter_that_is_right_passes_every_check(sign):
    sent = list(zip(ramp(sign * 0.3), ramp(-sign * 1.0, 0.1), strict=True))
    names = [check.name for check in smooth.checks]
    assert len(names) == 6
    assert all(passes(name, [(sign * 0.8, -sign * 2.0)] * 40, sent) for name in names)


def test_a_command_may_take_a_tenth_of_a_second_and_no_longer():
    assert passes("responds_to_each", STEADY, RAMP, [*TICKS[:-1], 2.099])
    assert missed("responds_to_each", STEADY, RAMP, [*TICKS[:-1], 2.101]) == (
        "the answer to the command of 2 s within 0.1 s",
        "it comes at 2.1 s",
        "Publish in the callback of /cmd_vel_raw",
    )


def test_a_command_before_the_one_that_it_answers_is_missed():
    early = [*TICKS[:-1], 1.96]
    assert missed("responds_to_each", STEADY, RAMP, early)[1] == "it comes at 1.96 s"


@pytest.mark.parametrize("count", [1, 2])
def test_the_first_two_commands_and_the_last_two_may_be_unanswered(count):
    assert passes("responds_to_each", STEADY, RAMP[:-count], TICKS[count:])
    assert passes("responds_to_each", STEADY, RAMP[:-count], TICKS[:-count])
    assert passes("gets_there", [0.1] * count + STEADY[count:], RAMP[:-count], TICKS[count:])
    assert passes("gets_there", STEADY[count:] + [0.1] * count, RAMP[:-count], TICKS[:-count])


def test_where_the_first_commands_are_unanswered_the_others_are_judged():
    assert missed("gets_there", STEADY, [0.19] * 39, TICKS[1:])[0] == "linear.x 0.2 m/s at 1.4 s, for 0.2"


def test_four_commands_are_too_few_to_be_judged():
    assert missed("responds_to_each", STEADY, RAMP[:4], TICKS[:4])[:2] == (
        "5 or more messages of type geometry_msgs/msg/Twist on /cmd_vel",
        "only 4 in 10 s",
    )
    assert missed("responds_to_each", STEADY, RAMP[:5], TICKS[:5])[:2] == ("40 messages on /cmd_vel", "5")


def test_commands_that_are_late_but_in_time_belong_to_the_first_of_the_course_not_to_later_ones():
    late = [stamp + 0.035 for stamp in TICKS]
    assert passes("responds_to_each", STEADY, RAMP[:-1], late[:-1])


def test_one_command_is_sent_for_each():
    one_more = [*TICKS, 2.01]
    assert missed("responds_to_each", STEADY, [*RAMP, 0.2], one_more)[:2] == ("40 messages on /cmd_vel", "41")
    hint = "Publish once in the callback of /cmd_vel_raw, each time it is called."
    assert missed("responds_to_each", STEADY, RAMP[:-3], TICKS[:-3]) == ("40 messages on /cmd_vel", "37", hint)


def test_a_speed_is_reached_with_the_27th_command():
    assert passes("gets_there", STEADY, [0.19] * 26 + [0.2] * 14)
    assert missed("gets_there", STEADY, [0.19] * 27 + [0.2] * 13) == (
        "linear.x 0.2 m/s at 1.35 s, for 0.2",
        "0.19",
        "Keep adding the step, up to the request or the limit.",
    )


def test_a_speed_that_is_not_reached_is_shown_and_is_not_unsafe():
    found = verdict("gets_there", STEADY, [0.19] * 40)
    assert (found.picture, found.unsafe) == ("topics", False)


def test_the_commands_are_counted_anew_when_another_speed_is_wanted():
    assert passes("gets_there", [0.15] * 20 + [0.2] * 20, [0.15] * 40)


@pytest.mark.parametrize("speed", [0.2, -0.2])
def test_a_thousandth_is_close_enough_to_the_speed(speed):
    wanted = [speed] * 40
    assert passes("gets_there", wanted, ending(ramp(speed), speed * 0.9955, speed * 1.0045))
    assert missed("gets_there", wanted, ending(ramp(speed), speed * 0.993))[1] == f"{speed * 0.993:.3g}"
    assert not passes("gets_there", wanted, ending(ramp(speed), speed * 1.007))


def test_the_limit_is_the_speed_to_reach_where_more_is_wanted():
    assert passes("gets_there", [0.5] * 40, ramp(0.3))
    assert missed("gets_there", [0.5] * 40, ramp(0.25))[0] == "linear.x 0.3 m/s at 1.35 s, for 0.5"
    turns = [(0.0, -2.0)] * 40
    assert missed("gets_there", turns, [(0.0, -0.9)] * 40)[0] == "angular.z -1 rad/s at 1.35 s, for -2"


def test_a_speed_beyond_the_limit_is_a_miss_of_the_limit_only():
    for speed in (0.5, -0.5):
        assert passes("gets_there", [speed] * 40, [speed] * 40)
        assert verdict("keeps_the_limits", [speed] * 40, [speed] * 40).unsafe
    assert missed("gets_there", [0.5] * 40, [-0.5] * 40)[1] == "-0.5"


def test_a_speed_beyond_what_is_wanted_is_a_miss_where_the_limit_allows_what_is_wanted():
    assert missed("gets_there", STEADY, ramp(0.25))[1] == "0.25"


def test_the_limits_hold_but_for_rounding():
    fast = [(0.5, 2.0)] * 40
    right = list(zip(ramp(0.3), ramp(1.0, 0.1), strict=True))
    for sign in (1.0, -1.0):
        rounded = ending(right, (sign * 0.3000005, sign * 1.0000005))
        assert passes("keeps_the_limits", ending(fast, (0.0, 0.0)), rounded)
    hint = "Clip the request first"
    end = (0.3005, 1.0)
    expected = "linear.x up to 0.3 m/s", "0.3 m/s at 2 s", hint
    assert missed("keeps_the_limits", fast, ending(right, end)) == expected
    end = (0.3, -1.0005)
    expected = "angular.z up to 1 rad/s", "-1 rad/s at 2 s", hint
    assert missed("keeps_the_limits", ending(fast, (0.5, 0.0)), ending(right, end)) == expected


GENTLY = "linear.x that grows by 0.025 m/s at most"


def test_speeds_grow_by_a_step_but_for_rounding():
    assert passes("speeds_up_gently", STEADY, [0.0250005, *RAMP[1:]])
    assert missed("speeds_up_gently", STEADY, [0.0255, *RAMP[1:]]) == (
        GENTLY,
        "0 and then 0.0255 m/s at 0.05 s",
        "Store the speed you sent last, and go at most one step beyond it.",
    )
    turns = [(0.0, 0.5)] * 40
    assert passes("speeds_up_gently", turns, [(0.0, z) for z in ramp(0.5, 0.1)])
    assert missed("speeds_up_gently", turns, [(0.0, z) for z in ramp(0.5, 0.11)])[0] == (
        "angular.z that grows by 0.1 rad/s at most"
    )


def test_speeds_may_fall_at_once():
    assert passes("speeds_up_gently", ending(STEADY, 0.01), ending(RAMP, 0.01))


def test_backwards_speeds_grow_by_a_step_too():
    backwards = [-0.2] * 40
    hint = "The same limits apply backwards"
    assert missed("speeds_up_gently", backwards, [-0.1, *ramp(-0.2)[1:]]) == (
        GENTLY,
        "0 and then -0.1 m/s at 0.05 s",
        hint,
    )


def test_from_forwards_to_backwards_the_step_is_counted_from_0():
    turned = ending(STEADY, -0.1)
    assert passes("speeds_up_gently", turned, ending(RAMP, -0.025))
    hint = "From forwards to backwards the speed passes through 0"
    assert missed("speeds_up_gently", turned, ending(RAMP, -0.03)) == (GENTLY, "0.2 and then -0.03 m/s at 2 s", hint)


def test_a_request_of_0_is_obeyed_at_once_but_for_a_thousandth():
    stop = ending(STEADY, 0.0)
    assert passes("stops_at_once", stop, ending(RAMP, 0.0009))
    assert missed("stops_at_once", stop, ending(RAMP, 0.0011)) == (
        "linear.x 0 m/s at 2 s, for 0",
        "0.0011",
        "A limit on braking makes the stopping distance longer",
    )
    assert verdict("stops_at_once", stop, ending(RAMP, -0.0011)).unsafe


@pytest.mark.parametrize("nonsense", [math.nan, math.inf, -math.inf])
def test_what_is_no_finite_number_counts_as_0_but_for_a_thousandth(nonsense):
    strange = ending(STEADY, nonsense)
    assert passes("takes_no_nonsense", strange, ending(RAMP, 0.0009))
    assert missed("takes_no_nonsense", strange, ending(RAMP, 0.0011)) == (
        f"linear.x 0 m/s at 2 s, for {nonsense:.3g}",
        "0.0011",
        "min and max let NaN through, or turn it into the limit. Check math.isfinite(requested) first.",
    )
    assert verdict("takes_no_nonsense", strange, ending(RAMP, 0.1)).unsafe


def test_nonsense_for_a_long_time_is_no_speed_to_reach():
    assert passes("gets_there", [math.nan] * 40, [0.1] * 40)
