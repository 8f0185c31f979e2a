"""A player is paused, stepped, sped up, stopped and driven; its picture shows that and can't harm the run."""

import gc
import math
import subprocess
import sys
import threading
from dataclasses import replace

import pytest
from geometry_msgs.msg import Twist

from sim import Process, Teleop, World, play, run
from sim.ros.engine.process_state import ProcessState
from sim.ros.engine.running_program import RunningProgram
from sim.ros.fibers.scheduler import active
from sim.ros.play.teleop import RATE
from tests.patience import PATIENCE
from tests.sim.ros import playing
from tests.sim.ros.test_left_behind import footprint, live_nodes, nothing_is_left
from tests.students.engine import interrupts, mains

FRAME = 1 / 30


@pytest.fixture
def clock():
    """A frame passes with each look that the pace takes; the work of a frame takes no time."""
    return playing.Clock([FRAME / 4])


@pytest.fixture
def robot(clock):
    """A robot in the yard, at rest, that is watched."""
    made = playing.player(world="yard", seconds=600, clock=clock)
    made.watcher = playing.watched(made)
    yield made
    made.stop()


def frames(made, count):
    for _ in range(count):
        made.play_frame()


def sent(made, topic="/cmd_vel"):
    """Forward and turning speed of each command."""
    twists = [received.message for received in made.recording.messages(topic)]
    return [(twist.linear.x, twist.angular.z) for twist in twists]


# -- moving on -------------------------------------------------------------------------------------------


def test_a_pause_stops_time_and_a_step_is_one_scan(robot):
    frames(robot, 20)
    robot.pause()
    stamp, scans = robot.recording.stamp, len(robot.recording.messages("/scan"))
    frames(robot, 20)
    assert (robot.recording.stamp, len(robot.recording.messages("/scan"))) == (stamp, scans)
    for count in (1, 2, 3):
        robot.step()
        assert len(robot.recording.messages("/scan")) == scans + count
    robot.resume()
    frames(robot, 20)
    assert robot.recording.stamp > stamp + 0.2


def test_the_graph_is_shown_when_someone_asks_and_it_has_changed_once_a_second_at_most(robot):
    def ask(count):
        for _ in range(count):
            robot.watcher.on_command({"graph": True})
            robot.play_frame()

    frames(robot, 20)
    assert robot.watcher.graphs == []
    ask(60)
    ends = len(robot.recording.graph.endpoints)
    assert robot.watcher.graphs == [ends]
    for _ in range(2):
        robot.add(Process(Teleop))
        frames(robot, 2)
        ask(1)
        assert robot.watcher.graphs[1:] == [ends + 1]
    ask(60)
    assert robot.watcher.graphs[1:] == [ends + 1, ends + 2]


def test_a_step_pauses(robot):
    robot.step()
    assert robot.paused
    assert repr(robot) == "<Player at 0.05 s of 600 s, paused>"


def test_what_is_no_speed_is_refused_and_changes_nothing(robot):
    with pytest.raises(ValueError, match=r"speed must be a number greater than 0, .*; it is -2\."):
        robot.speed = -2
    assert robot.speed == 1.0
    assert repr(robot) == "<Player at 0.00 s of 600 s, playing at speed 1>"


def test_stopping_ends_it_where_it_is(robot):
    frames(robot, 30)
    robot.stop()
    ended = robot.recording.ended
    assert (ended.reason, ended.detail) == ("interrupted", "The user stopped it.")
    assert 0.3 < ended.stamp == robot.recording.stamp < 3
    assert robot.result() is robot.recording
    robot.stop()
    robot.play_frame()
    assert robot.recording.ended == ended


def test_the_result_is_the_rest_at_once():
    made = playing.player(mains.classic, world="room", seconds=20, speed=0.01)
    frames(made, 3)
    made.pause()
    assert made.result().digest == run(mains.classic, world="room", seconds=20, quiet=True).digest


def test_another_play_stops_the_one_before():
    first = playing.player(mains.classic, seconds=600)
    second = playing.player(mains.classic, seconds=600)
    assert first.recording.ended.detail == "Another play has begun."
    assert not second.over
    with pytest.raises(ValueError):
        play(mains.classic, seconds=-1)
    with pytest.raises(ValueError):
        play(mains.classic, speed=0)
    assert not second.over  # it ends only for one that begins
    second.stop()


def test_what_until_raises_ends_it_and_reaches_who_asks():
    made = playing.player(mains.Counter, seconds=5, until=lambda recording: 1 / 0)
    playing.to_the_end(made)
    assert made.recording.ended[::2] == ("interrupted", "`until` raised ZeroDivisionError: division by zero")
    with pytest.raises(ZeroDivisionError):
        made.result()
    assert active() is None and RunningProgram.loaded is None


