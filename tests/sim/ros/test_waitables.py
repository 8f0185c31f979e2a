"""Waitables of a student's own class are asked; and an action may be offered with plain services."""

import pytest

from sim import Recording, run
from sim.ros.messages.type_definitions import definition
from tests.sim.ros.evidence import logged, raised
from tests.students.engine import waitables

DIALOGUE = [
    (0.75, "order 5"), (0.75, "feedback [7]"), (0.75, "accepted True"), (1.0, "feedback [10]"),
    (1.5, "feedback [15]"), (1.75, "result [1, 2, 3]"), (1.75, "canceling 1"),
]  # fmt: skip
RULE = "=" * 80


def received(*programs):
    recording = run(*programs, seconds=2, quiet=True)
    assert raised(recording) == []
    return logged(recording)


def test_a_guard_condition_in_a_waitable_rings():
    assert received(waitables.Ringer) == [(0.5, "ding"), (1.0, "ding"), (1.5, "ding"), (2.0, "ding")]


def test_a_service_in_a_waitable_answers():
    assert received(waitables.Counting, waitables.Asker) == [
        (0.5, "asked 1 times"), (1.0, "asked 2 times"), (1.5, "asked 3 times"), (2.0, "asked 4 times"),
    ]  # fmt: skip


def test_a_client_in_a_waitable_gets_its_answers():
    assert received(waitables.Calling) == [(0.5, "asked"), (1.0, "asked"), (1.5, "asked"), (2.0, "asked")]


def test_a_waitable_without_entities_is_looked_at_whenever_its_executor_wakes():
    assert received(waitables.raises_a_flag) == [(0.5, "seen"), (1.0, "seen"), (1.5, "seen"), (2.0, "seen")]


def test_a_timer_in_a_waitable_is_refused():
    assert raised(run(waitables.Ticking, seconds=2, quiet=True)) == [
        (
            0.0, "/ticking", "Ticking", "NotImplementedError",
            "Ticker is a Waitable with a timer, a subscription or a QoS event inside, and those can't be "
            "simulated there: make them with create_timer() and create_subscription(), and keep guard "
            "conditions, services and clients.",
        )
    ]  # fmt: skip


@pytest.mark.parametrize(
    "programs",
    [
        (waitables.ByHand, waitables.Client),
        (waitables.Client, waitables.ByHand),
        (waitables.by_hand_and_client,),
    ],
    ids=["server first", "client first", "one program"],
)
def test_plain_services_offer_an_action(programs):
    assert received(*programs) == DIALOGUE


def test_feedback_that_was_published_by_hand_is_kept(tmp_path):
    recording = run(waitables.ByHand, waitables.Client, seconds=2, quiet=True)
    recording.save(tmp_path / "by_hand.mcap")
    kept = Recording.load(tmp_path / "by_hand.mcap").messages("/fibonacci/_action/feedback")
    assert [(h.stamp, h.sender, list(h.message.feedback.sequence)) for h in kept] == [
        (stamp, "/by_hand", [round(stamp * 10 - 0.1)]) for stamp in (0.75, 1.0, 1.5, 2.0)
    ]


def test_parts_of_actions_and_services_have_a_definition():
    text = definition("example_interfaces/action/Fibonacci_FeedbackMessage")
    fields, feedback, uuid = text.split(f"\n{RULE}\n")
    assert fields == "unique_identifier_msgs/UUID goal_id\nexample_interfaces/Fibonacci_Feedback feedback\n"
    assert feedback == "MSG: example_interfaces/Fibonacci_Feedback\nint32[] sequence\n"
    assert uuid.startswith("MSG: unique_identifier_msgs/UUID\n") and uuid.endswith("uint8[16] uuid\n")
    assert definition("std_srvs/srv/SetBool_Request") == "bool data\n"
