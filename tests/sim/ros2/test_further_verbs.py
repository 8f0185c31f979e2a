"""Further verbs of ros2: param delete, lifecycle list, service echo, interface proto, doctor hello, wtf."""

import time

import pytest
import rclpy
from example_interfaces.srv import AddTwoInts
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.lifecycle import LifecycleNode
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import qos_profile_system_default
from rclpy.service_introspection import ServiceIntrospectionState
from std_msgs.msg import Float64

from sim import run
from sim.ros2 import absent
from sim.ros2.cli_program import terminal
from sim.ros2.notebook import ros2
from sim.ros2.parser import COMMANDS, load_group
from sim.ros2.verbs import hello


class Camera(LifecycleNode):
    def __init__(self):
        super().__init__("camera")


class Wheel(Node):
    def __init__(self):
        super().__init__("wheel")
        self.declare_parameter("radius", 0.1)
        self.declare_parameter("anything", Parameter.Type.STRING)
        self.declare_parameter("note", "old", ParameterDescriptor(dynamic_typing=True))


class Grows(Node):
    """Publishes 0, 1, 2, ... ten times a second."""

    def __init__(self):
        super().__init__("grows")
        publisher, values = self.create_publisher(Float64, "level", 10), iter(range(10_000))
        self.create_timer(0.1, lambda: publisher.publish(Float64(data=float(next(values)))))


class Adder(Node):
    """A service whose events are published, and a client that calls it once a second."""

    def __init__(self):
        super().__init__("adder")
        state = ServiceIntrospectionState.CONTENTS
        self.service = self.create_service(AddTwoInts, "add", self.add)
        self.service.configure_introspection(self.get_clock(), qos_profile_system_default, state)
        self.client = self.create_client(AddTwoInts, "add")
        self.create_timer(1.0, lambda: self.client.call_async(AddTwoInts.Request(a=2, b=3)))

    def add(self, request, response):
        response.sum = request.a + request.b
        return response


def output_of(command, node, seconds=5):
    recording = run(node, terminal(command), seconds=seconds, quiet=True)
    assert recording.errors == []
    return "".join(text for _, text in recording.prints)


def test_the_transitions_of_a_lifecycle_node_are_listed():
    assert output_of("ros2 lifecycle list /camera", Camera) == (
        "- configure [1]\n\tStart: unconfigured\n\tGoal: configuring\n"
        "- shutdown [5]\n\tStart: unconfigured\n\tGoal: shuttingdown\n"
    )


def test_all_transitions_of_a_lifecycle_node_are_listed():
    assert "- activate [3]\n\tStart: inactive\n\tGoal: activating\n" in output_of(
        "ros2 lifecycle list -a /camera", Camera
    )


@pytest.mark.parametrize("name", ["radius", "none"])
def test_a_declared_parameter_is_not_deleted(name):
    assert output_of(f"ros2 param delete /wheel {name}", Wheel).startswith("Deleting parameter failed: ")


def test_a_parameter_whose_type_may_change_is_deleted():
    assert output_of("ros2 param delete /wheel note", Wheel) == "Deleted parameter successfully\n"


def late_wheel():
    time.sleep(2.0)
    rclpy.init()
    rclpy.spin(Wheel())


@pytest.mark.parametrize(
    ("words", "text"),
    [
        ("", "Node not found\n"),
        ("--timeout 1", "Node not found\n"),
        ("--timeout 3", "Double value is: 0.1\n"),
    ],
)
def test_commands_on_parameters_wait_for_the_node(words, text):
    assert output_of(f"ros2 param get /wheel radius {words}", late_wheel) == text


def test_hz_measures_the_messages_that_an_expression_selects():
    lines = output_of("ros2 topic hz /level --filter 'm.data % 4 == 0'", Grows).splitlines()
    assert {line for line in lines if line.startswith("average")} == {"average rate: 2.500"}


def test_wtf_is_doctor():
    assert load_group("wtf").verbs == load_group("doctor").verbs


def test_service_echo_prints_the_events_of_a_service():
    request, response, *_ = output_of("ros2 service echo /add", Adder, seconds=1.5).split("---\n")
    assert request.startswith("info:\n  event_type: REQUEST_RECEIVED\n  stamp:\n")
    assert request.endswith("request:\n- a: 2\n  b: 3\nresponse: []\n")
    assert "  event_type: RESPONSE_SENT\n" in response
    assert response.endswith("request: []\nresponse:\n- sum: 5\n")