def test_until_can_stop_it_but_not_move_it_on():
    refused = []

    def until(recording):
        try:
            made.result()
        except RuntimeError as error:
            refused.append(str(error))
        made.stop()

    made = playing.player(mains.Counter, seconds=5, until=until)
    playing.to_the_end(made)
    words = "A player can't be advanced from inside its own run; let `until` return True."
    assert refused[0] == words
    assert made.recording.ended[::2] == ("interrupted", "The user stopped it.")


def test_what_cannot_be_played_is_refused_by_name():
    with pytest.raises(TypeError) as caught:
        play(3)
    words = "play() takes Node classes, functions that return a node, or main() functions; this is 3."
    assert str(caught.value) == words

    def plays():
        play(mains.Counter)

    (error,) = run(plays, seconds=1, quiet=True).errors
    assert error.text == "play() can't start another run here: this is a node of a run in progress."


# -- the picture -----------------------------------------------------------------------------------------


def test_the_picture_sees_the_robot_go(clock):
    made = playing.player(mains_driver, world="yard", seconds=3, clock=clock)
    watcher = playing.watched(made)
    recording = playing.to_the_end(made)
    stamps = [stamp for stamp, _, _ in watcher.frames]
    assert stamps == sorted(set(stamps)) and len(stamps) > 60
    assert watcher.frames[-1][1][0][0] > watcher.frames[0][1][0][0] + 0.5
    assert watcher.frames[-1][2].ranges.shape == (360,)
    state = watcher.states[-1]
    assert (state["ended"], state["paused"], state["speed"]) == (["time", "All 3 s were run."], False, 1.0)
    rates = {topic["name"]: (topic["type"], topic["rate"]) for topic in state["topics"]}
    assert rates["/scan"] == ("sensor_msgs/msg/LaserScan", pytest.approx(20, rel=0.1))
    assert rates["/cmd_vel"] == ("geometry_msgs/msg/Twist", pytest.approx(10, rel=0.1))
    assert 0.5 < watcher.states[-2]["pace"] < 2
    assert (watcher.finished, watcher.on_command) == ([recording], None)


def mains_driver():
    """A program that drives straight on, ten times a second."""
    import rclpy
    from geometry_msgs.msg import Twist

    rclpy.init()
    node = rclpy.create_node("driver")
    publisher, twist = node.create_publisher(Twist, "cmd_vel", 10), Twist()
    twist.linear.x = 0.3
    node.create_timer(0.1, lambda: publisher.publish(twist))
    rclpy.spin(node)


def test_states_come_four_times_a_second_and_when_something_changed(robot, clock):
    frames(robot, 60)
    begin, count = clock.now, len(robot.watcher.states)
    frames(robot, 60)
    assert len(robot.watcher.states) - count <= 4 * (clock.now - begin) + 1
    count = len(robot.watcher.states)
    robot.watcher.on_command({"pause": True})
    robot.play_frame()
    robot.watcher.on_command({"speed": 3.0})
    robot.play_frame()
    changes = robot.watcher.states[count:]
    assert [(state["paused"], state["speed"]) for state in changes] == [(True, 1.0), (True, 3.0)]
    assert changes[-1]["pace"] == 0.0


def test_buttons_of_the_picture(robot):
    tell = robot.watcher.on_command
    tell({"pause": True})
    robot.play_frame()
    assert robot.paused
    tell({"step": True})
    tell({"step": True})
    robot.play_frame()
    assert robot.recording.stamp == pytest.approx(0.1)
    tell({"pause": False})
    tell({"speed": 8.0})
    robot.play_frame()
    assert (robot.paused, robot.speed) == (False, 8.0)
    for nonsense in ({"speed": math.nan}, {"speed": "fast"}, {"drive": 3}, {"drive": [1]}, {"fly": True}):
        tell(nonsense)
    robot.play_frame()
    assert not robot.over
    thread = threading.Thread(target=tell, args=({"stop": True},))
    thread.start()
    thread.join()
    robot.play_frame()
    assert robot.recording.ended[::2] == ("interrupted", "The user stopped it.")


def test_what_keeps_it_from_working_ends_it(robot, monkeypatch):
    from sim.ros import session

    def fails():
        raise OSError("no streams")

    robot.play_frame()
    with monkeypatch.context() as patched:
        patched.setattr(session, "student_streams", fails)
        robot.play_frame()
    assert robot.over
    with pytest.raises(OSError, match=r"^no streams$"):
        robot.result()


