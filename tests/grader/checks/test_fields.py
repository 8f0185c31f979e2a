from example_interfaces.action import Fibonacci
from geometry_msgs.msg import Twist, Vector3
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue, SetParametersResult
from rcl_interfaces.srv import GetParameters, SetParameters
from std_srvs.srv import SetBool

from grader.checks.fields import differing, listed, plain, read, told, words

SPEED = ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=0.5)
SIZES = ParameterValue(type=ParameterType.PARAMETER_INTEGER_ARRAY, integer_array_value=[1, 2])


def test_messages_are_told_in_words():
    assert told(SetBool.Response(success=True, message="on")) == "success=True, message='on'"
    assert told(Fibonacci.Result(sequence=[0, 1])) == "sequence=[0, 1]"
    assert words({"sum": 5, "ok": True}) == "sum=5, ok=True"


def test_long_messages_are_cut():
    assert told(SetBool.Response(message="m" * 200)) == f"success=False, message='{'m' * 96}..."


def test_setting_parameters_is_told_by_their_names():
    asked = SetParameters.Request(
        parameters=[Parameter(name="speed", value=SPEED), Parameter(name="sizes", value=SIZES)]
    )
    assert plain(asked) == {"speed": 0.5, "sizes": [1, 2]}
    assert told(asked) == "speed=0.5, sizes=[1, 2]"


def test_all_parameters_must_be_set():
    yes, no = SetParametersResult(successful=True), SetParametersResult(successful=False, reason="too fast")
    assert told(SetParameters.Response(results=[yes])) == "successful=True, reason=''"
    assert told(SetParameters.Response(results=[yes, no])) == "successful=False, reason='too fast'"
    assert told(SetParameters.Response()) == "results=[]"


def test_parameters_are_told_by_their_values():
    assert told(GetParameters.Response(values=[SPEED])) == "value=0.5"
    assert told(GetParameters.Response(values=[SPEED, ParameterValue()])) == "value=[0.5, None]"


def test_the_first_values_of_a_list_are_told_in_words():
    assert listed(range(1, 9)) == "1, 2, 3, 4, 5, 6, 7, 8"
    assert listed(range(1, 10)) == "1, 2, 3, 4, 5, 6, 7, 8, ..."


def test_fields_are_read_with_dots():
    assert read(Twist(linear=Vector3(x=0.5)), "linear.x") == 0.5


def test_numbers_with_a_point_may_differ_a_little_and_nothing_else_may():
    twist = Twist(linear=Vector3(x=0.1 + 0.2))
    assert differing(twist, {"linear.x": 0.3, "linear.y": 0}) == []
    assert differing(twist, {"linear.x": 0.301, "linear.y": 0.0}) == ["linear.x"]
    result = Fibonacci.Result(sequence=[0, 1])
    assert differing(result, {"sequence": [0, 1]}) == differing(result, {"sequence": (0, 1)}) == []
    assert differing(result, {"sequence": [0, 1, 1]}) == ["sequence"]
