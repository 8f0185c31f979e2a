"""robot_state_publisher and joint_state_publisher: from a URDF to the frames of a robot, in runs."""

import math

import pytest
import rclpy
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.parameter_client import AsyncParameterClient
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.time import Time
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from tf2_ros import Buffer, TransformException, TransformListener

from sim import Process, executable, run

ARM = """\
<robot name="arm">
  <link name="base"/><link name="upper"/><link name="lower"/><link name="tool"/><link name="finger"/>
  <link name="camera"/><link name="free"/>
  <joint name="shoulder" type="revolute">
    <parent link="base"/><child link="upper"/><origin xyz="0 0 1" rpy="0 0 1.5707963267948966"/>
    <axis xyz="0 0 2"/><limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
  <joint name="elbow" type="continuous">
    <parent link="upper"/><child link="lower"/><origin xyz="0.5 0 0"/><axis xyz="0 1 0"/>
  </joint>
  <joint name="slide" type="prismatic">
    <parent link="lower"/><child link="tool"/><origin rpy="0 0 1.5707963267948966"/>
    <axis xyz="2 0 0"/><limit lower="0.25" upper="0.75" effort="1" velocity="1"/>
    <safety_controller soft_lower_limit="0.3" soft_upper_limit="0.9"/>
  </joint>
  <joint name="grip" type="revolute">
    <parent link="tool"/><child link="finger"/><limit lower="0" upper="1" effort="1" velocity="1"/>
    <mimic joint="shoulder" multiplier="-2" offset="0.5"/>
  </joint>
  <joint name="mount" type="fixed">
    <parent link="tool"/><child link="camera"/><origin xyz="0 0 0.1"/>
  </joint>
  <joint name="loose" type="floating"><parent link="base"/><child link="free"/></joint>
</robot>
"""
ONE_JOINT = """\
<robot name="one"><link name="a"/><link name="b"/>
<joint name="j" type="{type}"><parent link="a"/><child link="{child}"/>{more}</joint></robot>
"""
STATES = "joint_state_publisher"
FRAMES = "robot_state_publisher"


def one_joint(kind: str, child: str = "b", more: str = "") -> str:
    return ONE_JOINT.format(type=kind, child=child, more=more)


def program(name: str, **parameters) -> Process:
    return Process(executable(name, name), parameters=parameters)


def arm(**parameters) -> Process:
    return program(FRAMES, robot_description=ARM, **parameters)


def angle(quaternion) -> float:
    return 2 * math.atan2(math.hypot(quaternion.x, quaternion.y, quaternion.z), quaternion.w)


class States(Node):
    """Publishes one joint state at 10 Hz."""

    names, positions = ("shoulder", "elbow", "slide"), (0.2, 0.5, 0.1)

    def __init__(self):
        super().__init__("states")
        self.publisher = self.create_publisher(JointState, "joint_states", 10)
        self.create_timer(0.1, self.send)

    def send(self):
        message = JointState(name=list(self.names), position=list(self.positions))
        message.header.stamp = self.get_clock().now().to_msg()
        self.publisher.publish(message)


class WithoutPositions(States):
    positions = ()


class WithTooFewPositions(States):
    positions = (0.1,)


class Looking(Node):
    """Looks up the pose of the camera after a second, and stores the description."""

    def __init__(self):
        super().__init__("looking")
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.create_subscription(String, "robot_description", self.on_description, latched)
        self.create_timer(1.0, self.look)

    def on_description(self, message):
        self.get_logger().info(f"{len(message.data)} characters")

    def look(self):
        try:
            found = self.buffer.lookup_transform("base", "camera", Time()).transform.translation
        except TransformException as error:
            self.get_logger().info(str(error))
        else:
            self.get_logger().info(f"{found.x:.3f} {found.y:.3f} {found.z:.3f}")


def lines(recording, node: str) -> list[str]:
    assert [error.says for error in recording.errors] == []
    return [line.text for line in recording.logs if line.node == node]


def transforms(recording, topic: str = "/tf") -> dict:
    """The last transform of each frame."""
    return {each.child_frame_id: each for m in recording.messages(topic) for each in m.message.transforms}


@pytest.fixture(scope="module")
def moved():
    return run(arm(), States, Looking, seconds=1.05, quiet=True)