def in_another_thread(act):
    """What it gives or raises there."""

    def attempt():
        try:
            reported.append(act())
        except RuntimeError as error:
            reported.append(str(error))

    reported = []
    thread = threading.Thread(target=attempt)
    thread.start()
    thread.join(PATIENCE)
    return reported[0]


def test_another_thread_can_stop_it_but_not_move_it(robot):
    words = "A player continues only in the thread that called play(); here, stop it."
    robot.play_frame()
    assert in_another_thread(robot.step) == in_another_thread(robot.result) == words
    robot.resume()
    robot.play_frame()
    assert not robot.over
    in_another_thread(lambda: robot.stop("Time is up."))
    robot.play_frame()
    assert robot.recording.ended[::2] == ("interrupted", "Time is up.")
    assert len(robot.watcher.finished) == 1


def test_a_play_that_another_thread_replaces_lets_go_of_everything(robot):
    robot.play_frame()
    usual = run(mains.classic, world="room", seconds=2, quiet=True)
    in_another_thread(lambda: playing.player(mains.classic, seconds=2).stop())
    robot.play_frame()
    assert robot.recording.ended[::2] == ("interrupted", "Another play has begun.")
    assert len(robot.watcher.finished) == 1
    assert run(mains.classic, world="room", seconds=2, quiet=True).digest == usual.digest


@pytest.mark.parametrize("method", ["frame", "state", "finish"])
def test_a_picture_that_fails_changes_nothing(method, capsys):
    def fails(*arguments):
        raise OSError("no screen")

    usual = run(mains.classic, world="room", seconds=2, quiet=True)
    made = playing.player(mains.classic, world="room", seconds=2)
    watcher = playing.Watcher()
    setattr(watcher, method, fails)
    playing.watched(made, watcher)
    assert playing.to_the_end(made).digest == usual.digest
    assert capsys.readouterr() == ("There is no picture any more: OSError: no screen\n", "")


def test_without_a_world_there_are_topics_and_no_frames():
    made = playing.player(mains.Counter, seconds=3)
    watcher = playing.watched(made)
    playing.to_the_end(made)
    assert watcher.frames == []
    assert [topic["name"] for topic in watcher.states[-1]["topics"]] == ["/count"]
    assert len(watcher.finished) == 1


def test_a_robot_that_never_moved_on_leaves_no_replay():
    made = playing.player(world="yard")
    watcher = playing.watched(made)
    made.stop()
    assert (watcher.finished, watcher.closed) == ([], 1)


# -- interrupts ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("program", [interrupts.Busy, interrupts.SwallowsAll, interrupts.restarts_itself])
def test_an_interrupt_ends_a_script_that_plays(interrupt, program):
    with pytest.raises(KeyboardInterrupt) as caught:
        play(program, world="yard", seconds=900_000, speed=5, until=interrupt, quiet=True)
    assert str(caught.value) == "The run was interrupted."


