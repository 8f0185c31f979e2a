"""Services and actions with one mistake each, named by it, that ends in an exception."""

import rclpy
from example_interfaces.action import Fibonacci
from example_interfaces.srv import AddTwoInts, SetBool
from nav2_msgs.action import Wait
from rclpy.action import ActionClient, ActionServer, GoalResponse
from rclpy.node import Node
from std_msgs.msg import String


class Asker(Node):
    """What the others are built on: offers /sum, and asks itself once a second."""

    def __init__(self):
        super().__init__("asker")
        self.create_service(AddTwoInts, "sum", self.answer)
        self.client = self.create_client(AddTwoInts, "sum")
        self.create_timer(1.0, self.tick)

    def answer(self, request, response):
        response.sum = request.a + request.b
        return response

    def tick(self):
        self.client.call_async(AddTwoInts.Request(a=1, b=2))


class ForgetsToReturnTheResponse(Asker):
    def answer(self, request, response):
        response.sum = request.a + request.b


class ReturnsTheSum(Asker):
    def answer(self, request, response):
        return request.a + request.b


class ReturnsTheRequest(Asker):
    def answer(self, request, response):
        return request


class AnswersWithoutResponse(Asker):
    def answer(self, request):
        return AddTwoInts.Response(sum=request.a + request.b)


class FieldOfTheResponseMisspelt(Asker):
    def answer(self, request, response):
        response.summ = request.a + request.b
        return response


class CallsWithNumbers(Asker):
    def tick(self):
        self.client.call_async(3)


class CallsWithTheClass(Asker):
    def tick(self):
        self.client.call_async(AddTwoInts.Request)


class CallsWithTheResponse(Asker):
    def tick(self):
        self.client.call(AddTwoInts.Response())


class ServesAnotherType(Asker):
    def tick(self):
        self.create_service(SetBool, "sum", self.answer)


class AsksForAnotherType(Asker):
    def tick(self):
        self.create_client(SetBool, "sum")


class ServesAMessage(Asker):
    def tick(self):
        self.create_service(String, "text", self.answer)


class AsksByAMessage(Asker):
    def tick(self):
        self.create_client(String, "text")


class ServesWithoutCallback(Asker):
    def tick(self):
        self.create_service(AddTwoInts, "other")


class TypeAfterName(Asker):
    def tick(self):
        self.create_service("other", AddTwoInts, self.answer)


class ComparesAListWithANumber(Asker):
    def tick(self):
        if [1, 2] < 3:
            super().tick()


class HandsOverWhatTheCallbackReturns(Asker):
    def tick(self):
        self.create_service(AddTwoInts, "other", self.answer())


class Runner(Node):
    """What the others are built on: offers the action /count, and sends itself a goal after a second."""

    def __init__(self):
        super().__init__("runner")
        self.server = ActionServer(self, Fibonacci, "count", self.execute)
        self.client = ActionClient(self, Fibonacci, "count")
        self.timer = self.create_timer(1.0, self.tick)

    def tick(self):
        self.timer.cancel()
        self.client.send_goal_async(Fibonacci.Goal(order=3))

    def execute(self, goal_handle):
        goal_handle.succeed()
        return Fibonacci.Result()


class ReturnsNoResult(Runner):
    def execute(self, goal_handle):
        goal_handle.succeed()


class ReturnsTheFeedback(Runner):
    def execute(self, goal_handle):
        goal_handle.succeed()
        return Fibonacci.Feedback()


class PublishesAListAsFeedback(Runner):
    def execute(self, goal_handle):
        goal_handle.publish_feedback([0, 1])
        return super().execute(goal_handle)


class PublishesTheResultAsFeedback(Runner):
    def execute(self, goal_handle):
        goal_handle.publish_feedback(Fibonacci.Result())
        return super().execute(goal_handle)


class CallsAValue(Runner):
    def execute(self, goal_handle):
        if goal_handle.is_cancel_requested():
            goal_handle.canceled()
        return super().execute(goal_handle)


class SaysSuccess(Runner):
    def execute(self, goal_handle):
        goal_handle.success()
        return Fibonacci.Result()


