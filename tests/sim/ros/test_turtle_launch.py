"""Launch files of the official tutorials: turtlesims in namespaces, mimic, and tf2's programs."""

import math

import pytest

from sim import Process, executable, run
from sim.ros.launching import files
from tests.sim.ros.evidence import logged
from tests.students.engine import turtles

BEGIN = """\
import pathlib
from launch import LaunchDescription
from launch.actions import *
from launch.event_handlers import *
from launch.events import Shutdown
from launch.substitutions import *
from launch_ros.actions import Node


HERE = pathlib.Path(__file__).parent


def generate_launch_description():{words}
    return LaunchDescription([
"""
MIMIC = """
        Node(package="turtlesim", namespace="turtlesim1", executable="turtlesim_node", name="sim"),
        Node(
            package="turtlesim", namespace="turtlesim2", executable="turtlesim_node", name="sim",
            parameters=[{"background_r": 200}],
        ),
        Node(
            package="turtlesim", executable="mimic", name="mimic",
            remappings=[
                ("/input/pose", "/turtlesim1/turtle1/pose"),
                ("/output/cmd_vel", "/turtlesim2/turtle1/cmd_vel"),
            ],
        ),
"""
TURTLE = """
        DeclareLaunchArgument("target_frame", default_value="turtle1"),
        Node(package="turtlesim", executable="turtlesim_node", name="sim"),
        Node(executable=f"{HERE}/broadcaster.py", name="tell1", parameters=[{"turtlename": "turtle1"}]),
        Node(executable=f"{HERE}/broadcaster.py", name="tell2", parameters=[{"turtlename": "turtle2"}]),
        Node(
            executable=f"{HERE}/follower.py", name="listener",
            parameters=[{"target_frame": LaunchConfiguration("target_frame")}],
        ),
"""
CARROT = """
        IncludeLaunchDescription(
            f"{HERE}/turtle.launch.py", launch_arguments={"target_frame": "carrot1"}.items()
        ),
        Node(
            package="tf2_ros", executable="static_transform_publisher",
            arguments=["--y", "2", "--frame-id", "turtle1", "--child-frame-id", "carrot1"],
        ),
        Node(package="tf2_ros", executable="tf2_echo", arguments=["turtle1", "carrot1"]),
"""
EVENTS = """
        DeclareLaunchArgument("space", default_value="turtlesim1"),
        sim,
        RegisterEventHandler(OnProcessStart(target_action=sim, on_start=[LogInfo(msg="It begins"), spawn])),
        RegisterEventHandler(OnProcessIO(
            target_action=spawn,
            on_stdout=lambda event: LogInfo(msg=f"It says {event.text.decode().strip()}")),
        ),
        RegisterEventHandler(OnProcessIO(target_action=sim, on_stderr=of_turtle2)),
        RegisterEventHandler(OnExecutionComplete(
            target_action=spawn, on_completion=[LogInfo(msg="It is there"), recolour, late],
        )),
        RegisterEventHandler(OnShutdown(
            on_shutdown=[LogInfo(msg=["It ends: ", LocalSubstitution("event.reason")])],
        )),
"""
# As the tutorial on event handlers has them, before the list.
WORDS = """
    def of_turtle2(event):
        return LogInfo(msg=event.text.decode().strip()) if b"turtle2" in event.text else None

    space = LaunchConfiguration("space")
    sim = Node(package="turtlesim", namespace=space, executable="turtlesim_node", name="sim")
    ros2 = FindExecutable(name="ros2")
    request = " turtlesim/srv/Spawn '{x: 2, y: 2, theta: 0.2}'"
    spawn = ExecuteProcess(cmd=[[ros2, " service call ", space, "/spawn", request]], name="spawn", shell=True)
    recolour = ExecuteProcess(cmd=[[ros2, " param set ", space, "/sim background_r 120"]], shell=True)
    late = TimerAction(period=2.0, actions=[EmitEvent(event=Shutdown(reason="enough"))])
"""
TAKEN = "The world's own turtlesim ends: this one has its pond from here on."
ONE_MORE = "One more turtlesim: it has a pond of its own, which no picture shows."


