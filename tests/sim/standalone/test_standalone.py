"""python -m sim: an ordinary ROS 2 process that other processes see and drive, and that survives them."""

import json
import signal

import pytest

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
  python my_node.py        # or, where ROS 2 is installed: ros2 topic list

"""
NO_NUMBER = (
    "[ERROR] [robot]: Velocity commands are finite numbers; this one was {}: check how it was worked out."
)


@pytest.fixture(scope="module")
def yard():
    """One robot for the tests in which clients come, misbehave and go: it must outlive them all."""
    with robot("--world", "yard", "--headless") as running:
        yield running


def alive(received):
    """Whether a listener heard fresh scans, about 20 a second; on a busy machine they may be fewer."""
    return 2 < received["rate"] < 30 and received["age"] < 2 and received["frame"] == "base_scan"


def test_it_prints_its_topics_and_how_to_connect(yard):
    assert yard.offer == OFFER.format(domain=yard.domain)


def test_other_processes_receive_its_messages_and_drive_it(yard):
    driver = yard.client("drive", 4)
    assert alive(yard.listen())
    finish(driver)
    after = yard.listen()
    assert alive(after)
    assert after["x"] > 0.5
    assert after["v"] == 0.0  # nobody commands any more


def test_its_parameters_can_be_requested(yard):
    assert "use_sim_time" in json.loads(finish(yard.client("parameters", 1)))


AT_NIGHT = "huge", "wrong_type", "impostor", "crowd"


@pytest.mark.parametrize("client", [
    *("flood", "broken_bytes"), *(pytest.param(client, marks=pytest.mark.soak) for client in AT_NIGHT),
])  # fmt: skip
def test_it_continues_while_a_client_misbehaves(yard, client):
    misbehaving = yard.client(client, 4)
    assert alive(yard.listen())
    finish(misbehaving)
    assert alive(yard.listen(1))


@pytest.mark.soak
def test_it_continues_with_clients_that_are_killed_or_stopped(yard):
    clients = [yard.client(name, 60) for name in ("flood", "crowd", "listen", "crowd")]
    for crowd in clients[1::2]:
        crowd.stdout.readline()  # it is there
    clients[1].kill()
    clients[0].kill()
    clients[2].kill()
    clients[3].send_signal(signal.SIGSTOP)  # its buffers fill up
    assert alive(yard.listen(4))
    clients[3].kill()
    for client in clients:
        client.communicate()
    assert alive(yard.listen(1))


@pytest.mark.soak
def test_it_does_not_grow(yard):
    yard.listen(1)
    before = yard.memory()
    flood = yard.client("flood", 8)
    assert alive(yard.listen(4))
    finish(flood)
    assert yard.memory() - before < 8000  # kB; a message kept for each command would be 20 MB


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_it_cleanly(number):
    with robot("--headless") as running:
        assert alive(running.listen(1))
        assert running.stop(number) == (0, "")


def test_commands_with_nan_are_reported_and_ignored():
    with robot("--world", "yard", "--headless") as running:
        for name in ("no_numbers", "infinite"):
            finish(running.client(name, 2))
        assert running.listen(1)["x"] == 0.0
        status, stderr = running.stop()
    lines = stderr.splitlines()
    assert status == 0
    expected = {NO_NUMBER.format("nan m/s and 0.0 rad/s"), NO_NUMBER.format("0.1 m/s and inf rad/s")}
    assert set(lines) == expected
    assert len(lines) < 10  # once a second


def test_other_robots_and_machines_are_stand_alone_programs_too():
    with robot("--world", "convoy", "--headless") as running:
        assert "  takes /leader/cmd_vel  [geometry_msgs/msg/Twist]\n" in running.offer
        assert json.loads(finish(running.client("leader", 30)))["way"] > 0.1
        assert running.stop() == (0, "")
    with robot("--world", "joint", "--headless") as running:
        assert "  gives /joint_states  [sensor_msgs/msg/JointState]\n" in running.offer
        assert json.loads(finish(running.client("joint", 30)))["angle"] == pytest.approx(0.5, abs=0.01)
        assert running.stop() == (0, "")


def test_it_receives_stamped_commands_if_the_world_requires_them(tmp_path):
    world = tmp_path / "stamped.toml"
    text = (REPOSITORY / "sim/world/worlds/yard.toml").read_text(encoding="utf-8")
    world.write_text(text.replace("[card]", "[robot]\nstamped = true\n[card]"), encoding="utf-8")
    with robot("--headless", "--world", str(world)) as running:
        assert "  takes /cmd_vel  [geometry_msgs/msg/TwistStamped]\n" in running.offer
        finish(running.client("drive_stamped", 2))
        assert running.listen()["x"] > 0.3
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
    (["--domain", "102"],
     "python -m sim: argument --domain: a ROS domain is a whole number from 0 to 101; this is '102'."),
    (["--domain", "one"],
     "python -m sim: argument --domain: a ROS domain is a whole number from 0 to 101; this is 'one'."),
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
