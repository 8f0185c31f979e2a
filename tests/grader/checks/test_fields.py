from example_interfaces.action import Fibonacci
from geometry_msgs.msg import Twist, Vector3
from std_srvs.srv import SetBool

from grader.checks.fields import differing, read, told, wanted


def test_messages_are_told_in_words():
    assert told(SetBool.Response(success=True, message="on")) == "success=True, message='on'"
    assert told(Fibonacci.Result(sequence=[0, 1])) == "sequence=[0, 1]"
    assert wanted({"sum": 5, "ok": True}) == "sum=5, ok=True"


def test_fields_are_read_with_dots():
    assert read(Twist(linear=Vector3(x=0.5)), "linear.x") == 0.5


def test_numbers_with_a_point_may_differ_a_little_and_nothing_else_may():
    twist = Twist(linear=Vector3(x=0.1 + 0.2))
    assert differing(twist, {"linear.x": 0.3, "linear.y": 0}) == []
    assert differing(twist, {"linear.x": 0.301, "linear.y": 0.0}) == ["linear.x"]
    result = Fibonacci.Result(sequence=[0, 1])
    assert differing(result, {"sequence": [0, 1]}) == differing(result, {"sequence": (0, 1)}) == []
    assert differing(result, {"sequence": [0, 1, 1]}) == ["sequence"]
