"""Exceptions around services and actions, as `rules` has those around topics.

rclpy's own TypeError has no words there; the engine gives it those of a publisher.
"""

from __future__ import annotations

from grader.diagnosis.rules import Rule

_GOT = r"got <class '(?:[\w.]*\.)?(\w+)'>"

SERVICE_RULES = (
    Rule(
        "TypeError", r"Expected <class '[\w.]*?(\w+)_Response'>, got <class 'NoneType'>",
        "The service's callback has to return its response: end it with `return response`.",
    ),
    Rule(
        "TypeError", rf"Expected <class '[\w.]*?(\w+)_Response'>, {_GOT}",
        "A service's callback returns the response that it was given, with its fields set; this one returned "
        "{1}. End it with `return response`.",
    ),
    Rule(
        "TypeError", r"Expected <class '[\w.]*?(\w+)_Request'>, got <class '[\w.]*Metaclass_\1_Request'>",
        "A call takes a request, not its class: `request = {0}.Request()`, with parentheses.",
    ),
    Rule(
        "TypeError", rf"Expected <class '[\w.]*?(\w+)_Request'>, {_GOT}",
        "A call takes one request: `request = {0}.Request()`, then set its fields, then "
        "`call_async(request)`.",
    ),
    Rule(
        "TypeError", r"Expected <class '[\w.]*?(\w+)_Goal'>, got <class '[\w.]*?(\w+)_Goal'>",
        "This client is for {0}, but got a goal of {1}: each action needs a client of its own.",
    ),
    Rule(
        "TypeError", rf"Expected <class '[\w.]*?(\w+)_Goal'>, {_GOT}",
        "A goal is sent as a message: `goal = {0}.Goal()`, then set its fields, then "
        "`send_goal_async(goal)`.",
    ),
    Rule(
        "TypeError", rf"Expected <class '[\w.]*?(\w+)_Feedback'>, {_GOT}",
        "Feedback is a message: `feedback = {0}.Feedback()`, then set its fields, then "
        "`goal_handle.publish_feedback(feedback)`.",
    ),
    Rule(
        "TypeError", r"Expected <class '[\w.]*?(\w+)'>, got <class '[\w.]*?(\w+)_(Response|Result)'>",
        "This publisher sends {0} messages, but got a whole {1}.{2}: take the field that you need out of it, "
        "and put that into a message, as in `{0}(data=...)`.",
    ),
    Rule(
        "TypeError", r"(\w+)_(Request|Response|Goal|Result|Feedback)\.__init__\(\) takes 1 positional",
        "Its fields are set by name, as in `{0}.{1}(field=value)`; `{0}.{1}.get_fields_and_field_types()` "
        "lists them.",
    ),
    Rule(
        "TypeError", r"publish_feedback\(\) got an unexpected keyword argument '(\w+)'",
        "Feedback is one message, with the values in it: `publish_feedback(Type.Feedback({0}=...))`, with "
        "the type of the action.",
    ),
    Rule(
        "NotImplementedError", r"(?:Service|Action) classes can not be instantiated",
        "Pass the type of a service or an action as it is, without parentheses: `SetBool`, not `SetBool()`.",
    ),
    Rule(
        "AssertionError", r"The 'result' field must be a sub message of type '(\w+)_Result'",
        "An execute callback has to return the result: end it with `return {0}.Result(...)`.",
    ),
    Rule(
        "TypeError", r"^(?!RcutilsLogger)[\w.]*?(\w+)\(\) takes 2 positional arguments but 3 were given",
        "`{0}` is called with two arguments, as a service's callback is: write `def {0}(self, request, "
        "response):`.",
    ),
    Rule(
        "TypeError", r"(\w+)\(\) missing \d required positional arguments?: '(?:request|goal_handle|future)'",
        "`{0}` is called without its arguments. Pass a callback without parentheses, `self.{0}`: ROS calls "
        "it, and fills in the arguments.",
    ),
    Rule(
        "AttributeError", r"type object 'str' has no attribute '_TYPE_SUPPORT'",
        "The arguments are in the wrong order: first the type, then the name, as in "
        "create_service(SetBool, '/arm', self.arm).",
    ),
    Rule(
        "TypeError", r"'(bool|int|float|str)' object is not callable",
        "The value before the parentheses is of type {0}, not a method: leave the parentheses out.",
    ),
    Rule(
        "TypeError", r"not supported between instances of '(?:\w+\.)?(deque|list|tuple)' and '(?:int|float)'",
        "A {0} is not a number: len(...) counts the items in it.",
    ),
    Rule(
        "TypeError", r"create_service\(\) missing",
        "create_service() is missing an argument: write create_service(Type, 'name', self.callback).",
    ),
    Rule(
        "TypeError", r"ActionServer\.__init__\(\) missing",
        "ActionServer() is missing an argument: write ActionServer(self, Type, 'name', self.execute).",
    ),
    Rule(
        "AttributeError", r"'ServerGoalHandle' object has no attribute '((?:succ|cancel|abort|feedb)\w*)'",
        "A goal handle has no `{0}`. It has succeed(), abort() and canceled(), publish_feedback(message), "
        "and is_cancel_requested.",
    ),
    Rule(
        "AttributeError", r"'(\w+)_Goal' object has no attribute 'request'",
        "The goal callback receives the goal itself, not a goal handle: leave out `.request`.",
    ),
    Rule(
        "AttributeError", r"'ServerGoalHandle' object has no attribute '(\w+)'",
        "The client's request is in the goal handle: `goal_handle.request.{0}`.",
    ),
    Rule(
        "AttributeError", r"'\w+_FeedbackMessage' object has no attribute '(\w+)'",
        "The message of a feedback callback has the feedback inside: `msg.feedback.{0}`.",
    ),
    Rule(
        "AttributeError", r"'\w+_GetResult_Response' object has no attribute '(\w+)'",
        "The final response has two parts, a status and the result: `future.result().result.{0}`.",
    ),
    Rule(
        "AttributeError", r"'\w+_Result' object has no attribute 'status'",
        "The status is next to the result, not in it: `future.result().status`.",
    ),
    Rule(
        "AttributeError", r"'ClientGoalHandle' object has no attribute '(?:reject|accept)\w*'",
        "The field `accepted` says whether the goal was accepted, True or False: `if not "
        "goal_handle.accepted:`.",
    ),
    Rule(
        "AttributeError", r"'ActionClient' object has no attribute '(cancel_goal_async|get_result_async)'",
        "A client sends goals; everything about one goal goes through its goal handle, which the first "
        "response contains: `self.goal_handle.{0}()`.",
    ),
    Rule(
        "AttributeError", r"type object '(\w+)' has no attribute '_time_source'",
        "A node is needed there, not its class: `node = {0}()`, with parentheses, creates one.",
    ),
    Rule(
        "AttributeError", r"object attribute '(\w+)' is read-only",
        "`{0}` was set in the class of this message before, because the parentheses of `result = "
        "Spin.Result()` were missing. Add them, and restart the kernel: until then the class stays changed.",
    ),
    Rule(
        "AttributeError", r"'ClientGoalHandle' object has no attribute '\w+'",
        "The first response only says whether the goal was accepted. The result comes later: "
        "`goal_handle.get_result_async().add_done_callback(self.on_result)`.",
    ),
    Rule(
        "AttributeError", r"^(\w+) cannot be modified after node creation",
        "Every node has a `{0}` of its own: take another name, such as `self.my_{0}`.",
    ),
    Rule(
        "RCLError", r"invalid transition from state EXECUTING with event CANCELED",
        "canceled() is for a goal that a client wants to cancel: call it only when "
        "goal_handle.is_cancel_requested is True; abort() is for what went wrong.",
    ),
    Rule(
        "RCLError", r"invalid transition from state (SUCCEEDED|ABORTED|CANCELED)",
        "The goal has ended already: call one of succeed(), abort() and canceled(), once, and then return.",
    ),
    *(
        Rule(
            error, r"existing request topic name r\w(/\S+?)(?:/_action/\w+)?Request with incompatible type",
            "Another node uses {0} with another type: client and server must use the same one.",
        )
        for error in ("RCLError", "ValueError")  # of services, of actions
    ),
    Rule(
        "RuntimeError", r"The (service|action) type provided is not valid",
        "This is not the type of a {0}. Services come from packages' `.srv`, as in `from std_srvs.srv import "
        "SetBool`; actions from `.action`, as in `from example_interfaces.action import Fibonacci`.",
    ),
)  # fmt: skip
