"""Where a None came from that an exception complains of: a function that returns no value."""

from __future__ import annotations

import ast
import inspect
import linecache
import re
import sys
from collections.abc import Callable, Iterator
from types import CodeType, FrameType, TracebackType
from typing import Any

from sim.notebook.class_source import Function, function_tree, methods_of

_COMPLAINT = "NoneType"
_OF_A_RESULT = "is not iterable|is not subscriptable|cannot unpack"
_Place = tuple[int, int]  # line and column
_CONTAINERS = (list, dict, set)
# Their methods that change them, and return None.
_CHANGES = {"add", "append", "clear", "discard", "extend", "insert", "remove", "reverse", "sort", "update"}


def none_origin(error: BaseException, is_library: Callable[[str], bool]) -> str:
    """A sentence about the function whose missing return value the error complains of; "" for any other.

    is_library: whether a source file is no code of the user's.
    """
    if not isinstance(error, AttributeError | TypeError) or _COMPLAINT not in str(error):
        return ""
    at = _innermost(error.__traceback__, is_library)
    tree = at and _tree(at.tb_frame.f_code.co_filename)
    failed = at and tree and _failed_part(tree, at)
    if not (at and tree and failed):
        return ""
    scope = _enclosing(tree, failed) or tree
    of_result = at.tb_next is None and re.search(_OF_A_RESULT, str(error)) is not None
    operands = _operands(failed, tree, of_result)
    for call in (call for operand in operands for call in _calls(operand, scope, at.tb_frame)):
        sentence = _sentence(call, at.tb_frame, is_library)
        if sentence:
            return sentence
    return ""


def _sentence(call: ast.Call, frame: FrameType, is_library: Callable[[str], bool]) -> str:
    name = ast.unparse(call.func)
    changes = isinstance(call.func, ast.Attribute) and call.func.attr in _CHANGES
    owner = _value(call.func.value, frame) if isinstance(call.func, ast.Attribute) else None
    if changes and type(owner) in _CONTAINERS:
        return f"`{name}` changes the {type(owner).__name__} itself and returns None."
    function = _value(call.func, frame)
    code = getattr(inspect.unwrap(function) if callable(function) else None, "__code__", None)
    tree = function_tree(function) if isinstance(code, CodeType) else None
    if tree is None or code is None:
        return ""
    own = list(_own_parts(tree))
    given = [part for part in own if isinstance(part, ast.Return) and not _is_none(part.value)]
    if any(isinstance(part, ast.Yield | ast.YieldFrom) for part in own) or isinstance(
        tree.body[-1], ast.Raise
    ):
        return ""
    if is_library(code.co_filename):
        return "" if given else f"`{name}` never returns a value: it gives None."
    bare = sum(isinstance(part, ast.Return) for part in own) - len(given)
    if given and not (bare or _falls_through(tree.body)):
        return ""  # what it returns was None
    if given:
        return f"`{name}` returned None: not every path through it ends with `return` and a value."
    last = tree.body[-1]
    value = last.targets[0] if isinstance(last, ast.Assign) else None
    end = (
        f"End it with `return {value.id}`."
        if isinstance(value, ast.Name)
        else "End it with `return` and a value."
    )
    return f"`{name}` returned None, because it has no `return` with a value. {end}"


def _innermost(traceback: TracebackType | None, is_library: Callable[[str], bool]) -> TracebackType | None:
    found = None
    while traceback is not None:
        if not is_library(traceback.tb_frame.f_code.co_filename):
            found = traceback
        traceback = traceback.tb_next
    return found


def _tree(file: str) -> ast.Module | None:
    try:
        return ast.parse("".join(linecache.getlines(file)))
    except (SyntaxError, ValueError):
        return None