def test_service_echo_prints_them_as_csv():
    (line, *_) = output_of("ros2 service echo /add --csv", Adder, seconds=1.5).splitlines()
    assert line.startswith("1,1735689601,0,") and line.endswith(",2,3")


class Silent(Node):
    def __init__(self):
        super().__init__("silent")
        self.create_service(AddTwoInts, "add", lambda request, response: response)


NOT_ENABLED = (
    "No publishers on topic '/add/_service_event'; "
    "is service introspection on the client or server enabled?\n"
)
STRING = "Did you mean std_msgs/msg/String?\n"


@pytest.mark.parametrize(
    ("words", "text"),
    [
        ("/add", NOT_ENABLED),
        ("add example_interfaces/srv/AddTwoInts", NOT_ENABLED),
        ("/ad", "Could not load the type for the passed service. Did you mean /add?\n"),
        (
            "/add example_interfaces/srv/AddTwo",
            "The service type 'example_interfaces/srv/AddTwo' is invalid. "
            "Did you mean example_interfaces/srv/AddTwoInts?\n",
        ),
    ],
)
def test_why_service_echo_prints_nothing(words, text):
    assert output_of(f"ros2 service echo {words}", Silent, seconds=3) == text


@pytest.mark.parametrize(
    ("words", "text"),
    [
        ("geometry_msgs/msg/Vector3", '"x: 0.0\ny: 0.0\nz: 0.0\n"\n'),
        ("std_srvs/srv/SetBool --no-quotes", "data: false\n\n"),
        ("example_interfaces/action/Fibonacci", '"order: 0\n"\n'),
        ("std_msgs/msg/Strin", f"Could not find the interface 'std_msgs/msg/Strin'. {STRING}"),
        ("String", f"Invalid name 'String'. Expected three parts separated by '/'. {STRING}"),
    ],
)
def test_interface_proto_prints_a_message_to_fill_in(capsys, words, text):
    ros2(f"interface proto {words}")
    assert capsys.readouterr().out == text


@pytest.mark.parametrize("words", absent.COMMANDS)
def test_a_command_that_is_not_here_is_named(capsys, words):
    ros2(f"{words} anything")
    text = capsys.readouterr().out
    assert text == f"`ros2 {words}` is not available here: {absent.COMMANDS[words]}\n"
    assert " Use " in text and text.endswith(" instead.\n")


POSITIONAL = {"service call": "/add std_srvs/srv/Trigger", "action send_goal": "/count a/action/B"}
POSITIONAL |= {"topic pub": "/level std_msgs/msg/Float64", "doctor": "", "wtf": "", "bag record": "-a"}
OPTIONS = [(words, option) for words, options in absent.OPTIONS.items() for option in options]


@pytest.mark.parametrize(("words", "option"), OPTIONS)
def test_an_option_that_is_not_here_is_named(capsys, words, option):
    ros2(f"{words} {POSITIONAL.get(words, 'something')} {option}")
    text = capsys.readouterr().out
    assert text.startswith(f"`ros2 {words} {option}` is not available here: ")
    assert text.endswith((". Leave it out.\n", " instead.\n"))


@pytest.mark.parametrize(("words", "option"), OPTIONS)
def test_no_option_is_both_here_and_not(words, option):
    command, _, verb = words.partition(" ")
    assert not any(option in argument.names for argument in load_group(command).verbs[verb].arguments)


def test_no_command_is_both_here_and_not():
    assert not set(absent.COMMANDS) & set(COMMANDS)


def test_doctor_hello_counts_the_greetings_of_other_hosts():
    greetings = hello.Greetings("here")
    greetings.published, greetings.sent = 10, 9
    for text in ("hello, it's me there", greetings.text, "", "hello, it's me there"):
        greetings.count(greetings.subscribed, text)
    greetings.count(greetings.received, "hello, it's me elsewhere")
    assert greetings.table("/canyouhearme", 1.0) == (
        "MULTIMACHINE COMMUNICATION SUMMARY\n"
        "Topic: /canyouhearme, Published Msg Count: 10\n"
        "Subscribed from:\n"
        "                Hostname             Msg Count /1.0s\n"
        "                there                2         \n"
        "Multicast Group/Port: 225.0.0.1/49150, Sent Msg Count: 9\n"
        "Received from:\n"
        "                Hostname             Msg Count /1.0s\n"
        "                elsewhere            1         \n"
        f"{'-' * 60}"
    )

