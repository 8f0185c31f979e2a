"""Every usual mistake with services and actions, made by a real node, gets its own advice."""

import re

import pytest

from grader.diagnosis import find_fault
from grader.diagnosis.service_rules import SERVICE_RULES
from sim import run
from tests.students import service_mistakes as mistakes

REQUEST = "A call takes one request: `request = AddTwoInts.Request()`, then set its fields, then `call_async(request)`."
GOAL = "A goal is sent as a message: `goal = Fibonacci.Goal()`, then set its fields, then `send_goal_async(goal)`."
FEEDBACK = (
    "Feedback is a message: `feedback = Fibonacci.Feedback()`, then set its fields, then "
    "`goal_handle.publish_feedback(feedback)`."
)
RESPONSE = (
    "A service's callback returns the response that it was given, with its fields set; this one returned {}. "
    "End it with `return response`."
)
RESULT = "An execute callback has to return the result: end it with `return Fibonacci.Result(...)`."
NO_SERVICE = (
    "This is not the type of a service. Services come from packages' `.srv`, as in `from std_srvs.srv import SetBool`; "
    "actions from `.action`, as in `from example_interfaces.action import Fibonacci`."
)
OTHER_TYPE = "Another node uses {} with another type: client and server must use the same one."

ADVICE = {
    mistakes.ForgetsToReturnTheResponse: "The service's callback has to return its response: end it with "
    "`return response`.",
    mistakes.ReturnsTheSum: RESPONSE.format("int"),
    mistakes.ReturnsTheRequest: RESPONSE.format("AddTwoInts_Request"),
    mistakes.AnswersWithoutResponse: "`answer` is called with two arguments, as a service's callback is: write "
    "`def answer(self, request, response):`.",
    mistakes.FieldOfTheResponseMisspelt: "AddTwoInts.Response has no `summ`: check its spelling. For a message, `AddTwoInts.Response.get_fields_and_field_types()` lists the fields.",
    mistakes.CallsWithNumbers: REQUEST,
    mistakes.CallsWithTheClass: "A call takes a request, not its class: `request = AddTwoInts.Request()`, with parentheses.",
    mistakes.CallsWithTheResponse: REQUEST,
    mistakes.ServesAnotherType: OTHER_TYPE.format("/sum"),
    mistakes.AsksForAnotherType: OTHER_TYPE.format("/sum"),
    mistakes.ServesAMessage: NO_SERVICE,
    mistakes.AsksByAMessage: NO_SERVICE,
    mistakes.ServesWithoutCallback: "create_service() is missing an argument: write "
    "create_service(Type, 'name', self.callback).",
    mistakes.TypeAfterName: "The arguments are in the wrong order: first the type, then the name, as in "
    "create_service(SetBool, '/arm', self.arm).",
    mistakes.HandsOverWhatTheCallbackReturns: "`answer` is called without its arguments. Pass a callback without parentheses, `self.answer`: ROS calls it, and fills in the arguments.",
    mistakes.ComparesAListWithANumber: "A list is not a number: len(...) counts the items in it.",
    mistakes.SaysSuccess: "A goal handle has no `success`. It has succeed(), abort() and canceled(), "
    "publish_feedback(message), and is_cancel_requested.",
    mistakes.JudgesAGoalHandle: "The goal callback receives the goal itself, not a goal handle: leave out `.request`.",
    mistakes.CallsAValue: "The value before the parentheses is of type bool, not a method: leave the parentheses out.",
    mistakes.ReturnsNoResult: RESULT,
    mistakes.ReturnsTheFeedback: RESULT,
    mistakes.PublishesAListAsFeedback: FEEDBACK,
    mistakes.PublishesTheResultAsFeedback: FEEDBACK,
    mistakes.SucceedsTwice: "The goal has ended already: call one of succeed(), abort() and canceled(), once, and "
    "then return.",
    mistakes.CancelsWithoutBeingAsked: "canceled() is for a goal that a client wants to cancel: call it only when "
    "goal_handle.is_cancel_requested is True; abort() is for what went wrong.",
    mistakes.AsksTheHandleForTheOrder: "The client's request is in the goal handle: "
    "`goal_handle.request.order`.",
    mistakes.SendsANumber: GOAL,
    mistakes.SendsTheWholeAction: GOAL,
    mistakes.ReceivesFeedbackWithoutFeedback: "The message of a feedback callback has the feedback inside: "
    "`msg.feedback.sequence`.",
    mistakes.ReadsTheResultOfTheHandle: "The first response only says whether the goal was accepted. The result comes "
    "later: `goal_handle.get_result_async().add_done_callback(self.on_result)`.",
    mistakes.ReadsTheSequenceOfTheAnswer: "The final response has two parts, a status and the result: "
    "`future.result().result.sequence`.",
    mistakes.ReadsTheStatusOfTheResult: "The status is next to the result, not in it: `future.result().status`.",
    mistakes.KeepsTheGoalAsHandle: "Every node has a `handle` of its own: take another name, such as `self.my_handle`.",
    mistakes.ActionServerWithoutCallback: "ActionServer() is missing an argument: write "
    "ActionServer(self, Type, 'name', self.execute).",
    mistakes.SendsGoalsOfAnotherType: OTHER_TYPE.format("/count"),
    mistakes.ServesAnObjectOfTheType: "Pass the type of a service or an action as it is, without parentheses: "
    "`SetBool`, not `SetBool()`.",
    mistakes.PublishesTheWholeAnswer: "This publisher sends String messages, but got a whole AddTwoInts.Response: take the field that you need out of it, and put that into a message, as in `String(data=...)`.",
    mistakes.AsksByPosition: "Its fields are set by name, as in `AddTwoInts.Request(field=value)`; "
    "`AddTwoInts.Request.get_fields_and_field_types()` lists them.",
    mistakes.SendsTheGoalOfAnotherAction: "This client is for Fibonacci, but got a goal of Wait: each action needs a client of its own.",
    mistakes.TellsFeedbackByKeyword: "Feedback is one message, with the values in it: "
    "`publish_feedback(Type.Feedback(sequence=...))`, with the type of the action.",
    mistakes.LooksForRejected: "The field `accepted` says whether the goal was accepted, True or False: "
    "`if not goal_handle.accepted:`.",
    mistakes.CancelsByTheClient: "A client sends goals; everything about one goal goes through its goal handle, which the first response contains: `self.goal_handle.cancel_goal_async()`.",
    mistakes.SetsAFieldOfAClass: "`data` was set in the class of this message before, because the parentheses of `result = Spin.Result()` were missing. Add them, and restart the kernel: until then the class stays changed.",
    mistakes.spins_the_class: "A node is needed there, not its class: `node = Runner()`, with parentheses, creates one.",
}