class JudgesAGoalHandle(Runner):
    def __init__(self):
        super().__init__()
        self.server.register_goal_callback(self.judge)

    def judge(self, goal):
        return GoalResponse.ACCEPT if goal.request.order < 9 else GoalResponse.REJECT


class SucceedsTwice(Runner):
    def execute(self, goal_handle):
        goal_handle.succeed()
        return super().execute(goal_handle)


class CancelsWithoutBeingAsked(Runner):
    def execute(self, goal_handle):
        goal_handle.canceled()
        return Fibonacci.Result()


class AsksTheHandleForTheOrder(Runner):
    def execute(self, goal_handle):
        return Fibonacci.Result(sequence=[0] * goal_handle.order)


class SendsANumber(Runner):
    def tick(self):
        self.client.send_goal_async(3)


class SendsTheWholeAction(Runner):
    def tick(self):
        self.client.send_goal_async(Fibonacci)


class ReceivesFeedbackWithoutFeedback(Runner):
    def tick(self):
        self.timer.cancel()
        self.client.send_goal_async(Fibonacci.Goal(order=3), feedback_callback=self.on_message)

    def on_message(self, msg):
        self.get_logger().info(f"{msg.sequence}")

    def execute(self, goal_handle):
        goal_handle.publish_feedback(Fibonacci.Feedback(sequence=[0, 1]))
        return super().execute(goal_handle)


class ReadsTheResultOfTheHandle(Runner):
    def tick(self):
        self.timer.cancel()
        self.client.send_goal_async(Fibonacci.Goal(order=3)).add_done_callback(self.accepted)

    def accepted(self, future):
        self.get_logger().info(f"{future.result().result}")


class ReadsTheSequenceOfTheAnswer(ReadsTheResultOfTheHandle):
    def accepted(self, future):
        future.result().get_result_async().add_done_callback(self.over)

    def over(self, future):
        self.get_logger().info(f"{future.result().sequence}")


class ReadsTheStatusOfTheResult(ReadsTheSequenceOfTheAnswer):
    def over(self, future):
        self.get_logger().info(f"{future.result().result.status}")


class KeepsTheGoalAsHandle(Runner):
    def execute(self, goal_handle):
        self.handle = goal_handle
        return super().execute(goal_handle)


class ActionServerWithoutCallback(Runner):
    def tick(self):
        ActionServer(self, Fibonacci, "other")


class SendsGoalsOfAnotherType(Runner):
    def tick(self):
        ActionClient(self, Wait, "count")


class ServesAnObjectOfTheType(Asker):
    def __init__(self):
        super().__init__()
        self.create_service(SetBool(), "switch", self.answer)


class PublishesTheWholeAnswer(Asker):
    def __init__(self):
        super().__init__()
        self.publisher = self.create_publisher(String, "sums", 10)

    def answer(self, request, response):
        self.publisher.publish(response)
        return response


class AsksByPosition(Asker):
    def tick(self):
        self.client.call_async(AddTwoInts.Request(1, 2))


class SendsTheGoalOfAnotherAction(Runner):
    def tick(self):
        self.client.send_goal_async(Wait.Goal())


class TellsFeedbackByKeyword(Runner):
    def execute(self, goal_handle):
        goal_handle.publish_feedback(sequence=[0, 1])
        return super().execute(goal_handle)


class LooksForRejected(Runner):
    def tick(self):
        self.timer.cancel()
        self.client.send_goal_async(Fibonacci.Goal(order=3)).add_done_callback(self.on_response)

    def on_response(self, future):
        return future.result().rejected


class CancelsByTheClient(Runner):
    def tick(self):
        self.client.cancel_goal_async()


class SetsAFieldOfAClass(Runner):
    """The class that is changed here is one of its own, so that other tests find the shared one as it was."""

    def execute(self, goal_handle):
        own = type("Result", (String,), {"__slots__": (), "data": "set in the class"})
        return own()


def spins_the_class():
    rclpy.init()
    rclpy.spin(Runner)
