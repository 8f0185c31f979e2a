"""Calls of `point` between the statements of a student's functions, where threads can be preempted.

A file is parsed once. Lines and tracebacks of the rewritten code are those of the original.
"""

from __future__ import annotations
import __future__

import ast
import linecache
from collections import defaultdict
from collections.abc import Iterator
from inspect import CO_NESTED
from types import CodeType
from typing import Any, NamedTuple

POINT = "__preemption_point__"
NO_SOURCE = "its source code is not available"
CHANGED = "its source code has changed since it was loaded"
READ, WRITE, CALL = "reads", "writes", "calls"
_FUTURES = 0
for _name in __future__.all_feature_names:
    _FUTURES |= getattr(__future__, _name).compiler_flag & ~CO_NESTED
_Function = ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda


class Access(NamedTuple):
    """A statement's access to an attribute of an object, or to a name that functions share.

    base: the variable that holds the object; "" for a shared name. method: the one that is called.
    """

    kind: str
    base: str
    name: str
    method: str = ""


class Source:
    """One file, or one cell: its functions with points, and what each of its lines reads and writes."""

    def __init__(self, filename: str, lines: list[str], futures: int) -> None:
        self.lines = lines
        self.accesses: dict[int, list[Access]] = defaultdict(list)  # before a line; -line: after it
        self.imports: list[tuple[str, int]] = []  # names of modules, and how many levels up they are relative
        self._codes: dict[tuple[str, int], list[tuple[CodeType, CodeType]]] = defaultdict(list)
        self.is_known = False
        text = "".join(lines)
        try:
            tree = ast.parse(text)
            plain = compile(text, filename, "exec", flags=futures, dont_inherit=True)
            self.imports = list(_imports(tree))
            _AddPoints(tree, self.accesses).visit(tree)
            whole = compile(tree, filename, "exec", flags=futures, dont_inherit=True)
            pairs = list(zip(_codes(plain), _codes(whole), strict=True))
        except (SyntaxError, ValueError, RecursionError):
            return
        for original, rewritten in pairs:
            self._codes[original.co_qualname, original.co_firstlineno].append((original, rewritten))
        self.is_known = bool(text)

    def with_points(self, code: CodeType) -> CodeType | str:
        """The same code with points, or why there is none."""
        if not self.is_known:
            return NO_SOURCE
        found = self._codes[code.co_qualname, code.co_firstlineno]
        same = [new for old, new in found if old == code or new is code]
        if not same and any(name.startswith("@py") for name in code.co_names):  # pytest rewrites asserts
            same = [new for old, new in found if old.co_freevars == code.co_freevars]
        return same[0] if same else CHANGED


_sources: dict[tuple[str, int], Source] = {}


def source_of(code: CodeType) -> Source:
    """The file that a function comes from; it is parsed once as long as it does not change."""
    key = code.co_filename, code.co_flags & _FUTURES | ast.PyCF_ALLOW_TOP_LEVEL_AWAIT
    lines = linecache.getlines(code.co_filename)
    found = _sources.get(key)
    if found is None or (found.lines is not lines and found.lines != lines):
        found = _sources[key] = Source(code.co_filename, lines, key[1])
    return found


def _codes(code: CodeType) -> Iterator[CodeType]:
    yield code
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from _codes(constant)


def _imports(tree: ast.AST) -> Iterator[tuple[str, int]]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from ((alias.name, 0) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            module = node.module or ""
            yield module, node.level
            yield from ((f"{module}.{alias.name}".lstrip("."), node.level) for alias in node.names)


class _AddPoints(ast.NodeTransformer):
    """Adds a call before each statement inside a function, other than its docstring, and after each write."""

    def __init__(self, tree: ast.AST, accesses: dict[int, list[Access]]) -> None:
        declared = (node for node in ast.walk(tree) if isinstance(node, ast.Global | ast.Nonlocal))
        self._shared = {name for node in declared for name in node.names}
        self._accesses = accesses
        self._inside = False

    def _visit_inside(self, node: Any, inside: bool) -> None:
        before, self._inside = self._inside, inside
        self.generic_visit(node)
        self._inside = before

    def visit_FunctionDef(self, node: Any) -> Any:
        self._visit_inside(node, True)
        return node

    visit_AsyncFunctionDef = visit_FunctionDef

    def visit_Lambda(self, node: ast.Lambda) -> ast.Lambda:
        self._visit_inside(node, True)
        self._note(node.body, node.body.lineno)
        node.body = ast.copy_location(ast.BoolOp(ast.Or(), [_call(node.body), node.body]), node.body)
        return node

    def visit_ClassDef(self, node: ast.ClassDef) -> ast.ClassDef:
        self._visit_inside(node, False)
        return node

    def generic_visit(self, node: ast.AST) -> ast.AST:
        for name, value in ast.iter_fields(node):
            if isinstance(value, list) and value and isinstance(value[0], ast.stmt):
                docstring = isinstance(node, _Function) and ast.get_docstring(node, clean=False) is not None
                setattr(node, name, [*value[:docstring], *self._block(value[docstring:])])
            elif isinstance(value, list):
                for item in value:
                    if isinstance(item, ast.AST):
                        self.visit(item)
            elif isinstance(value, ast.AST):
                self.visit(value)
        return node

    def _block(self, statements: list[ast.stmt]) -> Iterator[ast.stmt]:
        for statement in statements:
            if self._inside:
                yield ast.copy_location(ast.Expr(_call(statement)), statement)
                writes = self._note(statement, statement.lineno)
            yield self.visit(statement)
            if self._inside and writes:
                yield ast.copy_location(ast.Expr(_call(statement, after=True)), statement)

    def _note(self, statement: ast.AST, line: int) -> bool:
        """Store what a statement itself reads, writes and calls; whether it writes anything."""
        found = list(dict.fromkeys(self._found(statement)))
        writes = [access for access in found if access.kind == WRITE]
        self._accesses[line] += [access for access in found if access.kind != WRITE]
        self._accesses[-line] += writes
        return bool(writes)

    def _found(self, node: Any) -> Iterator[Access]:
        attribute = _attribute(node.func.value) if _is_method(node) else None
        if attribute:
            yield Access(CALL, *attribute, node.func.attr)
        elif isinstance(node, ast.AugAssign):
            yield from (access._replace(kind=READ) for access in self._found(node.target))
        elif isinstance(node, ast.Subscript) and isinstance(node.ctx, ast.Store | ast.Del):
            yield from (access._replace(kind=WRITE) for access in self._found(node.value))
            yield from self._found(node.slice)
            return
        elif isinstance(node, ast.Attribute | ast.Name):
            named = _attribute(node) or (("", node.id) if getattr(node, "id", "") in self._shared else None)
            if named:
                yield Access(READ if isinstance(node.ctx, ast.Load) else WRITE, *named)
        for child in [] if attribute else ast.iter_child_nodes(node):
            if not isinstance(child, ast.stmt | _Function | ast.ExceptHandler | ast.match_case):
                yield from self._found(child)
        for child in node.args if attribute else []:
            yield from self._found(child)


def _is_method(node: ast.AST) -> bool:
    return isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute)


def _attribute(node: ast.AST) -> tuple[str, str] | None:
    """The variable and the attribute of it that an expression such as `self.count` names."""
    if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
        return node.value.id, node.attr
    return None


def _call(node: Any, after: bool = False) -> ast.expr:
    call = ast.Call(ast.Name(POINT, ast.Load()), [ast.Constant(-node.lineno if after else node.lineno)], [])
    return ast.fix_missing_locations(ast.copy_location(call, node))
