from builtin_interfaces.msg import Time
from example_interfaces.action import Fibonacci
from geometry_msgs.msg import PoseWithCovariance, Twist, Vector3
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue, SetParametersResult
from rcl_interfaces.srv import GetParameters, SetParameters
from std_srvs.srv import SetBool

from grader.checks.fields import differing, listed, message_text, plain, read, stamp_words, words
from sim.nanoseconds import EPOCH, SECOND

SPEED = ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=0.5)
SIZES = ParameterValue(type=ParameterType.PARAMETER_INTEGER_ARRAY, integer_array_value=[1, 2])


def test_messages_are_reported_in_words():
    assert message_text(SetBool.Response(success=True, message="on")) == "success=True, message='on'"
    assert message_text(Fibonacci.Result(sequence=[0, 1])) == "sequence=[0, 1]"
    assert words({"sum": 5, "ok": True}) == "sum=5, ok=True"


def test_long_messages_are_cut():
    assert message_text(SetBool.Response(message="m" * 200)) == f"success=False, message='{'m' * 96}..."


def test_a_message_of_120_characters_is_shown_whole():
    whole = f"success=False, message='{'m' * 95}'"
    assert len(whole) == 120
    assert message_text(SetBool.Response(message="m" * 95)) == whole
    assert message_text(SetBool.Response(message="m" * 96)) == f"{whole[:-1]}m..."


def at(seconds):
    """A stamp of a run."""
    nanoseconds = EPOCH + round(seconds * SECOND)
    return Time(sec=nanoseconds // SECOND, nanosec=nanoseconds % SECOND)


def test_a_stamp_is_shown_as_a_time_in_the_run_or_as_it_is():
    assert [stamp_words(at(seconds)) for seconds in (0.0, 0.5, 2.0)] == ["0.000 s", "0.500 s", "2.000 s"]
    assert stamp_words(Time()) == "sec=0, nanosec=0"
    before = at(-0.5)
    assert stamp_words(before) == f"sec={before.sec}, nanosec={before.nanosec}"


def test_setting_parameters_is_reported_by_their_names():
    asked = SetParameters.Request(
        parameters=[Parameter(name="speed", value=SPEED), Parameter(name="sizes", value=SIZES)]
    )
    assert plain(asked) == {"speed": 0.5, "sizes": [1, 2]}
    assert message_text(asked) == "speed=0.5, sizes=[1, 2]"


def test_all_parameters_must_be_set():
    yes, no = SetParametersResult(successful=True), SetParametersResult(successful=False, reason="too fast")
    assert message_text(SetParameters.Response(results=[yes])) == "successful=True, reason=''"
    assert message_text(SetParameters.Response(results=[yes, no])) == "successful=False, reason='too fast'"
    refused = [no, SetParametersResult(successful=False, reason="too slow")]
    both = "successful=False, reason='too fast; too slow'"
    assert message_text(SetParameters.Response(results=refused)) == both
    assert message_text(SetParameters.Response()) == "results=[]"


def test_parameters_are_reported_by_their_values():
    assert message_text(GetParameters.Response(values=[SPEED])) == "value=0.5"
    assert message_text(GetParameters.Response(values=[SPEED, ParameterValue()])) == "value=[0.5, None]"


def test_the_first_values_of_a_list_are_reported_in_words():
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


def test_numbers_with_a_point_may_differ_by_a_millionth_of_their_size_and_of_1():
    def differs(value, expected):
        return differing(Twist(linear=Vector3(x=value)), {"linear.x": expected}) == ["linear.x"]

    assert not differs(1e6 + 0.9, 1e6)
    assert differs(1e6 + 1.1, 1e6)
    assert not differs(0.9e-6, 0)
    assert differs(1.1e-6, 0.0)


def test_a_value_of_another_kind_differs():
    assert differing(SetBool.Response(message="1"), {"message": 1}) == ["message"]
    assert differing(Twist(linear=Vector3(x=1.0)), {"linear.x": "1.0"}) == ["linear.x"]
    assert differing(Fibonacci.Result(sequence=[1]), {"sequence": 1}) == ["sequence"]
    assert differing(SetBool.Response(success=True), {"success": [True]}) == ["success"]


def test_a_list_differs_where_one_of_its_numbers_does():
    covariance = PoseWithCovariance(covariance=[0.3] * 36)
    assert differing(covariance, {"covariance": [0.1 + 0.2] * 36}) == []
    assert differing(covariance, {"covariance": [0.3] * 35 + [0.4]}) == ["covariance"]