def file(folder, name, entities, words=""):
    """A launch file, beside the tutorials' programs."""
    for one in ("broadcaster", "driver", "follower"):
        (folder / f"{one}.py").write_text(f"from tests.students.engine.turtles import {one}\n\n{one}()\n")
    path = folder / name
    path.write_text(f"{BEGIN.replace('{words}', words)}{entities}    ])\n")
    return path


@pytest.fixture(scope="module")
def mimicked(tmp_path_factory):
    path = file(tmp_path_factory.mktemp("launch"), "mimic.launch.py", MIMIC)
    swims = Process(turtles.Driver, namespace="/turtlesim1")
    return run(path, swims, world="turtlesim", seconds=8, quiet=True)


def test_two_ponds_in_namespaces_and_a_turtle_that_moves_as_the_other_does(mimicked):
    assert (mimicked.errors, mimicked.ended.reason) == ([], "time")
    one, other = (mimicked.messages(f"/turtlesim{number}/turtle1/pose") for number in (1, 2))
    assert len(one) == len(other) == 500
    center = mimicked.path[0].x, mimicked.path[0].y + 2
    for received in (*one[100:], *other[100:]):
        assert math.dist((received.message.x, received.message.y), center) == pytest.approx(2.0, abs=0.05)
        assert received.message.angular_velocity == 1.0
    assert {each.sender for each in mimicked.messages("/turtlesim2/turtle1/cmd_vel")} == {"/mimic"}


def test_the_picture_shows_the_first_pond_and_the_other_has_its_own(mimicked):
    last = mimicked.messages("/turtlesim1/turtle1/pose")[-1].message
    assert mimicked.path[-1][1:3] == pytest.approx((last.x, last.y), abs=0.1)
    assert mimicked.drawing.ground == (69, 86, 255)
    colors = [mimicked.messages(f"/turtlesim{number}/turtle1/color_sensor")[0].message.r for number in (1, 2)]
    assert colors == [69, 200]
    texts = [line.text for line in mimicked.logs if line.node == "launch"]
    assert texts == [TAKEN, ONE_MORE]


def test_without_a_world_a_pond_is_there_and_no_picture(tmp_path):
    path = file(tmp_path, "mimic.launch.py", MIMIC)
    recording = run(path, seconds=0.1, quiet=True)
    assert [line.text for line in recording.logs if line.node == "launch"] == [ONE_MORE]
    assert recording.messages("/turtlesim1/turtle1/pose") and recording.errors == []


def test_a_follower_swims_to_the_target_argument(tmp_path):
    file(tmp_path, "turtle.launch.py", TURTLE)
    path = file(tmp_path, "carrot.launch.py", CARROT)
    recording = run(path, world="turtlesim", seconds=15, quiet=True)
    assert recording.errors == []
    assert recording.tracks["turtle2"][-1][1:3] == pytest.approx((5.544, 7.544), abs=0.01)
    assert "- Translation: [0.000, 2.000, 0.000]\n" in "".join(text for _, text in recording.prints)
    assert "Spawning turtle [turtle2] at x=[4.000000], y=[2.000000], theta=[0.000000]" in [
        text for _, text in logged(recording)
    ]


def test_the_world_s_pond_is_reset_when_another_program_takes_it_over():
    def late():
        import time

        time.sleep(3.0)
        executable("turtlesim", "turtlesim_node")()

    recording = run(turtles.Driver, late, world="turtlesim", seconds=3.1, quiet=True)
    assert recording.path[-1][1:3] == pytest.approx((5.544, 5.544), abs=0.01)
    assert TAKEN in [line.text for line in recording.logs]


def simulators(tmp_path, count):
    """A launch file with this many turtlesims, for a world that has one."""
    nodes = ["Node(package='turtlesim', executable='turtlesim_node')"]
    nodes += ["Node(package='turtlesim', executable='turtlesim_node', namespace='other')"]
    return file(tmp_path, "sims.launch.py", ", ".join(nodes[:count]))


@pytest.mark.parametrize("count", [1, 2])
def test_turtlesims_of_a_launch_file_beside_the_world_s_own_are_no_mistake(count, tmp_path):
    recording = run(simulators(tmp_path, count), world="turtlesim", seconds=3, quiet=True)
    assert [line.text for line in recording.logs if line.node == "launch"] == [TAKEN, ONE_MORE][:count]
    assert recording.errors == []


