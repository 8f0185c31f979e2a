"""Exceptions around parameters, as `rules` has those around topics."""

from __future__ import annotations

from grader.diagnosis.rules import Rule

PARAMETER_RULES = (
    Rule(
        "InvalidParameterTypeException", r"'(.+)' to '(.*)' of type '(\w+)', expecting type '(\w+)'",
        "The parameter `{0}` got {1}, which is of type {2}, but it is declared as {3}: its default decides "
        "that. `1` and `1.0` have different types; use the same one in both places.",
    ),
    Rule(
        "InvalidParameterValueException", r"Callback returned an invalid type: (.+)",
        "The check has to return a SetParametersResult for every value, even for a valid one: end it with "
        "`return SetParametersResult(successful=True)`.",
    ),
    Rule(
        "InvalidParameterValueException", r"value \((.*)\) for parameter\. Reason: .*: (.+)",
        "The check refuses {0}, the value that `{1}` starts with: its default, or the one that the program "
        "was given. Which values does the check accept?",
    ),
    Rule(
        "ParameterAlreadyDeclaredException", r"\['(.+)'\]",
        "The parameter `{0}` is declared twice: call declare_parameter('{0}', default) once, in __init__.",
    ),
    Rule(
        "ParameterUninitializedException", r"The parameter '(.+)' is not initialized",
        "The parameter `{0}` has no value: it was declared without one, and none was given at the start. "
        "Declare it with a default, declare_parameter('{0}', 1.0), or give the program parameters={{'{0}': "
        "...}}.",
    ),
    Rule(
        "TypeError", r"parameter must be instance of type '<class 'rclpy\.parameter\.Parameter'>'",
        "set_parameters() takes a list of parameters: `[Parameter('name', value=1.0)]`, with "
        "`from rclpy.parameter import Parameter`.",
    ),
    Rule(
        "TypeError", r"unsupported operand .*'Parameter'",
        "A parameter is not a number; it contains one: `self.get_parameter('name').value`.",
    ),
    Rule(
        "TypeError", r"SetParametersResult\.__init__\(\) takes 1 positional argument",
        "The fields of a result are set by name: SetParametersResult(successful=True), or "
        "SetParametersResult(successful=False, reason='...').",
    ),
    Rule(
        "TypeError", r"takes the class, not an object of it: write \w+\((\w+)\)",
        "Pass the class itself, without parentheses after its name: {0}, not {0}().",
    ),
    Rule(
        "TypeError", r"Process\.__init__\(\) got an unexpected keyword argument '(\w+)'",
        "A Process takes parameters as a dictionary of names and values: `Process(NodeClass, "
        "parameters={{'{0}': ...}})`.",
    ),
    Rule(
        "AttributeError", r"'(\w+)' object has no attribute 'items'",
        "A dictionary of names and values is needed there, not a {0}: write `{{'name': value}}`.",
    ),
    Rule(
        "KeyError", r"^'(.*)'$",
        "The dictionary has no key '{0}': is it a typo? If the key comes from outside, refuse any that isn't "
        "in the dictionary: `if value not in dictionary:`.",
    ),
    Rule(
        "TypeError", r"Callback must be callable",
        "Pass a callback without parentheses: `add_on_set_parameters_callback(self.check)`.",
    ),
    Rule(
        "AttributeError", r"'list' object has no attribute '(name|value)'",
        "The check receives a list, because several parameters may be set at once: loop with `for parameter "
        "in parameters:`, and use `parameter.{0}`.",
    ),
    Rule(
        "AttributeError", r"'Future' object has no attribute '(\w+)'",
        "A future has the response only once it has arrived: `await` it first, or use `future.result().{0}` "
        "in its done callback.",
    ),
)  # fmt: skip