def test_fixed_joints_are_static_and_floating_ones_have_no_transform(moved):
    assert set(transforms(moved, "/tf_static")) == {"camera"}
    assert transforms(moved, "/tf_static")["camera"].transform.translation.z == 0.1
    assert set(transforms(moved)) == {"upper", "lower", "tool", "finger"}


def test_joints_turn_and_slide_about_their_axes(moved):
    found = transforms(moved)
    assert found["upper"].header.frame_id == "base"
    assert found["upper"].transform.translation.z == 1.0
    assert angle(found["upper"].transform.rotation) == pytest.approx(math.pi / 2 + 0.2)
    assert found["lower"].transform.rotation.y == pytest.approx(math.sin(0.25))
    slid = found["tool"].transform.translation
    assert (slid.x, slid.y, slid.z) == pytest.approx((0.0, 0.1, 0.0))


def test_a_mimicking_joint_follows_the_other_one(moved):
    turned = transforms(moved)["finger"].transform.rotation
    assert (turned.x, turned.w) == pytest.approx((math.sin(0.05), math.cos(0.05)))


def test_frames_compose_to_the_pose_of_the_tool_and_the_description_is_latched(moved):
    assert lines(moved, "looking") == [f"{len(ARM)} characters", "-0.207 0.517 1.088"]
    assert lines(moved, FRAMES) == ["Robot initialized"]


def test_transforms_are_limited_in_frequency_unless_stamps_are_ignored():
    counts = [
        len(run(arm(publish_frequency=frequency, **more), States, seconds=2.05, quiet=True).messages("/tf"))
        for frequency, more in ((20.0, {}), (2.0, {}), (0.0, {}), (2.0, {"ignore_timestamp": True}))
    ]
    assert counts == [20, 4, 0, 20]


def test_a_prefix_comes_before_every_frame():
    recording = run(arm(frame_prefix="left/"), States, seconds=0.3, quiet=True)
    assert transforms(recording)["left/upper"].header.frame_id == "left/base"
    assert set(transforms(recording, "/tf_static")) == {"left/camera"}


@pytest.mark.parametrize(
    ("states", "line"),
    [
        (
            WithoutPositions,
            'Robot state publisher ignored a JointState message about joint(s) "shoulder"(,...) whose '
            "position member was empty.",
        ),
        (WithTooFewPositions, "Robot state publisher ignored an invalid JointState message"),
    ],
)
def test_an_incomplete_joint_state_is_ignored_with_upstreams_line(states, line):
    assert lines(run(arm(), states, seconds=0.15, quiet=True), FRAMES) == ["Robot initialized", line]


@pytest.mark.parametrize(
    ("description", "reason"),
    {
        "": "",
        "plain text": "The robot description is not XML: syntax error: line 1, column 0",
        "<sdf/>": "The robot description begins with <sdf>, not with <robot>",
        "<robot/>": "No root link found. The robot xml is not a valid tree.",
        "<robot><link/></robot>": "unnamed link found",
        '<robot><link name="a"/><link name="a"/></robot>': "link 'a' is not unique.",
        '<robot><link name="a"/><link name="b"/></robot>': "Two root links found: [a] and [b]",
        one_joint("spring", "b"): "Joint [j] has no known type [spring]",
        one_joint("revolute", "b"): "Joint [j] is of type REVOLUTE but it does not specify limits",
        one_joint("revolute", "b", '<limit lower="-1" upper="1" velocity="2"/>'): (
            "joint limit: no effort: the <limit> of joint [j] needs it"
        ),
        one_joint("continuous", "b", '<limit effort="2"/>'): (
            "joint limit: no velocity: the <limit> of joint [j] needs it"
        ),
        one_joint("prismatic", "b", '<limit upper="1 m" effort="2" velocity="2"/>'): (
            "upper of joint [j] is '1 m', not a number"
        ),
        one_joint("fixed", "", ""): "no child link name specified for joint [j]",
        one_joint("fixed", "c"): "child link [c] of joint [j] not found",
        one_joint("fixed", "a"): "link [a] is its own ancestor",
        one_joint("fixed", "b", '<origin xyz="1 2"/>'): "xyz of joint [j] is '1 2', not three numbers",
        one_joint("fixed", "b", '<origin rpy="0 0 pi"/>'): "rpy of joint [j] is 'pi', not a number",
        one_joint("continuous", "b", '<axis xyz="0 0 0"/>'): "The axis of joint [j] has no direction",
        one_joint("continuous", "b", "<mimic/>"): "joint mimic: no mimic joint specified for joint [j]",
    }.items(),
)
def test_an_invalid_description_ends_the_program_with_its_reason(description, reason):
    recording = run(program(FRAMES, robot_description=description), seconds=1, quiet=True)
    (error,) = recording.errors
    level, last = ("ERROR", reason) if reason else ("FATAL", "robot_description parameter must not be empty")
    assert [(line.level, line.text) for line in recording.logs] == [(level, last)]
    expected = "Unable to initialize urdf::model from robot description" if reason else last
    assert (error.type, error.text) == ("RuntimeError", expected)