def _failed_part(tree: ast.Module, at: TracebackType) -> ast.AST | None:
    """The expression, or the loop, whose evaluation failed."""
    place = list(at.tb_frame.f_code.co_positions())[at.tb_lasti // 2]
    for part in ast.walk(tree):
        if isinstance(part, ast.expr | ast.For | ast.AsyncFor) and place == (
            part.lineno, part.end_lineno, part.col_offset, part.end_col_offset
        ):  # fmt: skip
            return part
    return None


def _operands(part: ast.AST, tree: ast.Module, of_result: bool) -> list[ast.expr]:
    """The expressions of which one was None. of_result: a call's own result may be it, too."""
    match part:
        case ast.Tuple(ctx=ast.Store()):
            assigned = (each for each in ast.walk(tree) if isinstance(each, ast.Assign))
            return [each.value for each in assigned if part in each.targets]
        case ast.Attribute() | ast.Subscript() | ast.Await() | ast.FormattedValue() | ast.Starred():
            return [part.value]
        case ast.JoinedStr():  # until Python 3.12 its parts have no places of their own
            return [each.value for each in part.values if isinstance(each, ast.FormattedValue)]
        case ast.BinOp():
            return [part.left, part.right]
        case ast.Compare():
            return [part.left, *part.comparators]
        case ast.UnaryOp():
            return [part.operand]
        case ast.For() | ast.AsyncFor():
            return [part.iter]
        case ast.ListComp() | ast.SetComp() | ast.GeneratorExp() | ast.DictComp():
            return [part.generators[0].iter]
        case ast.Call():
            given = [each.value if isinstance(each, ast.Starred) else each for each in part.args]
            given += [each.value for each in part.keywords]
            return [part, *given] if of_result else given
    return [part] if isinstance(part, ast.expr) else []


def _calls(operand: ast.expr, scope: ast.AST, frame: FrameType) -> Iterator[ast.Call]:
    """The calls that the operand's value may come from."""
    value = operand.value if isinstance(operand, ast.Await) else operand
    if isinstance(value, ast.Call):
        yield value
        return
    if not isinstance(value, ast.Name | ast.Attribute) or _value(value, frame) is not None:
        return
    given = _last_assigned(value, scope)
    if given is None and isinstance(value, ast.Attribute):
        methods = methods_of(type(_value(value.value, frame)))
        values = [each for method in methods.values() for each in _assigned(value, method).values()]
        given = values[0] if len(values) == 1 else None
    given = given.value if isinstance(given, ast.Await) else given
    if isinstance(given, ast.Call):
        yield given


def _last_assigned(target: ast.expr, scope: ast.AST) -> ast.expr | None:
    """Return what was assigned to a name last before it is used there."""
    here = target.lineno, target.col_offset
    before = {at: value for at, value in _assigned(target, scope).items() if at <= here}
    return before[max(before)] if before else None


def _assigned(target: ast.expr, scope: ast.AST) -> dict[_Place, ast.expr]:
    """All that is assigned to a name or an attribute, by place; a tuple of targets stands for its values."""
    name = ast.unparse(target)
    found: dict[_Place, ast.expr] = {}
    for part in ast.walk(scope):
        if isinstance(part, ast.Assign | ast.AnnAssign | ast.NamedExpr) and part.value is not None:
            for each in part.targets if isinstance(part, ast.Assign) else [part.target]:
                parts = each.elts if isinstance(each, ast.Tuple | ast.List) else [each]
                if name in map(ast.unparse, parts):
                    place = part.end_lineno or 0, part.end_col_offset or 0
                    found[place] = part.value if each in parts else each
    return found


def _value(expression: ast.expr, frame: FrameType) -> Any:
    """Return what a name, or an attribute of what one means, is there; code of the user's is not executed."""
    if isinstance(expression, ast.Name):
        for names in (frame.f_locals, frame.f_globals, vars(sys.modules["builtins"])):
            if expression.id in names:
                return names[expression.id]
    if isinstance(expression, ast.Attribute):
        found = inspect.getattr_static(_value(expression.value, frame), expression.attr, None)
        return found.__func__ if isinstance(found, staticmethod | classmethod) else found
    return None


def _enclosing(tree: ast.Module, part: ast.AST) -> Function | None:
    """The innermost function around an expression."""
    around = [each for each in ast.walk(tree) if isinstance(each, Function) and part in ast.walk(each)]
    return max(around, key=lambda each: each.lineno, default=None)


def _falls_through(body: list[ast.stmt]) -> bool:
    """Return whether execution may reach the end of a block, and so return None."""
    last = body[-1]
    if isinstance(last, ast.If):
        return not last.orelse or _falls_through(last.body) or _falls_through(last.orelse)
    if isinstance(last, ast.With | ast.AsyncWith):
        return _falls_through(last.body)
    if isinstance(last, ast.Try):
        return any(_falls_through(each) for each in (last.body, *(handler.body for handler in last.handlers)))
    endless = isinstance(last, ast.While) and isinstance(last.test, ast.Constant)
    return not (endless or isinstance(last, ast.Return | ast.Raise))


def _own_parts(function: Function) -> Iterator[ast.AST]:
    """The parts of a function without those of the functions inside it."""
    waiting: list[ast.AST] = list(function.body)
    while waiting:
        part = waiting.pop()
        yield part
        if not isinstance(part, Function | ast.Lambda | ast.ClassDef):
            waiting += ast.iter_child_nodes(part)


def _is_none(value: ast.expr | None) -> bool:
    return value is None or (isinstance(value, ast.Constant) and value.value is None)
