"""Every usual mistake, made by a real node on the real rclpy, gets its own advice."""

import re

import pytest

from grader.diagnosis import find_fault
from grader.diagnosis.field_rules import FIELD_RULES
from grader.diagnosis.rules import RULES
from sim import run
from tests.students import misfits, mistakes

ADVICE = {
    mistakes.WholeNumberForFloat: "`data` takes a number with a decimal point: set `msg.data = 1.0`, not `1`; "
    "`float(value)` converts.",
    mistakes.DecimalsForWholeNumber: "`data` takes a whole number: set `msg.data = 1`, not `1.0`; `int(value)` "
    "converts.",
    mistakes.NumberForText: "`data` takes text: set `msg.data = 'text'`; `str(value)` converts.",
    mistakes.NumberForBool: "`data` takes True or False, not 1 or 0; `bool(value)` converts.",
    mistakes.NumberForByte: "`data` takes one byte, such as `b'\\x01'`, and not 1.",
    mistakes.WordsForNumbers: "`velocity` takes a list of floats: [0.0, 0.0].",
    mistakes.FractionsForWholeNumbers: "`data` takes a list of whole numbers: [0, 0].",
    mistakes.NumbersForNames: "`name` takes a list of strings: ['a', 'b'].",
    mistakes.NumbersForFlags: "`bool_array_value` takes a list of True and False: [True, False].",
    mistakes.NumbersForPoints: "`points` takes a list of JointTrajectoryPoint messages: [JointTrajectoryPoint(), "
    "JointTrajectoryPoint()].",
    mistakes.TooFewValues: "`covariance` takes a list of exactly 36 values.",
    mistakes.SuperWithoutParentheses: "Parentheses are missing after `super`: write `super().__init__('my_node')`.",
    mistakes.TimerOfSuperWithoutParentheses: "Parentheses are missing after `super`: write `super().__init__('my_node')`.",
    mistakes.PassesSelfToSuper: "`super()` passes `self` by itself: write `super().__init__('my_node')`.",
    mistakes.NumberForSubMessage: "`linear` is a message of its own, a Vector3: set the fields inside it "
    "(`msg.linear.x = 1.0`), or assign a whole Vector3().",
    mistakes.NumberTooLarge: "`data` must be an integer in [-2147483648, 2147483647]: give it a value of that kind.",
    mistakes.NamesAProperty: "A NamesAProperty already has a property `publishers`, which can't be set: choose another "
    "name, such as `my_publishers`.",
    mistakes.SetsBeyondTheLast: "The list has no item with that number: the first is number 0, the last is len(...) - 1.",
    mistakes.ForgetsTheState: "A transition's method is called with the state before it: write "
    "`def on_configure(self, state):`.",
    mistakes.ReturnsNothing: "A transition's method, such as on_configure, ends with `return "
    "TransitionCallbackReturn.SUCCESS` or FAILURE, whichever way it takes.",
    mistakes.RaisesInItsOwnWords: "",
    mistakes.MisspellsAFunction: "",
    mistakes.UnknownFieldInConstructor: "This message has no field `text`. `get_fields_and_field_types()` of its "
    "class lists the fields.",
    mistakes.FieldByPosition: "The fields of a message are set by name: `String(data=...)`, or `msg = String()` and "
    "then `msg.data = ...`.",
    mistakes.UnknownField: "Twist has no `speed`: check its spelling. For a message, `Twist.get_fields_and_field_types()` lists the fields.",
    mistakes.PublishesTheClass: "publish() takes a message, not its class: make one first with `msg = String()`.",
    mistakes.PublishesPlainText: "This publisher sends String messages, but got a plain str: put it into a message "
    "first, `msg = String()`, then `msg.data = ...`, then `publish(msg)`.",
    mistakes.PublishesAnotherType: "This publisher was created for String, but got a Float64: use the same type in "
    "create_publisher() and publish().",
    mistakes.NodeWithoutName: "A node needs a name: `super().__init__('my_node')`.",
    mistakes.StartsThreadsWithoutEnd: "A loop or a callback starts another thread each time, and none of them ends. "
    "Start one thread in `__init__`, or let a timer do the work.",
    mistakes.NodeNameWithSpace: "A node's name has only letters, digits and underscores, such as `my_node`: no "
    "spaces, dashes or slashes.",
    mistakes.TopicNameWithSpace: "A topic's name has only letters, digits, underscores and slashes, such as "
    "`/sensor/temperature`, and no part of it starts with a digit.",
    mistakes.NoSuperInit: "NoSuperInit was never set up as a node: the first line of its __init__ has to be "
    "`super().__init__('my_node')`.",
    mistakes.NoQueueLength: "create_publisher() is missing an argument. Write create_publisher(Type, 'topic', 10) or "
    "create_subscription(Type, 'topic', self.callback, 10); the last number is the length of the queue.",
    mistakes.SubscriptionWithoutCallback: "create_subscription() is missing an argument. Write "
    "create_publisher(Type, 'topic', 10) or create_subscription(Type, 'topic', self.callback, 10); the last number "
    "is the length of the queue.",
    mistakes.NameBeforeType: "The arguments are in the wrong order: first the message type, then the topic's name, "
    "as in create_publisher(String, 'topic', 10).",
    mistakes.PublishesPythonsText: "A topic carries messages, so it needs the type of a message, not one of Python's: String for str, Float64 for float, Int64 for int, Bool for bool, as in `from std_msgs.msg import "
    "String`.",
    mistakes.QueueLengthAsText: "The last argument of create_publisher() and create_subscription() is a number, such "
    "as 10, or a QoSProfile.",
    mistakes.CallbackBeforePeriod: "create_timer() takes the period first, then the callback: "
    "`self.create_timer(1.0, self.callback)`.",
    mistakes.CallbackCalled: "Pass a callback without parentheses: `self.callback`, not `self.callback()`.",
    mistakes.NegativePeriod: "The period of a timer is a number of seconds above 0: "
    "`self.create_timer(0.5, self.callback)`.",
    mistakes.LogsTwoThings: "A log line is one string: insert values with an f-string, `info(f'count: {count}')`.",
    mistakes.LogsANumber: "A log line is one string: insert values with an f-string, `info(f'count: {count}')`.",
    mistakes.TimerCallbackWithoutSelf: "A method's first parameter is `self`: write `def tick(self):`; a "
    "subscription's callback is `def tick(self, msg):`.",
    mistakes.TimerCallbackWantsMessage: "`tick` is called without 'msg'. A timer's callback takes nothing but self, a "
    "subscription's takes self and the message; anything else it needs comes from `self`, a lambda or functools.partial.",
    mistakes.SubscriptionCallbackWithoutMessage: "A subscription's callback takes the message: "
    "`def callback(self, msg):`, passed as `self.callback`.",
    mistakes.ForwardsToMethodWithoutMessage: "`obey` is called with a message: write `def obey(self, msg):`.",
    mistakes.UndeclaredParameter: "A parameter is declared before it is read: "
    "`self.declare_parameter('speed', default)`.",
    mistakes.MisspeltMethod: "There is no `self.tik`. Did you mean `self.tick`?",
    mistakes.ValueBeforeItIsSet: "`self.count` does not exist (yet): check its spelling; set it in __init__ before "
    "it is used.",
    mistakes.NothingThere: "The value before `.publish` is None: it was never set, or comes from a function without "
    "`return`.",
    mistakes.ForgottenImport: "`Imu` is not imported: write `from sensor_msgs.msg import Imu` at the top.",
    mistakes.MisspeltType: "Python doesn't know `Strng`. Did you mean `String`? Import it with `from std_msgs.msg import String`.",
    mistakes.ForgottenSelf: "Python doesn't know `count` here: it is a typo, its import is missing, or it belongs to the node, as `self.count`.",
    mistakes.ForgottenModule: "Python can't find a module `std_msg`: check its spelling. Message packages end in `_msgs` "
    "and `.msg`, as in `from std_msgs.msg import String`.",
    mistakes.WrongNameFromModule: "`std_msgs.msg` has no `Sting`: check the spelling and the capital letters.",
    mistakes.DividesByZero: "The number after `/`, `//` or `%` on that line is 0 at that moment. Check for 0 first, with `if`, and decide what should happen then.",
    mistakes.FormatsNothing: "A value in the f-string is None: it was never set, or comes from a function without "
    "`return`.",
    mistakes.OneLineForTwoLevels: "Each log call in the code has one level only: with if and else, write a separate call for each level.",
    mistakes.LevelAsText: "A level is not a string: `from rclpy.logging import LoggingSeverity`, then "
    "`LoggingSeverity.DEBUG` and so on.",
    mistakes.BeyondTheLast: "The tuple has no item with that number: the first is number 0, the last is len(...) - 1.",
    mistakes.LoggerWithoutBrackets: "Parentheses are missing before `.info`: a method is called with them, as in "
    "`self.get_logger().info(...)`.",
    mistakes.LeavesTheRaiseBelowItsCode: "Delete the line that raises, and run this cell again.",
    mistakes.NotStarted: "Write your code, delete the line that raises, and run this cell again.",
    mistakes.NotStartedWithoutWords: "Write your code, delete the line that raises, and run this cell again.",
    mistakes.main_with_namespace_without_slash: "A namespace starts with a slash: `/robot1`.",
    mistakes.main_with_space_in_a_remapping: "`chatter:=my chatter` is not a remapping. Both names are made of letters, "
    "digits, underscores and slashes.",
    mistakes.main_without_init: "rclpy.init() has to come before the first node, and rclpy.shutdown() after the last "
    "one: write `rclpy.init()` as the first line of main().",
    mistakes.main_with_two_inits: "rclpy.init() is called twice: call it once, at the start of main().",
    mistakes.main_with_two_shutdowns: "rclpy.shutdown() is called twice, or before rclpy.init(): call it once, at "
    "the end of main().",
    mistakes.main_that_publishes_after_shutdown: "Something is used after rclpy.shutdown(): make that the last line "
    "of main().",
    mistakes.main_that_logs_at_no_level: "A logger has no `warn_once`: its levels are debug, info, warning, error and "
    "fatal.",
    mistakes.main_that_misuses_a_list: "A list has no `size`: check its spelling, and what the name before the dot "
    "stands for.",
    (
        misfits.Listener,
        misfits.NumberTalker,
    ): "/listener subscribes to /chatter with the type std_msgs/msg/String, but here it is std_msgs/msg/Float64: both ends of a "
    "topic must use the same type.",
    (
        misfits.NumberTalker,
        misfits.Listener,
    ): "/talker publishes on /chatter with the type std_msgs/msg/Float64, but here it is std_msgs/msg/String: both ends of a "
    "topic must use the same type.",
}
RULES_HERE = (*FIELD_RULES, *RULES)
NAMES = [n.__name__ if callable(n) else "+".join(part.__name__ for part in n) for n in ADVICE]


