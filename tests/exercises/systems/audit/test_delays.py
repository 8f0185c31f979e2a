"""Delays that a student gives: which can be, and what is said of the others."""

import math

import pytest

from grader.exercises.systems.audit.delays import delay_of, read_delays
from grader.exercises.systems.audit.deliveries import deliveries


def test_a_number_is_for_all_messages_and_a_list_for_the_first_ones():
    assert read_delays("labeler", {"camera": 0.2, "/scale": [0, 0.05]}) == {"camera": [20], "scale": [0, 5, 0]}
    delays = {"camera": [20], "scale": [0, 5, 0]}
    assert [delay_of(delays, "camera", number) for number in range(3)] == [20, 20, 20]
    assert [delay_of(delays, "scale", number) for number in range(4)] == [0, 5, 0, 0]
    assert delay_of(delays, "labels", 0) == 0


STEPS = "which isn't one of 0, 0.05, ... 0.3 s"


@pytest.mark.parametrize(
    ("given", "text"),
    [
        ({}, "{}, which isn't a dictionary with a topic or a service in it"),
        (0.2, "0.2, which isn't a dictionary with a topic or a service in it"),
        ({"labels": 0.2}, "a delay of “labels”, which isn't one of scale, camera"),
        ({"camera": 0.35}, f"a delay of 0.35 s, {STEPS}"),
        ({"camera": 0.12}, f"a delay of 0.12 s, {STEPS}"),
        ({"camera": -0.05}, f"a delay of -0.05 s, {STEPS}"),
        ({"camera": math.nan}, f"a delay of nan s, {STEPS}"),
        ({"camera": 10**400}, f"a delay of 10000000000000000000 s, {STEPS}"),
        ({"camera": True}, f"a delay of True s, {STEPS}"),
        ({"camera": [0.1, "0.2"]}, f"a delay of 0.2 s, {STEPS}"),
    ],
)
def test_other_delays_are_refused(given, text):
    with pytest.raises(ValueError) as caught:
        read_delays("labeler", given)
    assert str(caught.value) == text


def test_deliveries_say_what_can_be_delivered():
    with pytest.raises(ValueError) as caught:
        deliveries("label", {})
    assert str(caught.value) == ("There is no system 'label', only labeler, dock, collector, rider, job_starter, "
                                 "speed_gate.")  # fmt: skip
    with pytest.raises(ValueError) as caught:
        deliveries("dock", {"departures": 0.1})
    assert str(caught.value) == "The delays have a delay of “departures”, which isn't one of arrivals, open_gate."