def test_an_invalid_frequency_ends_the_program():
    (error,) = run(arm(publish_frequency=2000.0), seconds=1, quiet=True).errors
    assert error.text == "publish_frequency must be between 0 and 1000"


def test_a_file_may_be_named_in_place_of_the_parameter(tmp_path):
    path = tmp_path / "arm.urdf"
    path.write_text(ARM)
    recording = run(
        Process(executable(FRAMES, FRAMES), arguments=[str(path)]), States, seconds=0.25, quiet=True
    )
    assert lines(recording, FRAMES) == [
        "No robot_description parameter, but command-line argument available.  Assuming argument is name of "
        "URDF file.  This backwards compatibility fallback will be removed in the future.",
        "Robot initialized",
    ]
    assert "upper" in transforms(recording)
    (error,) = run(Process(executable(FRAMES, FRAMES), arguments=["no.urdf"]), seconds=1, quiet=True).errors
    assert error.text == "Failed to open URDF file: no.urdf: No such file or directory"


def change():
    """Replace the description twice, with text that is none and with another robot."""
    rclpy.init()
    node = rclpy.create_node("change")
    client = AsyncParameterClient(node, FRAMES)
    client.wait_for_services(5.0)
    other = one_joint("fixed", "b")
    for name, value in (
        ("robot_description", ""),
        ("robot_description", "<sdf/>"),
        ("publish_frequency", -1.0),
        ("robot_description", other),
    ):
        future = client.set_parameters([Parameter(name, value=value)])
        rclpy.spin_until_future_complete(node, future)
        (result,) = future.result().results
        node.get_logger().info(f"{result.successful} {result.reason}")
    rclpy.shutdown()


def test_the_description_can_be_replaced():
    recording = run(arm(), change, seconds=1, quiet=True)
    assert lines(recording, "change") == [
        "False Empty URDF is not allowed",
        "False Unable to initialize urdf::model from robot description",
        "False publish_frequency must be between 0.0 and 1000.0",
        "True ",
    ]
    assert len(recording.messages("/robot_description")[0].message.data) == len(ARM)
    assert set(transforms(recording, "/tf_static")) == {"camera", "b"}


def states(recording) -> list[dict[str, float]]:
    return [
        dict(zip(each.message.name, each.message.position, strict=True))
        for each in recording.messages("/joint_states")
    ]


def test_default_positions_are_zero_or_in_the_middle_of_the_limits():
    recording = run(arm(), program(STATES), seconds=1.05, quiet=True)
    found = states(recording)
    assert len(found) == 10
    assert found[-1] == {"shoulder": 0.0, "elbow": 0.0, "slide": 0.525, "grip": 0.5}
    assert lines(recording, STATES) == [
        "Waiting for robot_description to be published on the robot_description topic..."
    ]
    assert set(transforms(recording)) == {"upper", "lower", "tool", "finger"}


def test_parameters_set_positions_rates_and_dependencies():
    chosen = {"rate": 5, "zeros.shoulder": 0.25, "use_mimic_tags": False, "use_smallest_joint_limits": False}
    dependent = {"dependent_joints.elbow.parent": "shoulder", "dependent_joints.elbow.factor": 3.0}
    both = {"publish_default_velocities": True, "publish_default_efforts": True}
    recording = run(arm(), program(STATES, **chosen, **dependent, **both), seconds=1.05, quiet=True)
    assert states(recording)[-1] == {"shoulder": 0.25, "elbow": 0.75, "slide": 0.5, "grip": 0.0}
    last = recording.messages("/joint_states")[-1].message
    assert len(states(recording)) == 5
    assert (list(last.velocity), list(last.effort)) == ([0.0] * 4, [0.0] * 4)


