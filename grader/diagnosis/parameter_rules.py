"""Exceptions around parameters, as `rules` has those around topics."""

from __future__ import annotations

from grader.diagnosis.rules import Rule

PARAMETER_RULES = (
    Rule(
        "InvalidParameterTypeException", r"'(.+)' to '(.*)' of type '(\w+)', expecting type '(\w+)'",
        "The parameter `{0}` got {1}, which is of type {2}, but it is declared as {3}: its default says so. "
        "`1` and `1.0` are two types; use the same one in both places.",
    ),
    Rule(
        "InvalidParameterValueException", r"Callback returned an invalid type: (.+)",
        "The check has to return a SetParametersResult for each value, also for one that is fine: end it "
        "with `return SetParametersResult(successful=True)`.",
    ),
    Rule(
        "InvalidParameterValueException", r"value \((.*)\) for parameter\. Reason: .*: (.+)",
        "The check refuses {0}, with which `{1}` starts: its default, or the value that the program was "
        "given. Which values does it let through?",
    ),
    Rule(
        "ParameterAlreadyDeclaredException", r"\['(.+)'\]",
        "The parameter `{0}` is declared twice: call declare_parameter('{0}', default) once, in __init__.",
    ),
    Rule(
        "ParameterUninitializedException", r"The parameter '(.+)' is not initialized",
        "The parameter `{0}` has no value: it was declared without one, and the start gave none. Declare it "
        "with a default, declare_parameter('{0}', 1.0), or give the program "
        "parameters={{'{0}': ...}}.",
    ),
    Rule(
        "TypeError", r"parameter must be instance of type '<class 'rclpy\.parameter\.Parameter'>'",
        "set_parameters() takes a list of parameters: `[Parameter('name', value=1.0)]`, with "
        "`from rclpy.parameter import Parameter`.",
    ),
    Rule(
        "TypeError", r"unsupported operand .*'Parameter'",
        "A parameter is not a number, it has one in it: `self.get_parameter('name').value`.",
    ),
    Rule(
        "TypeError", r"SetParametersResult\.__init__\(\) takes 1 positional argument",
        "The fields of a result are set by name: SetParametersResult(successful=True), or "
        "SetParametersResult(successful=False, reason='...').",
    ),
    Rule(
        "TypeError", r"takes the class, not an object of it: write \w+\((\w+)\)",
        "The class itself is handed over, without brackets after its name: {0}, not {0}().",
    ),
    Rule(
        "TypeError", r"Process\.__init__\(\) got an unexpected keyword argument '(\w+)'",
        "A Process takes parameters as a dictionary, names and values: "
        "`Process(NodeClass, parameters={{'{0}': ...}})`.",
    ),
    Rule(
        "AttributeError", r"'(\w+)' object has no attribute 'items'",
        "A dictionary is wanted there, names and values, and a {0} came: write `{{'name': value}}`.",
    ),
    Rule(
        "KeyError", r"^'(.*)'$",
        "The dictionary has no '{0}': is it a typo? Where it comes from outside, refuse what is not "
        "in the dictionary: `if value not in dictionary:`.",
    ),
    Rule(
        "TypeError", r"Callback must be callable",
        "A callback is handed over without parentheses: `add_on_set_parameters_callback(self.check)`.",
    ),
    Rule(
        "AttributeError", r"'list' object has no attribute '(name|value)'",
        "The check gets a list, for several parameters may be set at once: `for parameter in parameters:`, "
        "and then `parameter.{0}`.",
    ),
    Rule(
        "AttributeError", r"'Future' object has no attribute '(\w+)'",
        "A future is the box in which the answer comes: `await` it first, or take `future.result().{0}` in "
        "its done callback.",
    ),
)  # fmt: skip
