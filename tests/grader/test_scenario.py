"""One run of an exercise: its world, its companions, and when it ends."""

import pytest
from rclpy.node import Node
from std_msgs.msg import String

from grader import Exercise, Missed, check
from grader.checks import logs, publishes
from grader.seeds import private_seed
from sim import Process, World
from tests.students import misfits, mistakes


@check(points=1)
def sends(recording):
    """The node sends text on /chatter."""
    publishes(recording, "/chatter", "std_msgs/msg/String")


def statuses(score):
    return {verdict.name: verdict.status for verdict in score.verdicts}


def test_a_world_may_be_drawn_from_the_seed_without_showing_it(monkeypatch):
    monkeypatch.setenv("COURSE_SECRET", "d1ce")
    maze = Exercise(
        "talk",
        "A talker",
        [sends],
        seconds=1,
        world=lambda seed: World.generate("maze", seed=seed),
        seeds=[1, 2],
    )
    score = maze.grade(misfits.SilentTalker)
    seeds = [recording.seed for recording in score.recordings]
    assert seeds == [private_seed("d1ce", "talk", index) for index in (0, 1)]
    walls = [World.generate("maze", seed=seed).walls for seed in seeds]
    assert [(r.world.name, r.world.walls) for r in score.recordings] == [
        ("maze", walls[0]),
        ("maze", walls[1]),
    ]
    assert "Run: 1 of 2, world maze" in score.text


def test_a_world_that_does_not_exist_is_a_mistake_of_the_course():
    score = Exercise("talk", "A talker", checks=[sends], world="rom").grade(misfits.Talker)
    assert (score, statuses(score)) == (0.0, {"sends": "broken"})
    assert "Did you mean 'room'?" in score.broken[0].alarm


class Questioner(Node):
    """A companion that asks once, at 1 s."""

    def __init__(self):
        super().__init__("questioner")
        self.publisher = self.create_publisher(String, "/chatter", 10)
        self.create_timer(1.0, self.ask)

    def ask(self):
        self.publisher.publish(String(data="?"))


class FaultyCompanion(Questioner):
    def ask(self):
        raise KeyError("own")


@check(points=1)
def receives(recording):
    """The node logs what it receives."""
    logs(recording, "received")


def test_companions_run_beside_the_students_node():
    listen = Exercise("listen", "A listener", checks=[receives], companions=[Questioner])
    assert listen.grade(misfits.Listener) == 1.0
    assert listen.grade(misfits.Empty) == 0.0


def test_companions_are_up_before_the_students_node():
    listen = Exercise("listen", "A listener", checks=[receives], companions=[Questioner])
    assert listen.grade(misfits.Listener).recordings[0].graph.nodes == ["/questioner", "/listener"]


def test_companions_may_depend_on_the_seed():
    asked = []
    listen = Exercise(
        "listen",
        "A listener",
        checks=[receives],
        seeds=(3, 5),
        companions=lambda seed: asked.append(seed) or [Questioner],
    )
    assert listen.grade(misfits.Listener) == 1.0
    assert asked == [3, 5]


@pytest.mark.parametrize("companion", [FaultyCompanion, Process(FaultyCompanion, name="asker")])
def test_an_error_of_a_companion_is_a_mistake_of_the_course(companion):
    score = Exercise("listen", "A listener", checks=[receives], companions=[companion]).grade(misfits.Listener)
    assert (score, statuses(score)) == (0.0, {"receives": "broken"})
    assert "CompanionError: /" in score.broken[0].alarm
    assert "KeyError: 'own'" in score.broken[0].alarm


def test_an_error_of_the_student_beside_a_companion_is_the_students():
    score = Exercise("listen", "A listener", checks=[receives], companions=[Questioner]).grade(
        mistakes.DividesByZero
    )
    assert statuses(score) == {"runs": "failed", "receives": "skipped"}


def test_a_run_can_end_early():
    brief = Exercise("talk", "A talker", checks=[sends], until=lambda recording: recording.stamp >= 2.0)
    assert brief.grade(misfits.Talker).recordings[0].ended.reason == "goal"


def test_a_node_with_the_name_of_one_of_the_course_is_reported():
    listen = Exercise("listen", "A listener", companions=[Questioner])

    @listen.check(1)
    def is_asked(run):
        """It is asked."""
        if "/questioner" not in run.course_nodes:
            raise Missed("questions", "none of the course")

    *_, line = listen.grade(Process(misfits.Talker, name="questioner")).verdicts
    assert line.hint == (
        "Two nodes are called /questioner, yours and one that takes part in this exercise, and ROS can't tell "
        "them apart: give yours a name of its own, in super().__init__('...')."
    )
