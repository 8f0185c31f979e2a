"""Exceptions as rclpy and Python word them, and what a beginner does about each.

The patterns are those of the versions in `sim.ros.hooks.verify.WRITTEN_FOR`. `{0}`, `{1}` ... are the
pattern's groups.
"""

from __future__ import annotations

from typing import NamedTuple


class Rule(NamedTuple):
    """One kind of error. `type` is the exception's class name, `pattern` is searched in its text."""

    type: str
    pattern: str
    advice: str


# What every rclpy node has once Node.__init__ has run; without it, one of these is missing first.
_NODE_INSIDES = (
    "_Node__\\w+|_default_callback_group|_logger|_parameters|_context|_clock|_time_source|_publishers|_subscriptions"
    "|_clients|_services|_timers|_guards|_waitables|_rate_.*"
)

RULES = (
    Rule(
        "TypeError", r"Expected <class '[\w.]*?(\w+)'>, got <class '(?:[\w.]*\.Metaclass_)(\w+)'>",
        "publish() takes a message, not its class: make one first with `msg = {0}()`.",
    ),
    Rule(
        "TypeError", r"Expected <class '[\w.]*?(\w+)'>, got <class '(str|int|float|bool)'>",
        "This publisher sends {0} messages, but got a plain {1}: put it into a message first, `msg = {0}()`, "
        "then `msg.data = ...`, then `publish(msg)`.",
    ),
    Rule(
        "TypeError", r"Expected <class '[\w.]*?(\w+)'>, got <class '[\w.]*?(\w+)'>",
        "This publisher was created for {0}, but got a {1}: use the same type in create_publisher() and "
        "publish().",
    ),
    *(
        Rule(error, pattern, "Parentheses are missing after `super`: write `super().__init__('my_node')`.")
        for error, pattern in (
            ("TypeError", r"descriptor '\w+' requires a 'super' object"),
            ("AttributeError", r"type object 'super' has no attribute"),
        )
    ),
    Rule(
        "TypeError", r"^node_init\b.*__init__\(\) takes 2 positional arguments but",
        "`super()` passes `self` by itself: write `super().__init__('my_node')`.",
    ),
    Rule(
        "TypeError", r"__init__\(\) missing 1 required positional argument: 'node_name'",
        "A node needs a name: `super().__init__('my_node')`.",
    ),
    Rule(
        "TypeError", r"create_(publisher|subscription)\(\) missing .*'qos_profile'",
        "create_{0}() is missing an argument. Write create_publisher(Type, 'topic', 10) or "
        "create_subscription(Type, 'topic', self.callback, 10); the last number is the length of the queue.",
    ),
    Rule(
        "TypeError", r"rclpy_resolve_name\(\): incompatible",
        "The arguments are in the wrong order: first the message type, then the topic's name, "
        "as in create_publisher(String, 'topic', 10).",
    ),
    Rule(
        "AttributeError", r"type object 'type' has no attribute '_TYPE_SUPPORT'",
        "A topic carries messages, so it needs the type of a message, not one of Python's: String for str, "
        "Float64 for float, Int64 for int, Bool for bool, as in `from std_msgs.msg import String`.",
    ),
    Rule(
        "TypeError", r"Expected QoSProfile or int",
        "The last argument of create_publisher() and create_subscription() is a number, such as 10, "
        "or a QoSProfile.",
    ),
    Rule(
        "TypeError", r"rclpy_logging_rcutils_log\(\): incompatible|RcutilsLogger\.\w+\(\) (?:takes|missing)",
        "A log line is one string: insert values with an f-string, `info(f'count: {{count}}')`.",
    ),
    Rule(
        "TypeError", r"float\(\) argument must be a string or a real number, not "
        r"'(?:method|function|builtin_\w+)'",
        "create_timer() takes the period first, then the callback: `self.create_timer(1.0, self.callback)`.",
    ),
    Rule(
        "TypeError", r"'NoneType' object is not callable",
        "Pass a callback without parentheses: `self.callback`, not `self.callback()`.",
    ),
    Rule(
        "TypeError", r"(\w+)\.__init__\(\) takes 1 positional argument but \d+ were given",
        "The fields of a message are set by name: `{0}(data=...)`, or `msg = {0}()` and then "
        "`msg.data = ...`.",
    ),
    Rule(
        "TypeError", r"(\w+)\(\) takes 0 positional arguments but \d+ (?:was|were) given",
        "A method's first parameter is `self`: write `def {0}(self):`; a subscription's callback is "
        "`def {0}(self, msg):`.",
    ),
    Rule(
        "TypeError", r"\b(on_(?:configure|(?:de)?activate|cleanup|shutdown|error))\(\) takes 1 positional",
        "A transition's method is called with the state before it: write `def {0}(self, state):`.",
    ),
    Rule(
        "TypeError", r"(\w+)\(\) takes 1 positional argument but 2 were given",
        "`{0}` is called with a message: write `def {0}(self, msg):`.",
    ),
    Rule(
        "TypeError", r"(\w+)\(\) missing \d+ required positional arguments?: (.+)",
        "`{0}` is called without {1}. A timer's callback takes nothing but self, a subscription's takes self "
        "and the message; anything else it needs comes from `self`, a lambda or functools.partial.",
    ),
    Rule(
        "TypeError", r"unsupported format string passed to NoneType",
        "A value in the f-string is None: it was never set, or comes from a function without `return`.",
    ),
    Rule(
        "ValueError", r"Logger severity cannot be changed between calls",
        "Each log call in the code has one level only: with if and else, write a separate call for each "
        "level.",
    ),
    Rule(
        "ValueError", r"'(\w+)' is not a valid LoggingSeverity",
        "A level is not a string: `from rclpy.logging import LoggingSeverity`, then `LoggingSeverity.DEBUG` "
        "and so on.",
    ),
    Rule(
        "IndexError", r"\b(list|tuple|string|deque|array|range object)(?: assignment)? index out of range",
        "The {0} has no item with that number: the first is number 0, the last is len(...) - 1.",
    ),
    Rule(
        "RuntimeError", r"callback should be either be callable with one argument",
        "A subscription's callback takes the message: `def callback(self, msg):`, passed as `self.callback`.",
    ),
    Rule(
        "RuntimeError", r"can't start new thread",
        "A loop or a callback starts another thread each time, and none of them ends. Start one thread in "
        "`__init__`, or let a timer do the work.",
    ),
    Rule(
        "RuntimeError", r"Context\.init\(\) must only be called once",
        "rclpy.init() is called twice: call it once, at the start of main().",
    ),
    Rule(
        "RuntimeError", r"Context must be initialized before it can be shutdown",
        "rclpy.shutdown() is called twice, or before rclpy.init(): call it once, at the end of main().",
    ),
    Rule(
        "NotInitializedException", r"",
        "rclpy.init() has to come before the first node, and rclpy.shutdown() after the last one: "
        "write `rclpy.init()` as the first line of main().",
    ),
    Rule(
        "RCLError", r"Failed to create subscription: invalid allocator",
        "Another node uses this topic with another message type: both ends of a topic must use the same one.",
    ),
    Rule(
        "RCLError", r"context is invalid",
        "Something is used after rclpy.shutdown(): make that the last line of main().",
    ),
    Rule(
        "RCLError", r"timer period must be non-negative",
        "The period of a timer is a number of seconds above 0: `self.create_timer(0.5, self.callback)`.",
    ),
    Rule(
        "InvalidNodeNameException", r"",
        "A node's name has only letters, digits and underscores, such as `my_node`: no spaces, "
        "dashes or slashes.",
    ),
    Rule(
        "InvalidTopicNameException", r"",
        "A topic's name has only letters, digits, underscores and slashes, such as `/sensor/temperature`, "
        "and no part of it starts with a digit.",
    ),
    Rule(
        "RCLInvalidROSArgsError", r"remap rule: '-r __ns:=(\w+)'",
        "A namespace starts with a slash: `/{0}`.",
    ),
    Rule(
        "RCLInvalidROSArgsError", r"remap rule: '-r (.+?)'",
        "`{0}` is not a remapping. Both names are made of letters, digits, underscores and slashes.",
    ),
    Rule(
        "ParameterNotDeclaredException", r"(\w+)$",
        "A parameter is declared before it is read: `self.declare_parameter('{0}', default)`.",
    ),
    Rule(
        "ModuleNotFoundError", r"No module named '([\w.]+)'",
        "Python can't find a module `{0}`: check its spelling. Message packages end in `_msgs` and `.msg`, "
        "as in `from std_msgs.msg import String`.",
    ),
    Rule(
        "ImportError", r"cannot import name '(\w+)' from '([\w.]+)'",
        "`{1}` has no `{0}`: check the spelling and the capital letters.",
    ),
    Rule(
        "AttributeError", r"property '(\w+)' of '(\w+)' object has no setter",
        "A {1} already has a property `{0}`, which can't be set: choose another name, such as `my_{0}`.",
    ),
    Rule(
        "AttributeError", rf"'(\w+)' object has no attribute '(?:{_NODE_INSIDES})'",
        "{0} was never set up as a node: the first line of its __init__ has to be "
        "`super().__init__('my_node')`.",
    ),
    Rule(
        "AttributeError", r"object has no attribute 'to_label'",
        "A transition's method, such as on_configure, ends with `return TransitionCallbackReturn.SUCCESS` or "
        "FAILURE, whichever way it takes.",
    ),
    Rule(
        "AttributeError", r"'(?:function|method|builtin_function_or_method)' object has no attribute '(\w+)'",
        "Parentheses are missing before `.{0}`: a method is called with them, as in "
        "`self.get_logger().info(...)`.",
    ),
    Rule(
        "AttributeError", r"'RcutilsLogger' object has no attribute '(\w+)'",
        "A logger has no `{0}`: its levels are debug, info, warning, error and fatal.",
    ),
    Rule(
        "AttributeError", r"'NoneType' object has no attribute '(\w+)'",
        "The value before `.{0}` is None: it was never set, or comes from a function without `return`.",
    ),
)  # fmt: skip
