"""What is wrong in a run without an error, by real nodes, and the sentence for each."""

import pytest

from grader.diagnosis import DIAGNOSES, FLAWS, GUESSES, explain, find_fault, find_flaw
from sim import run
from tests.students import flaws, misfits, service_misfits, silent_mistakes, turns
from tests.students.engine import after_interrupt, services

STOP = "This robot stops by itself when no commands arrive; other robots drive on. Publish a Twist() with all zeros at the end."
SENTENCES = {
    (
        flaws.Driver,
        flaws.SecondDriver,
    ): "/driver and /second_driver both publish on /cmd_vel, and the robot obeys the latest command: at 0.1 s 0.2 m/s and 0 rad/s, at 0.1 s 0 m/s and 0 rad/s. Let one node command the robot, and have the other one send its requests to that node.",
    (
        flaws.CommandsOnceASecond,
    ): "/driver lets up to 1 s pass between two commands on /cmd_vel, but the robot stops by itself 0.5 s after each: repeat the command at 10 Hz, from a timer.",
    (flaws.FallsSilent,): f"The last command on /cmd_vel, at 1.9 s, was 0.2 m/s and 0 rad/s. {STOP}",
    (
        flaws.DividesByTheDistance,
    ): "/driver sent inf m/s and 0 rad/s on /cmd_vel at 0.1 s, and the robot refuses anything that isn't a finite number. In the scan of 0.1 s ray 0 is inf (nothing is there).",
    (
        flaws.Chatter,
        flaws.SleepsOverMessages,
    ): "/sleeper took 9 of 50 messages: SleepsOverMessages.on_message blocked it for up to 0.5 s each time, and more messages arrived meanwhile. A callback should store the message and return.",
    (
        flaws.TalksWithoutAPause,
    ): "From 0 s on, a loop without a pause keeps a whole processor core busy: thread "
    "TalksWithoutAPause.talk(), at line 95: while rclpy.ok():. Move what it does into a timer's callback, or add "
    "time.sleep(0.01).",
    (
        misfits.SleepyTalker,
    ): "The timer of /talker fired once in 5 s; 5 were due. Most likely SleepyTalker.tick "
    "waits (time.sleep, a long loop, a blocking service call) instead of returning: it blocked the node for 3 s. "
    "Let the timer do the waiting.",
    (
        misfits.main_without_spin,
    ): "/talker has a timer, but none of its callbacks ever ran. Callbacks run while the "
    "node spins: call rclpy.spin(node) in main().",
}
AT_A_WALL = {
    flaws.TakesTooNearForFree: "The robot's front touched a wall at 6.04 s, and /driver keeps driving against it: 0.5 m/s "
    "and 0 rad/s at 7.5 s. In the scan of 7.5 s ray 0 is -inf (something is too near to be measured).",
    flaws.BacksBlindly: "The robot's back touched a wall at 6.04 s, and /driver keeps driving against it: -0.5 m/s and 0 "
    "rad/s at 7.5 s. Stop earlier, as soon as the lidar sees something near.",
    flaws.TurnsAwayAtAWall: "",
}


def record(students):
    return run(*students, world="yard", seconds=5, quiet=True)


def names(students):
    return "+".join(student.__name__ for student in students)


@pytest.mark.parametrize("students, sentence", SENTENCES.items(), ids=map(names, SENTENCES))
def test_a_flaw_is_reported(students, sentence):
    recording = record(students)
    assert find_fault(recording) is None
    assert find_flaw(recording) == sentence


@pytest.mark.parametrize("student, sentence", AT_A_WALL.items())
def test_a_robot_that_is_driven_against_a_wall_is_reported(student, sentence):
    assert find_flaw(run(student, world="room", seconds=8, quiet=True)) == sentence


@pytest.mark.parametrize(
    "students",
    [
        (flaws.Driver,),
        (flaws.DrivesToTheEnd,),
        (flaws.SecondDriver,),
        (flaws.Hand, flaws.PassesOn),
        (flaws.Chatter,),
        (flaws.Once,),
        (flaws.Greeter,),
        (flaws.main_that_comes_to_its_end,),
        (misfits.Talker, misfits.Listener),
    ],
    ids=names,
)
def test_a_right_program_has_no_flaw(students):
    assert find_flaw(record(students)) == ""


def test_a_robot_without_a_driver_has_no_flaw():
    assert find_flaw(record([])) == ""


@pytest.mark.parametrize(
    "students",
    [(misfits.main_that_spins_three_seconds,), (services.SlowAdder, service_misfits.NoOneReceives)],
    ids=names,
)
def test_what_may_also_be_right_explains_a_missed_check_and_is_no_flaw(students):
    recording = run(*students, seconds=10, quiet=True)
    assert [explain(recording)] == [said for guess in GUESSES if (said := guess(recording))]
    assert find_flaw(recording) == ""


def test_every_flaw_is_earned_by_some_students():
    recordings = [record(students) for students in SENTENCES]
    recordings.append(run(flaws.BacksBlindly, world="room", seconds=8, quiet=True))
    recordings.append(run(after_interrupt.shuts_down_again, seconds=1, quiet=True))
    recordings.append(run(silent_mistakes.destroys_a_namesake, seconds=1, quiet=True))
    recordings.append(run(turns.TurnsWithoutNormalizing, world="room", seconds=30, quiet=True))
    assert [flaw.__name__ for flaw in FLAWS if not any(map(flaw, recordings))] == []
    assert set(GUESSES) <= set(DIAGNOSES)


def test_an_empty_answer_of_one_service_is_reported_beside_another_that_is_right():
    recording = run(service_misfits.SetsTheFieldsOfOneService, services.done_callback, seconds=3, quiet=True)
    assert explain(recording).startswith("Every answer of /add is empty: ")