def test_the_event_handler_tutorial_gets_output_and_exits_of_programs(tmp_path):
    path = file(tmp_path, "events.launch.py", EVENTS, WORDS)
    recording = run(path, world="turtlesim", seconds=8, quiet=True)
    assert (recording.errors, recording.ended.stamp) == ([], 3.0)
    texts = [(line.stamp, line.text) for line in recording.logs if line.node == "launch.user"]
    request = "turtlesim.srv.Spawn_Request(x=2.0, y=2.0, theta=0.2, name='')"
    assert texts == [
        (0.0, "It begins"),
        (0.0, f"It says requester: making request: {request}"),
        (0.0, "It says "),
        (
            0.0,
            "[INFO] [0.000] [turtlesim1.sim]: Spawning turtle [turtle2] at x=[2.000000], "
            "y=[2.000000], theta=[0.200000]",
        ),
        (0.0, "It says response:"),
        (0.0, "It says turtlesim.srv.Spawn_Response(name='turtle2')"),
        (0.0, "It says "),
        (0.0, "It is there"),
        (2.0, "It ends: enough"),
    ]
    assert recording.drawing.ground == (120, 86, 255)


def test_the_bundled_launch_file_of_turtlesim_starts_two_ponds():
    recording = run("turtlesim multisim.launch.py", world="turtlesim", seconds=0.2, quiet=True)
    assert recording.errors == []
    ponds = {received.sender for received in recording.published if received.type == "turtlesim/msg/Pose"}
    assert ponds == {"/turtlesim1/turtlesim", "/turtlesim2/turtlesim"}


def test_an_installed_launch_file_takes_precedence_over_the_bundled_one(tmp_path, monkeypatch):
    share = tmp_path / "share"
    for folder in (share / "turtlesim", share / "ament_index/resource_index/packages"):
        folder.mkdir(parents=True)
    (share / "ament_index/resource_index/packages/turtlesim").touch()
    own = share / "turtlesim" / "multisim.launch.py"
    own.touch()
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    assert files.find_launch_file(["turtlesim", "multisim.launch.py", "a:=1"]) == (str(own), ["a:=1"])


def test_yaml_and_ctrl_c(tmp_path):
    path = tmp_path / "pond.launch.yaml"
    path.write_text(
        "launch:\n- node: {pkg: turtlesim, exec: turtlesim_node, namespace: one}\n"
        "- node: {pkg: turtlesim, exec: mimic}\n- timer: {period: 1.0, children: [{shutdown: {}}]}\n"
    )
    recording = run(path, world="turtlesim", seconds=5, quiet=True)
    texts = [line.text for line in recording.logs]
    assert [text for text in texts if "finished cleanly" in text] == [
        "process has finished cleanly [pid 1]",
        "process has finished cleanly [pid 2]",
    ]
    assert (recording.errors, recording.ended.stamp) == ([], 2.0)


@pytest.mark.parametrize(
    ("package", "name", "words"),
    [
        ("turtlesim", "turtle_teleop_key", "arrow keys drive turtle1 on the page of `ros2 run "),
        (
            "turtlesim",
            "turtlesim",
            "turtlesim has mimic, turtlesim_node, but no turtlesim. Did you mean turtle",
        ),
        ("tf2_ros", "tf2_monitor", "tf2_ros has static_transform_publisher, tf2_echo, but no tf2_monitor."),
    ],
)
def test_a_program_that_is_not_bundled_is_reported(tmp_path, package, name, words):
    path = file(tmp_path, "x.launch.py", f"Node(package={package!r}, executable={name!r})")
    (error,) = run(path, world="turtlesim", seconds=1, quiet=True).errors
    assert error.type == "ExecutableNotFound"
    assert error.text.startswith(f"No executable found: {words}")


def test_a_failing_program_of_the_course_has_died(tmp_path):
    path = file(tmp_path, "x.launch.py", 'Node(package="tf2_ros", executable="tf2_echo", arguments=["a"])')
    recording = run(path, seconds=2, quiet=True)
    assert any("process has died [pid 1, exit code 1, cmd" in line.text for line in recording.logs)
