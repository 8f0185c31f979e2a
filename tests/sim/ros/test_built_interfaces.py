"""Messages, services and actions of a package that colcon built, in a Python that runs already."""

import importlib
import sys

import pytest
from rclpy.action import ActionClient, ActionServer
from rclpy.node import Node
from rclpy.serialization import deserialize_message, serialize_message

from sim import Recording, run, source
from sim.ros.recorder.tracebacks import student_frames
from tests.sim.ros.workspaces import as_it_was, build, with_interfaces

pytestmark = pytest.mark.soak  # rosidl and its C++ take half a minute


def types():
    names = {"msg": "Level", "srv": "Ask", "action": "Act"}
    return [getattr(importlib.import_module(f"my_interfaces.{kind}"), name) for kind, name in names.items()]


class Both(Node):
    """Sends, asks and does all by itself."""

    def __init__(self, **more):
        super().__init__("both")
        self.message, self.service, self.action = types()
        self.more, self.received = more, []
        self.publisher = self.create_publisher(self.message, "level", 10)
        self.create_subscription(self.message, "level", self.received.append, 10)
        self.create_service(self.service, "ask", self.ask)
        self.client = self.create_client(self.service, "ask")
        self.server = ActionServer(self, self.action, "act", self.act)
        self.goals = ActionClient(self, self.action, "act")
        self.create_timer(0.5, self.tick)

    def tick(self):
        self.publisher.publish(self.message(level=1.5, name="deep", **self.more))
        self.client.call_async(self.service.Request(a=1))
        self.goals.send_goal_async(self.action.Goal(order=2))

    def ask(self, request, response):
        response.b = request.a + 1
        return response

    def act(self, goal):
        goal.succeed()
        return self.action.Result(result=goal.request.order * 2)


def first(tmp_path, **more):
    """The first message of a run, after it was saved and loaded."""
    recording = run(lambda: Both(**more), seconds=0.9, quiet=True)
    assert recording.errors == []
    assert [call.response.b for call in recording.calls] == [2]
    assert [goal.events[-1][1] for goal in recording.goals] == ["succeeded"]
    recording.save(tmp_path / "run.mcap")
    return Recording.load(tmp_path / "run.mcap").messages("/level")[0].message


def test_a_second_version_and_the_first_again_are_used_without_a_restart(tmp_path):
    workspace = tmp_path / "ws"
    definition = with_interfaces(workspace) / "msg" / "Level.msg"
    before = definition.read_text()
    with as_it_was():
        for text, more in ((before, {}), (f"int32 more\n{before}", {"more": 7}), (before, {})):
            definition.write_text(text)
            build(workspace)
            source(workspace / "install" / "setup.bash")
            message = first(tmp_path, **more)
            assert type(message) is types()[0]
            assert getattr(message, "more", None) == more.get("more")
            assert deserialize_message(serialize_message(message), type(message)) == message
            source(workspace / "install" / "setup.bash")
            assert type(message) is types()[0]  # nothing was built: nothing is loaded anew
        with pytest.raises(AssertionError) as caught:
            types()[1].Request(nope=[])
        (frame,) = student_frames(caught.value)
        assert (frame.filename, frame.line) == (__file__, "types()[1].Request(nope=[])")
    for name in [name for name in sys.modules if name.startswith("my_interfaces")]:
        del sys.modules[name]