def test_python_can_end_while_something_plays():
    program = (
        "import asyncio\n"
        "from sim import play\n"
        "from tests.students.engine import interrupts\n"
        "async def main():\n"
        "    global player\n"
        "    player = play(interrupts.cleans_up, world='yard', seconds=900_000)\n"
        "    while not player.nodes:\n"
        "        await asyncio.sleep(0.01)\n"
        "loop = asyncio.new_event_loop()\n"
        "loop.run_until_complete(main())\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=PATIENCE)
    assert (done.returncode, done.stdout) == (0, "goodbye\n")


# -- nothing is left -------------------------------------------------------------------------------------


@pytest.mark.soak
def test_fifty_plays_leave_nothing():
    def some(count):
        for index in range(count):
            made = playing.player(Teleop, mains.classic, world="yard", seconds=600)
            watcher = playing.watched(made)
            watcher.on_command({"drive": [1.0, 0.0]})
            frames(made, 3)
            if index % 2:
                made.stop()
        playing.player(seconds=1).result()
        gc.collect()

    some(5)
    before, nodes = footprint(), live_nodes()
    some(50)
    assert live_nodes() == nodes
    assert nothing_is_left(before)


def test_while_it_plays_the_garbage_collector_leaves_the_users_objects_alone():
    """And those that other runs meanwhile create are collected; at its end all are the collector's again."""
    assert ProcessState.unfinished == 0, "a test before has left a player that waits"
    nodes, made = live_nodes(), playing.player(mains.Counter, seconds=600)
    frames(made, 2)
    aside, playing_nodes = gc.get_freeze_count(), live_nodes()
    run(mains.classic, seconds=1, quiet=True)
    assert live_nodes() == playing_nodes
    assert gc.get_freeze_count() > 0.9 * aside > 9_000
    frames(made, 2)
    made.stop()
    assert gc.get_freeze_count() == 0
    assert live_nodes() == nodes


# -- driving by hand -------------------------------------------------------------------------------------


def drive(made, forward, left):
    made.watcher.on_command({"drive": [forward, left]})


def test_what_is_held_becomes_commands_and_a_zero_once(robot, clock):
    drive(robot, 0.0, 0.0)
    frames(robot, 30)
    assert sent(robot) == []
    for _ in range(30):
        drive(robot, 1.0, -0.5)
        robot.play_frame()
    held = [stamp for stamp, *_ in robot.recording.messages("/cmd_vel")]
    assert held == pytest.approx([held[0] + index / RATE for index in range(len(held))])
    assert set(sent(robot)) == {(0.4, -0.5)} and len(held) > 10
    drive(robot, 0.0, 0.0)
    frames(robot, 30)
    assert sent(robot)[len(held) :] == [(0.0, 0.0)]
    assert robot.recording.path[-1].x > robot.recording.path[0].x + 0.2
    assert robot.recording.graph.nodes == ["/robot", "/teleop"]


def test_who_drives_by_hand_sends_what_the_robot_takes(clock):
    yard = World.load("yard")
    stamped = replace(yard, robot=replace(yard.robot, stamped=True))
    made = playing.player(world=stamped, seconds=600, clock=clock)
    made.watcher = playing.watched(made)
    for _ in range(20):
        drive(made, 1.0, 0.5)
        made.play_frame()
    made.stop()
    commands = [received.message.twist for received in made.recording.messages("/cmd_vel")]
    assert {(command.linear.x, command.angular.z) for command in commands} == {(0.4, 0.5)}


def test_keys_drive_the_first_turtle_and_the_picture_gets_its_line(clock):
    made = playing.player(world="turtlesim", seconds=600, clock=clock)
    made.watcher = playing.watched(made)
    for _ in range(40):
        drive(made, 1.0, 0.5)
        made.play_frame()
    state = made.watcher.states[-1]
    made.stop()
    assert set(sent(made, "/turtle1/cmd_vel")) == {(2.0, 1.0)}
    assert list(dict(state["numbers"])) == ["x", "y", "yaw", "command v", "command ω"]
    assert dict(state["numbers"])["command ω"] == "1.00 rad/s"
    assert state["drawing"].strokes == made.recording.drawing.strokes


def test_a_page_that_is_gone_lets_go(robot, clock):
    robot.play_frame()
    drive(robot, 1.0, 0.0)
    frames(robot, 60)
    assert set(sent(robot)[:-1]) == {(0.4, 0.0)} and sent(robot)[-1] == (0.0, 0.0)


def test_a_teleop_of_the_users_is_the_one_that_drives(clock):
    teleop = Process(Teleop, remappings=[("cmd_vel", "/joy_vel")], parameters={"speed": 0.2, "turn": 2.0})
    made = playing.player(teleop, world="yard", seconds=600, clock=clock)
    made.watcher = playing.watched(made)
    for _ in range(20):
        drive(made, -1.0, 1.0)
        made.play_frame()
    made.stop()
    assert set(sent(made, "/joy_vel")) == {(-0.2, 2.0)}
    assert sent(made) == []
    assert made.recording.graph.nodes == ["/robot", "/teleop"]


def test_where_there_is_no_robot_nothing_is_started(clock):
    made = playing.player(mains.Counter, seconds=600, clock=clock)
    made.watcher = playing.watched(made)
    for _ in range(20):
        drive(made, 1.0, 0.0)
        made.play_frame()
    made.stop()
    assert made.recording.graph.nodes == ["/counter"]


def test_a_teleop_no_one_uses_says_nothing_and_changes_nothing():
    usual = run(Teleop, world="yard", seconds=5, quiet=True)
    assert usual.messages("/cmd_vel") == []
    made = playing.player(Teleop, world="yard", seconds=5)
    playing.watched(made)
    assert playing.to_the_end(made).digest == usual.digest


def test_a_teleop_in_real_time_says_nothing():
    """On a robot it waits for a user of `play`, whom there is none."""
    import rclpy

    rclpy.init()
    node, received, ticks = Teleop(), [], []
    node.create_subscription(Twist, "cmd_vel", received.append, 10)
    node.create_timer(1 / RATE, lambda: ticks.append(1))  # as often as it would send
    while len(ticks) < 10:
        rclpy.spin_once(node)
    node.destroy_node()
    rclpy.shutdown()
    assert received == []
