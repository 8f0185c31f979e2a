"""Advice on errors that the recording explains: what was raised on purpose, or taken too early."""

import pytest
from example_interfaces.action import Fibonacci
from rcl_interfaces.srv import SetParameters
from rclpy.action import ActionClient
from rclpy.node import Node
from rclpy.parameter import Parameter
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Float64
from std_srvs.srv import Trigger

from grader.diagnosis import explain, find_fault
from sim import run
from tests.students import service_misfits as misfits
from tests.students.engine.actions import Server
from tests.students.engine.services import Adder, Customer, SlowAdder
from tests.students.parameter_mistakes import Wheel

NO = "An exception doesn't refuse anything: it ends the node, and the client waits for a response that never arrives. Refuse in the "
TOO_EARLY = (
    "The response isn't there yet: {} returns at once, with a future that is still empty. "
    "`future.add_done_callback(self.on_response)`, without parentheses after the method, lets ROS call it once the response has arrived; there, future.result() is the response."
)
GENERAL = ""


class AsksItself(Node):
    """Offers /reset, and calls it after a second."""

    def __init__(self):
        super().__init__("meter")
        self.create_service(Trigger, "reset", self.reset)
        self.client = self.create_client(Trigger, "reset")
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.client.call_async(Trigger.Request())


class RaisesForNo(AsksItself):
    def reset(self, request, response):
        raise RuntimeError("not now")


class TyposInAService(AsksItself):
    def reset(self, request, response):
        response.success = {}[1]
        return response


class RaisesForNoSum(Adder):
    def add(self, request, response):
        if request.a:
            raise ValueError("too large")
        return response


class RaisesForABadValue(Wheel):
    def check(self, parameters):
        raise ValueError("not this one")


class Tuner(Node):
    """Sets the radius of the wheel after half a second."""

    def __init__(self):
        super().__init__("tuner")
        self.client = self.create_client(SetParameters, "/wheel/set_parameters")
        self.create_timer(0.5, self.tick)

    def tick(self):
        parameter = Parameter("radius", value=0.3).to_parameter_msg()
        self.client.call_async(SetParameters.Request(parameters=[parameter]))


class RaisesInATimer(Wheel):
    def change(self):
        raise RuntimeError("by a student")


class Ticking(Customer):
    def __init__(self):
        super().__init__()
        self.create_timer(1.0, self.tick)


class TakesTheResultAtOnce(Ticking):
    def tick(self):
        self.say(self.client.call_async(self.request()).result().sum)


class ReadsNothingWhileAskingElsewhere(Ticking):
    """Two mistakes: the first error has nothing to do with the question of a second before."""

    nothing = None

    def tick(self):
        self.create_timer(0.2, self.look)
        self.client.call_async(self.request())

    def look(self):
        self.say(self.nothing.sum)


class CallsTheDoneCallback(Ticking):
    def tick(self):
        future = self.client.call_async(self.request())
        future.add_done_callback(self.on_response(future))

    def on_response(self, future):
        self.say(future.result().sum)


class LooksIntoTheGoalAtOnce(Node):
    def __init__(self):
        super().__init__("client")
        self.client = ActionClient(self, Fibonacci, "fibonacci")
        self.create_timer(1.0, self.tick)

    def tick(self):
        if self.client.send_goal_async(Fibonacci.Goal(order=3)).result().accepted:
            self.get_logger().info("accepted")


class TakesTheResultOfAGoalAtOnce(LooksIntoTheGoalAtOnce):
    def tick(self):
        self.client.send_goal_async(Fibonacci.Goal(order=3)).add_done_callback(self.on_response)

    def on_response(self, future):
        future.result().get_result_async().result().result  # noqa: B018


class SendsAParameter(Wheel):
    def change(self):
        Float64(data=self.get_parameter("radius"))


class SendsAWrongValue(Wheel):
    def change(self):
        Float64(data=str(self.get_parameter("radius").value))


class ReceivesWithoutTheFuture(Ticking):
    def tick(self):
        self.client.call_async(self.request()).add_done_callback(self.on_response)

    def on_response(self):
        self.say("received")


class CallsItsCallback(Ticking):
    def tick(self):
        self.create_subscription(Float64, "angle", self.look(), 10)

    def look(self, msg):
        self.say("looked")


class HandsAPairOver(Ticking):
    def tick(self):
        self.drive((0.3, 0.1))

    def drive(self, speed, turn):
        self.say("drives")


class GivesNothingBack(Ticking):
    def tick(self):
        Float64(data=self.nearest())

    def nearest(self):
        min(1.0, 2.0)


class SlicesPastTheEnd(Ticking):
    def tick(self):
        ranges = [1.0] * 360
        self.say(min(ranges[-35:36]))


class LooksBeforeTheFirstMessage(Node):
    scan = None

    def __init__(self):
        super().__init__("looker")
        self.create_subscription(LaserScan, "lidar", print, 10)
        self.create_timer(0.5, lambda: min(self.scan.ranges))


class Receives(Ticking):
    """Nothing is wrong with it."""

    def tick(self):
        self.client.call_async(self.request()).add_done_callback(lambda future: self.say(future.result().sum))


def record(*nodes):
    return run(*nodes, seconds=3, quiet=True)