def record(students):
    return run(*(students if isinstance(students, tuple) else (students,)), seconds=3, quiet=True)


@pytest.mark.parametrize("students, advice", ADVICE.items(), ids=NAMES)
def test_a_mistake_gets_its_advice(students, advice):
    assert find_fault(record(students)).hint == advice


def test_every_student_of_the_file_is_judged():
    base = {mistakes.Talker, mistakes.Listener}
    of_file = {s for s in vars(mistakes).values() if getattr(s, "__module__", "") == mistakes.__name__}
    assert of_file - base == {student for student in ADVICE if callable(student)}


def test_no_rule_stands_there_without_a_student_who_earns_it():
    earned = set()
    for students in ADVICE:
        error = record(students).errors[0]
        matches = (rule for rule in RULES_HERE if rule.type == error.type and re.search(rule.pattern, error.text))
        earned.add(next(matches, None))
    assert [rule for rule in RULES_HERE if rule not in earned] == []


def test_the_fault_names_error_callback_line_and_time():
    fault = find_fault(record(mistakes.DividesByZero))
    line = mistakes.DividesByZero.tick.__code__.co_firstlineno + 1
    assert fault.sentence == "Your code runs without an error."
    assert fault.expected == "no error"
    assert fault.saw == f"ZeroDivisionError: division by zero (in DividesByZero.tick, line {line}, at 1 s)"


def test_the_line_is_the_students_own_even_if_the_message_package_raised():
    fault = find_fault(record(mistakes.WholeNumberForFloat))
    line = mistakes.WholeNumberForFloat.tick.__code__.co_firstlineno + 2
    assert fault.saw == (
        f"AssertionError: The 'data' field must be of type 'float' (in WholeNumberForFloat.tick, line {line}, at 1 s)"
    )


def test_a_subscription_of_another_type_is_reported_in_the_words_that_rcl_lost():
    fault = find_fault(record((misfits.NumberTalker, misfits.Listener)))
    assert fault.saw.startswith(
        "RCLError: create_subscription() called for existing topic name rt/chatter with incompatible type "
        "std_msgs::msg::dds_::String_ (in Listener, line "
    )


def test_where_the_lost_words_are_not_to_be_had_the_hint_says_what_is_known():
    recording = record((misfits.NumberTalker, misfits.Listener))
    recording.stderr = ""
    assert find_fault(recording).hint == (
        "Another node uses this topic with another message type: both ends of a topic must use the same one."
    )
