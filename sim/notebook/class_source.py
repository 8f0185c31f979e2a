"""The syntax trees of the methods of a user's class."""

from __future__ import annotations

import ast
import inspect
from typing import Any

Function = ast.FunctionDef | ast.AsyncFunctionDef
Methods = dict[str, Function]

LIBRARIES = ("builtins", "rclpy")  # packages whose base classes are no code of the user's


def methods_of(class_: type) -> Methods:
    """The syntax trees of the user's methods and properties by name, inherited ones included.

    A statement that calls the overridden method, as `super().name()` does, is replaced by that method's body.
    Lines are those of the file or cell.
    """
    found: Methods = {}
    own = [base for base in class_.__mro__ if base.__module__.split(".")[0] not in LIBRARIES]
    bases = tuple(base.__name__ for base in own)
    for base in reversed(own):
        for name, value in list(vars(base).items()):
            function = getattr(value, "fget", None) or getattr(value, "func", value)
            tree = function_tree(function) if inspect.isfunction(function) else None
            base_tree = found.pop(name, None)
            if tree is not None:
                found[name] = _Inherited(name, base_tree, bases).visit(tree) if base_tree else tree
    return found


def function_tree(function: Any) -> Function | None:
    """The syntax tree of a function, with the lines of its file or cell; None without source."""
    try:
        function = inspect.unwrap(function)
        source = inspect.getsource(function)
        # An indented function is put into a block, because dedenting would change strings of several lines.
        tree = ast.parse(f"if True:\n{source}" if source[:1].isspace() else f"\n{source}").body[0]
        first = function.__code__.co_firstlineno
    except (OSError, TypeError, ValueError, AttributeError, SyntaxError, IndexError):
        return None
    inner = tree.body[0] if isinstance(tree, ast.If) else tree
    return ast.increment_lineno(inner, first - 2) if isinstance(inner, Function) else None


class _Inherited(ast.NodeTransformer):
    """Puts the body of an overridden method in the place of a statement that calls it."""

    def __init__(self, name: str, base: Function, classes: tuple[str, ...]) -> None:
        self._name, self._base, self._classes = name, base, classes

    def visit_Expr(self, statement: ast.Expr) -> ast.stmt:
        """Replace `super().name()`, also with `await`."""
        return self._replaced(statement)

    def visit_Return(self, statement: ast.Return) -> ast.stmt:
        """Replace `return super().name()`."""
        return self._replaced(statement)

    def _replaced(self, statement: ast.Expr | ast.Return) -> ast.stmt:
        value = statement.value.value if isinstance(statement.value, ast.Await) else statement.value
        function = value.func if isinstance(value, ast.Call) else None
        if not isinstance(function, ast.Attribute) or function.attr != self._name:
            return statement
        owner = ast.unparse(function.value)
        if not owner.startswith("super(") and owner not in self._classes:
            return statement
        body = ast.copy_location(ast.If(ast.Constant(True), self._base.body, []), statement)
        return ast.fix_missing_locations(body)