ADVICE = {
    (RaisesForNo,): NO + "response: response.success = False, response.message = the reason, return response.",
    (RaisesForNoSum, Receives): NO + "response: set its fields, and return the response.",
    (TyposInAService,): GENERAL,
    (RaisesInATimer,): GENERAL,
    (
        Tuner,
        RaisesForABadValue,
    ): "An exception doesn't refuse anything; it ends the node. To refuse a value, return "
    'SetParametersResult(successful=False, reason="...").',
    (SlowAdder, TakesTheResultAtOnce): TOO_EARLY.format("call_async"),
    (SlowAdder, CallsTheDoneCallback): TOO_EARLY.format("call_async"),
    (
        misfits.main_of_a_later_distribution,
    ): "`with rclpy.init():` is for ROS distributions after Jazzy: here rclpy.init() returns None. Call it alone, `rclpy.init(args=args)`, create and spin the node after it, and end with `rclpy.try_shutdown()`.",
    (Server, LooksIntoTheGoalAtOnce): TOO_EARLY.format("send_goal_async"),
    (Server, TakesTheResultOfAGoalAtOnce): TOO_EARLY.format("get_result_async"),
    (SendsAParameter,): "get_parameter() returns a parameter, which contains a value: write "
    "self.get_parameter('name').value.",
    (
        SendsAWrongValue,
    ): "`data` takes a number with a decimal point: set `msg.data = 1.0`, not `1`; `float(value)` converts.",
    (
        CallsItsCallback,
    ): "`look` is called there without all of its arguments. Pass a callback without parentheses, `self.look`. And a star unpacks a pair: `self.look(*pair)`.",
    (
        HandsAPairOver,
    ): "`drive` is called there without all of its arguments. Pass a callback without parentheses, `self.drive`. And a star unpacks a pair: `self.drive(*pair)`.",
    (
        GivesNothingBack,
    ): "`data` takes a number with a decimal point, such as 1.0, but gets what `nearest` returns: does every path through it end with `return` and one such number? `print` shows what it returns.",
    (
        SlicesPastTheEnd,
    ): "`[-35:36]` is empty: a slice doesn't wrap around from the end of a list to its beginning. Join two "
    "parts: `[*msg.ranges[-35:], *msg.ranges[:36]]`.",
    (
        SlowAdder,
        ReadsNothingWhileAskingElsewhere,
    ): "The value before `.sum` is None: it was never set, or comes from a function without `return`.",
    (
        SlowAdder,
        ReceivesWithoutTheFuture,
    ): "A done callback is called with the future: write `def on_response(self, future):`.",
}


@pytest.mark.parametrize("nodes", ADVICE, ids=lambda nodes: nodes[-1].__name__)
def test_an_error_gets_the_advice_of_its_situation(nodes):
    assert find_fault(record(*nodes)).hint == ADVICE[nodes]


def test_an_error_in_a_check_of_parameters_names_the_students_own_method():
    fault = find_fault(record(Tuner, RaisesForABadValue))
    line = RaisesForABadValue.check.__code__.co_firstlineno + 1
    assert fault.saw == f"ValueError: not this one (in check, line {line}, at 0.5 s)"


@pytest.mark.parametrize(
    "nodes", [(SlowAdder, Receives), (Adder, misfits.NoOneReceives)], ids=["taken", "at once"]
)
def test_an_answer_that_may_have_been_taken_is_not(nodes):
    assert explain(record(*nodes)) == ""


def test_what_keeps_the_last_message_is_still_none_before_the_first():
    assert find_fault(record(LooksBeforeTheFirstMessage)).hint == (
        "No message has arrived on /lidar by then, so the variable for the latest one is still None. Test for that first, with `is None`; before the first message, send zeros to a robot."
    )


class NotLocalized(Ticking):
    """Uses its pose, which another callback would set, in a timer."""

    pose = goal = None

    def tick(self):
        self.use()


class NeedsAPart(NotLocalized):
    def use(self):
        self.say(self.pose[0])


class UnpacksIt(NotLocalized):
    def use(self):
        x, _ = self.pose
        self.say(x)


class GoesThroughIt(NotLocalized):
    def use(self):
        self.say([x for x in self.pose])


class CalculatesWithIt(NotLocalized):
    def use(self):
        self.say(self.pose - 1.0)


class ComparesIt(NotLocalized):
    def use(self):
        self.say(self.pose > 1.0)


class CalculatesFromIt(NotLocalized):
    def use(self):
        self.say(1.0 - self.pose)


class UsesAPartThatIsNone(NotLocalized):
    def use(self):
        self.pose = {"x": None}
        self.say(self.pose["x"][0])


class CalculatesWithAnArgument(NotLocalized):
    def use(self, gain=None):
        self.pose = 2.0
        self.say(self.pose * gain)


class UsesTwo(NotLocalized):
    def use(self):
        self.say(self.pose - self.goal)


class UnpacksWhatAMethodReturns(NotLocalized):
    def use(self):
        x, _ = self.place()
        self.say(x)

    def place(self):
        pass


@pytest.mark.parametrize("node", [NeedsAPart, UnpacksIt, GoesThroughIt, CalculatesWithIt, CalculatesFromIt, ComparesIt])
def test_an_attribute_that_no_callback_has_set_yet_is_named(node):
    assert find_fault(record(node)).hint == (
        "`self.pose` is None there. If a callback sets it, that callback may not have been called yet: test first, "
        "with `if self.pose is None:`."
    )


@pytest.mark.parametrize("node", [UsesAPartThatIsNone, CalculatesWithAnArgument, UnpacksWhatAMethodReturns])
def test_where_another_value_is_none_no_attribute_is_named(node):
    assert "self.pose" not in find_fault(record(node)).hint


def test_of_two_attributes_that_are_none_the_left_one_is_named():
    assert find_fault(record(UsesTwo)).hint.startswith("`self.pose` is None there.")
