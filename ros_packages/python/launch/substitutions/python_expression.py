"""The substitution `PythonExpression`."""

from __future__ import annotations

import importlib
import math
from collections.abc import Iterable

from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType, Substitution
from launch.utilities import (
    describe_substitutions,
    ensure_argument_type,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)


class PythonExpression(Substitution):
    """The value of a Python expression. It can use `python_modules`, and names in `math` directly."""

    def __init__(
        self, expression: SomeSubstitutionsType, python_modules: SomeSubstitutionsType = ("math",)
    ) -> None:
        for value, name in ((expression, "expression"), (python_modules, "python_modules")):
            ensure_argument_type(value, (str, Substitution, Iterable), name, "PythonExpression")
        self.__expression = normalize_to_list_of_substitutions(expression)
        self.__modules = normalize_to_list_of_substitutions(python_modules)

    @property
    def expression(self) -> list[Substitution]:
        """The expression."""
        return self.__expression

    @property
    def python_modules(self) -> list[Substitution]:
        """The names of the modules that the expression can use."""
        return self.__modules

    def describe(self) -> str:
        """Work like `Substitution`."""
        modules = ", ".join(sub.describe() for sub in self.python_modules)
        return f"PythonExpr({describe_substitutions(self.expression)}, [{modules}])"

    def perform(self, context: LaunchContext) -> str:
        """Work like `Substitution`."""
        names = (module.perform(context) for module in self.__modules)
        known = {name: importlib.import_module(name) for name in names}
        if "math" in known:
            known = {**vars(math), **known}
        return str(eval(perform_substitutions(context, self.__expression), {}, known))