def test_a_delta_moves_the_joints_between_their_limits():
    found = states(run(arm(), program(STATES, delta=0.5), seconds=1.05, quiet=True))
    assert [each["shoulder"] for each in found] == [0.5, 1.0, 1.0, 0.5, 0.0, -0.5, -1.0, -1.0, -0.5, 0.0]
    assert [each["elbow"] for each in found][5:8] == [3.0, -math.pi, 0.5 - math.pi]


class Source(States):
    names, positions = ("shoulder", "unknown"), (0.75, 1.0)

    def __init__(self):
        super().__init__()
        self.publisher = self.create_publisher(JointState, "other_states", 10)


def test_a_source_sets_positions():
    recording = run(arm(), program(STATES, source_list=["other_states"]), Source, seconds=1.05, quiet=True)
    assert states(recording)[-1]["shoulder"] == 0.75
    assert "unknown" not in states(recording)[-1]


@pytest.mark.parametrize(
    ("parameter", "text"),
    {
        "dependent_joints.elbow": "Invalid dependent_joint name 'elbow'",
        "dependent_joints.elbow.speed": "Invalid dependent_joint name 'speed' (allowed values are 'parent', "
        "'factor', 'offset')",
        "dependent_joints.elbow.factor": "All dependent_joints must at least have a parent",
    }.items(),
)
def test_an_invalid_dependency_is_refused(parameter, text):
    (error,) = run(program(STATES, **{parameter: 1.0}), seconds=1, quiet=True).errors
    assert (error.type, error.text) == ("ValueError", text)


@pytest.mark.parametrize(
    ("description", "line"),
    {
        "<sdf/>": 'URDF must have a "robot" tag',
        one_joint("revolute", "b"): 'Limits must be specified for joint "j" of type "revolute"',
        one_joint("revolute", "b", '<limit lower="0"/>'): '"upper" limit must be specified for '
        'joint "j" of type "revolute"',
        one_joint("revolute", "b", '<limit lower="x" upper="0"/>'): '"lower" limit must be a '
        'float for joint "j" of type "revolute"',
        "text": "syntax error: line 1, column 0",
    }.items(),
)
def test_a_description_without_limits_is_refused_with_upstreams_line(description, line):
    class Describing(Node):
        def __init__(self):
            super().__init__("describing")
            latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
            self.publisher = self.create_publisher(String, "robot_description", latched)
            self.publisher.publish(String(data=description))

    recording = run(program(STATES), Describing, seconds=0.5, quiet=True)
    assert lines(recording, STATES)[1:] == [line]


def test_joints_that_mimic_each_other_end_the_program(tmp_path):
    path = tmp_path / "cycle.urdf"
    path.write_text(
        '<robot name="cycle"><joint name="a" type="continuous"><mimic joint="b"/></joint>'
        '<joint name="b" type="continuous"><mimic joint="a"/></joint></robot>'
    )
    recording = run(Process(executable(STATES, STATES), arguments=[str(path)]), seconds=0.5, quiet=True)
    line = recording.logs[0]
    assert (line.level, line.text) == ("ERROR", "Found an infinite recursive mimic chain: ['a', 'b', 'a']")


def test_a_launch_file_gives_the_description_as_a_parameter(tmp_path):
    (tmp_path / "arm.urdf").write_text(ARM)
    path = tmp_path / "arm.launch.py"
    path.write_text(
        "from launch import LaunchDescription\n"
        "from launch.substitutions import Command\n"
        "from launch_ros.actions import Node\n"
        "from launch_ros.parameter_descriptions import ParameterValue\n\n\n"
        "def generate_launch_description():\n"
        f"    urdf = ParameterValue(Command(['cat ', '{tmp_path}/arm.urdf']), value_type=str)\n"
        f"    return LaunchDescription([\n"
        f"        Node(package='{FRAMES}', executable='{FRAMES}',"
        " parameters=[{'robot_description': urdf}]),\n"
        f"        Node(package='{STATES}', executable='{STATES}'),\n"
        "    ])\n"
    )
    recording = run(path, Looking, seconds=1.05, quiet=True)
    assert recording.errors == []
    assert set(transforms(recording)) == {"upper", "lower", "tool", "finger"}
