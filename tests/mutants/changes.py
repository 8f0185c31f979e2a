"""The mutants of a module: each is one small change of its syntax tree."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

TINY = 1e-5  # a smaller constant is a tolerance for rounding, which may well be half or twice as large
COMPARED: dict[type[ast.cmpop], type[ast.cmpop]] = {
    ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt,
    ast.Eq: ast.NotEq, ast.NotEq: ast.Eq, ast.Is: ast.IsNot, ast.IsNot: ast.Is,
    ast.In: ast.NotIn, ast.NotIn: ast.In,
}  # fmt: skip
COMPUTED: dict[type[ast.operator], type[ast.operator]] = {
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult,
    ast.FloorDiv: ast.Mult, ast.Mod: ast.Mult, ast.Pow: ast.Mult, ast.BitAnd: ast.BitOr,
}  # fmt: skip
CALLED = {"min": "max", "max": "min", "any": "all", "all": "any", "floor": "ceil", "ceil": "floor"}
UNWRAPPED = "abs", "sorted", "reversed"  # a call of one of these becomes its argument
NOT_VISITED = "annotation", "returns", "type_params", "format_spec", "pattern"  # fields of nodes
NOT_DROPPED = "strict", "key"  # keyword arguments


Function = tuple[str, int]  # qualified name, and first line with its decorators


@dataclass(frozen=True)
class Mutant:
    """A change of a tree.

    line: of the change. statement: line of the innermost statement around it.
    function: the outermost one whose body has it; None at module level.
    """

    line: int
    statement: int
    function: Function | None
    before: str
    after: str
    parent: ast.AST
    field: str
    index: int | None
    new: ast.AST

    def apply(self) -> ast.AST:
        """Make the change, and return what was there before."""
        return _put(self.parent, self.field, self.index, self.new)


def mutants_of(tree: ast.Module) -> list[Mutant]:
    """All mutants of a module, by their place in it."""
    return [mutant for place in _places(tree, [], None, 1) for mutant in _mutants_at(*place)]


Place = tuple[ast.AST, str, int | None, ast.AST, int, Function | None]


def _places(node: ast.AST, names: list[str], function: Function | None, statement: int) -> Iterator[Place]:
    """Each place in a tree that may be changed: parent, field, index, node, statement and function."""
    for field, index, child in _children(node):
        if _is_left_alone(node, field, child):
            continue
        inner_names, line = names, child.lineno if isinstance(child, ast.stmt) else statement
        if isinstance(child, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            inner_names = [*names, child.name]
        inner = function
        if function is None and field == "body" and isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            first = min([node.lineno, *(decorator.lineno for decorator in node.decorator_list)])
            inner = ".".join(names), first
        yield node, field, index, child, line, inner
        yield from _places(child, inner_names, inner, line)


def _children(node: ast.AST) -> Iterator[tuple[str, int | None, ast.AST]]:
    for field, value in ast.iter_fields(node):
        if isinstance(value, list):
            yield from ((field, n, item) for n, item in enumerate(value) if isinstance(item, ast.AST))
        elif isinstance(value, ast.AST):
            yield field, None, value


def _is_left_alone(parent: ast.AST, field: str, node: ast.AST) -> bool:
    """Whether nothing in it is changed: types, documentation, names, how a dataclass is made."""
    if field in NOT_VISITED or isinstance(node, ast.Import | ast.ImportFrom):
        return True
    if isinstance(node, ast.Constant) and isinstance(parent, ast.Expr | ast.JoinedStr):
        return True
    if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
        return True
    if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__":
        return True
    if isinstance(node, ast.keyword) and node.arg == "strict":
        return True
    return field == "decorator_list" and "dataclass" in ast.unparse(node)


def _mutants_at(
    parent: ast.AST,
    field: str,
    index: int | None,
    node: ast.AST,
    statement: int,
    function: Function | None,
) -> Iterator[Mutant]:
    alone = isinstance(node, ast.stmt) or hasattr(parent, "body") or isinstance(parent, ast.FormattedValue)
    shown = node if alone else parent
    for new in _changes(node, parent, field):
        ast.fix_missing_locations(ast.copy_location(new, node))
        before = _first_line(shown)
        _put(parent, field, index, new)
        after = _first_line(new if alone else parent)
        _put(parent, field, index, node)
        if before != after:
            line = getattr(node, "lineno", statement)
            yield Mutant(line, statement, function, before, after, parent, field, index, new)


def _put(parent: ast.AST, field: str, index: int | None, new: ast.AST) -> ast.AST:
    if index is None:
        old = getattr(parent, field)
        setattr(parent, field, new)
    else:
        old = getattr(parent, field)[index]
        getattr(parent, field)[index] = new
    return old


def _first_line(node: ast.AST) -> str:
    return ast.unparse(node).strip().split("\n")[0]


def _changes(node: ast.AST, parent: ast.AST, field: str) -> Iterator[ast.AST]:
    """What may stand in the place of a node."""
    yield from _instead_of_a_statement(node, parent)
    match node:
        case ast.Compare(left=left, ops=ops, comparators=others):
            for n, op in enumerate(ops):
                yield ast.Compare(left, [*ops[:n], COMPARED[type(op)](), *ops[n + 1 :]], others)
        case ast.BoolOp(op=op, values=values):
            yield ast.BoolOp(ast.Or() if isinstance(op, ast.And) else ast.And(), values)
            for n in range(len(values)):
                rest = [*values[:n], *values[n + 1 :]]
                yield rest[0] if len(rest) == 1 else ast.BoolOp(op, rest)
        case ast.UnaryOp(op=ast.Not() | ast.USub(), operand=operand):
            yield operand
        case ast.BinOp(left=left, op=op, right=right) if type(op) in COMPUTED and not _has_text(left, right):
            yield ast.BinOp(left, COMPUTED[type(op)](), right)
        case ast.Constant(value=value):
            yield from map(ast.Constant, _other_values(value))
        case ast.JoinedStr() if " " in ast.unparse(node):
            yield ast.Constant("")
        case ast.Call():
            yield from _other_calls(node)
    is_condition = field in ("test", "ifs", "guard") and not isinstance(parent, ast.Assert)
    if is_condition and not isinstance(node, ast.Compare | ast.BoolOp | ast.UnaryOp | ast.Constant):
        yield ast.UnaryOp(ast.Not(), node)


def _instead_of_a_statement(node: ast.AST, parent: ast.AST) -> Iterator[ast.AST]:
    match node:
        case ast.AugAssign(target=target, op=op, value=value):
            yield ast.Pass()
            if type(op) in COMPUTED:
                yield ast.AugAssign(target, COMPUTED[type(op)](), value)
        case ast.Expr(value=ast.Call()) | ast.Raise():
            yield ast.Pass()
        case ast.Assign() if isinstance(parent, ast.If | ast.For | ast.While | ast.With | ast.Try):
            yield ast.Pass()
        case ast.Return(value=ast.expr() as value) if not _is_empty(value):
            yield ast.Return(ast.Constant(None))
        case ast.Continue():
            yield ast.Break()
        case ast.Break():
            yield ast.Continue()


def _is_empty(value: ast.expr) -> bool:
    """Whether it is None, "" or the like: what takes it can seldom tell them apart."""
    try:
        return not ast.literal_eval(value)
    except ValueError:
        return False


def _has_text(*nodes: ast.AST) -> bool:
    return any(
        isinstance(node, ast.JoinedStr) or (isinstance(node, ast.Constant) and isinstance(node.value, str))
        for node in nodes
    )


def _other_values(value: Any) -> tuple[Any, ...]:
    """Numbers a little larger and smaller, the other truth, and no words in place of some."""
    match value:
        case bool():
            return (not value,)
        case int():
            return value + 1, value - 1
        case float() if value == 0.0:
            return (1.0,)
        case float() if value < TINY:
            return 0.0, 1000 * value
        case float():
            return round(value * 1.25, 12), round(value * 0.8, 12)
        case str() if " " in value:
            return ("",)
    return ()


def _other_calls(call: ast.Call) -> Iterator[ast.AST]:
    """A call of another function, the argument alone, and calls without one of the keyword arguments."""
    name = ast.unparse(call.func)
    stem, _, last = name.rpartition(".")
    if last in CALLED:
        other = ast.parse(f"{stem}.{CALLED[last]}".lstrip("."), mode="eval").body
        yield ast.Call(other, call.args, call.keywords)
    if name in UNWRAPPED:
        yield call.args[0]
    for n, keyword in enumerate(call.keywords):
        is_truth = isinstance(keyword.value, ast.Constant) and isinstance(keyword.value.value, bool)
        if keyword.arg and keyword.arg not in NOT_DROPPED and not is_truth:
            yield ast.Call(call.func, call.args, [*call.keywords[:n], *call.keywords[n + 1 :]])
