"""python -m sim: an ordinary ROS 2 process that other processes see and drive, and that survives them."""

import signal
import time

import pytest

from tests.patience import until
from tests.sim.standalone.programs import REPOSITORY, ended, finish, robot

OFFER = """\
World 'yard' in real time, ROS domain {domain}, this machine only.
  takes /cmd_vel  [geometry_msgs/msg/Twist]
  gives /bumper  [std_msgs/msg/Bool]
  gives /clock  [rosgraph_msgs/msg/Clock]
  gives /joint_states  [sensor_msgs/msg/JointState]
  gives /odom  [nav_msgs/msg/Odometry]
  gives /scan  [sensor_msgs/msg/LaserScan]
  gives /tf  [tf2_msgs/msg/TFMessage]
  gives /tf_static  [tf2_msgs/msg/TFMessage]

In another terminal:
  export ROS_DOMAIN_ID={domain} ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST
  python my_node.py        # or ros2 topic list, as in JupyterLab's terminals

"""
NO_NUMBER = (
    "[ERROR] [robot]: Velocity commands are finite numbers; this one was {}: check how it was calculated."
)


@pytest.fixture(scope="module")
def yard():
    """One robot for the tests in which clients come, misbehave and go: it must outlive them all."""
    with robot("--world", "yard", "--headless") as running:
        yield running


def alive(running):
    """Whether someone who listens now receives new scans."""
    return running.listen()["frame"] == "base_scan"


def test_it_prints_its_topics_and_how_to_connect(yard):
    assert yard.offer == OFFER.format(domain=yard.domain)


def test_other_processes_receive_its_messages_and_drive_it(yard):
    before = yard.listen()["x"]
    with yard.beside("drive"):
        yard.receive_until(lambda received: received["x"] > before + 0.5)
    yard.receive_until(lambda received: received["v"] == 0.0)  # no node commands it any more


def test_its_parameters_can_be_requested(yard):
    assert "use_sim_time" in finish(yard.client("parameters"))


AT_NIGHT = "huge", "wrong_type", "impostor", "crowd"


@pytest.mark.parametrize("client", [
    *("flood", "broken_bytes"), *(pytest.param(client, marks=pytest.mark.soak) for client in AT_NIGHT),
])  # fmt: skip
def test_it_continues_while_a_client_misbehaves(yard, client):
    with yard.beside(client):
        assert alive(yard)
    assert alive(yard)


@pytest.mark.soak
def test_it_continues_with_clients_that_are_killed_or_stopped(yard):
    with yard.beside("crowd") as crowd:
        for name in ("flood", "crowd"):
            with yard.beside(name) as client:
                client.kill()
        crowd.send_signal(signal.SIGSTOP)  # its buffers fill up
        assert [alive(yard) for _ in range(10)] == [True] * 10
    assert alive(yard)


@pytest.mark.soak
def test_it_does_not_grow(yard):
    yard.listen()
    before = yard.memory()
    with yard.beside("flood") as flood:
        assert [flood.stdout.readline() for _ in range(5)][-1] == "50000\n"
        assert alive(yard)
    assert yard.memory() - before < 8000  # kB; a message kept for each command would be 20 MB


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_it_cleanly(number):
    with robot("--headless") as running:
        assert alive(running)
        assert running.stop(number) == (0, "")


def test_commands_with_nan_are_reported_and_ignored():
    with robot("--world", "yard", "--headless") as running:
        expected = [NO_NUMBER.format("nan m/s and 0.0 rad/s"), NO_NUMBER.format("0.1 m/s and inf rad/s")]
        begin = time.monotonic()
        for name, line in zip(("no_numbers", "infinite"), expected, strict=True):
            with running.beside(name):
                until(lambda line=line: line in running.stderr, line)
        assert running.listen()["x"] == 0.0
        status, stderr = running.stop()
    lines = stderr.splitlines()
    assert status == 0
    assert set(lines) == set(expected)
    assert len(lines) <= 1 + time.monotonic() - begin  # once a second


def test_other_robots_and_machines_are_stand_alone_programs_too():
    with robot("--world", "convoy", "--headless") as running:
        assert "  takes /leader/cmd_vel  [geometry_msgs/msg/Twist]\n" in running.offer
        assert finish(running.client("leader"))["way"] > 0.1
        assert running.stop() == (0, "")
    with robot("--world", "joint", "--headless") as running:
        assert "  gives /joint_states  [sensor_msgs/msg/JointState]\n" in running.offer
        assert finish(running.client("joint"))["angle"] == pytest.approx(0.5, abs=0.01)
        assert running.stop() == (0, "")


def test_it_receives_stamped_commands_if_the_world_requires_them(tmp_path):
    world = tmp_path / "stamped.toml"
    text = (REPOSITORY / "sim/world/worlds/yard.toml").read_text(encoding="utf-8")
    world.write_text(text.replace("[card]", "[robot]\nstamped = true\n[card]"), encoding="utf-8")
    with robot("--headless", "--world", str(world)) as running:
        assert "  takes /cmd_vel  [geometry_msgs/msg/TwistStamped]\n" in running.offer
        with running.beside("drive_stamped"):
            running.receive_until(lambda received: received["x"] > 0.3)
        assert running.stop() == (0, "")


def test_a_world_may_be_made_from_a_seed():
    with robot("--world", "maze", "--world-seed", "7", "--headless") as running:
        assert running.offer.startswith("World 'maze_7' in real time, ROS domain ")
        assert running.stop() == (0, "")


@pytest.mark.parametrize("arguments, sentence", [
    (["--world", "moon"], "There is no world 'moon'. The worlds are "),
    (["--world", "/no/w.toml"], "Cannot read /no/w.toml (No such file or directory); check the path."),
    (["--world", "moon", "--world-seed", "7"],
     "There is no kind of world 'moon' to generate. There are room, maze, clutter, warehouse."),
    (["--domain", "233"],
     "python -m sim: argument --domain: a ROS domain is a whole number from 0 to 232; this is '233'."),
    (["--domain", "one"],
     "python -m sim: argument --domain: a ROS domain is a whole number from 0 to 232; this is 'one'."),
    (["--seed", "-1"], "python -m sim: argument --seed: write a whole number, 0 or more; this is '-1'."),
    (["--port", "70000"],
     "python -m sim: argument --port: a port is a whole number from 0 to 65535; this is '70000'."),
    (["--wrld", "yard"], "python -m sim: unrecognized arguments: --wrld yard"),
], ids=lambda value: value[1] if isinstance(value, list) else "")  # fmt: skip
def test_invalid_arguments_are_reported_in_a_sentence(arguments, sentence):
    status, stdout, stderr = ended("--headless", *arguments)
    assert (status, stdout) == (2, "")
    assert stderr.startswith(sentence)
    assert len(stderr.splitlines()) == 1


def test_a_world_that_the_robot_does_not_fit_into_is_refused(tmp_path):
    world = tmp_path / "tight.toml"
    text = (REPOSITORY / "sim/world/worlds/yard.toml").read_text(encoding="utf-8")
    circle = "[[circles]]\nx = 0\ny = 0\nradius = 1\n[card]"
    world.write_text(text.replace("[card]", circle), encoding="utf-8")
    assert ended("--headless", "--world", str(world)) == (2, "", (
        "World 'tight': the robot (radius 0.1 m) does not fit at the start (0, 0), where a circle is; "
        "move the start or the circle.\n"
    ))  # fmt: skip