def record(student):
    return run(student, seconds=3, quiet=True)


@pytest.mark.parametrize("student", ADVICE, ids=lambda student: student.__name__)
def test_a_mistake_gets_its_advice(student):
    assert find_fault(record(student)).hint == ADVICE[student]


@pytest.mark.parametrize("student", [mistakes.Asker, mistakes.Runner])
def test_what_they_are_built_on_is_right(student):
    recording = record(student)
    assert find_fault(recording) is None
    assert [call.response.sum for call in recording.calls] == [3] * len(recording.calls)
    assert {goal.status for goal in recording.goals} <= {"succeeded"}
    assert recording.calls or recording.goals


def test_every_student_of_the_file_is_judged():
    of_file = {s for s in vars(mistakes).values() if getattr(s, "__module__", "") == mistakes.__name__}
    assert of_file == {mistakes.Asker, mistakes.Runner, *ADVICE}


def test_no_rule_stands_there_without_a_student_who_earns_it():
    earned = set()
    for student in ADVICE:
        error = record(student).errors[0]
        matches = (r for r in SERVICE_RULES if r.type == error.type and re.search(r.pattern, error.text))
        earned.add(next(matches, None))
    assert [rule for rule in SERVICE_RULES if rule not in earned] == []


def test_the_fault_names_the_callback_although_rclpy_raised():
    fault = find_fault(record(mistakes.ForgetsToReturnTheResponse))
    assert fault.saw == (
        "TypeError: Expected <class 'example_interfaces.srv._add_two_ints.AddTwoInts_Response'>, got "
        "<class 'NoneType'> (in ForgetsToReturnTheResponse.answer, at 1 s)"
    )
