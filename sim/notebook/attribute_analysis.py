"""Static analysis of the attributes that each callback of a node's class reads, writes and tests."""

from __future__ import annotations

import ast
from collections.abc import (
    Iterable,
    Iterator,
    Mapping,
    MutableMapping,
    MutableSequence,
    MutableSet,
    Sequence,
    Set,
)
from typing import NamedTuple

from sim.notebook.class_source import LIBRARIES, Function, Methods, methods_of

_NOT_METHODS = ("property", "cached_property", "staticmethod", "classmethod")
# Methods of containers that change them.
_MUTATORS = {"appendleft", "popleft", "put", "sort"}.union(
    {*dir(MutableMapping)} - {*dir(Mapping)},
    {*dir(MutableSequence)} - {*dir(Sequence)},
    {*dir(MutableSet)} - {*dir(Set)},
)
_LOOKUPS = ("getattr", "hasattr")
_Scope = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)


class AttributeUse(NamedTuple):
    """The attributes of its node that a callback uses, itself or in the methods that it calls."""

    reads: frozenset[str]
    writes: frozenset[str]  # assigns, deletes, or changes, as `self.seen.append(msg)` does
    guarded: frozenset[str]  # tests in a condition, directly or by a local name, or reads inside a `try`


def attributes_of(class_: type) -> dict[str, AttributeUse]:
    """For each callback of a node's class, such as "Pairs.on_b", the attributes that it uses.

    A callback is a method that the class passes on without calling it, as `self.create_timer(1.0, self.tick)`
    does. An attribute is what some method assigns; methods and what `Node` itself has are none. Without
    source, as for a class made by `exec`, nothing is found.
    """
    methods = methods_of(class_)
    known = assigned_names(class_, methods)
    found: dict[str, AttributeUse] = {}
    for name in callback_names(methods):
        parts = reached(name, methods)
        found[f"{class_.__name__}.{name}"] = AttributeUse(
            frozenset(reads(parts)) & known,
            frozenset(writes(parts)) & known,
            frozenset(guards(parts, methods)) & known,
        )
    return found


def callback_names(methods: Methods) -> list[str]:
    """The methods that are passed on without being called, in the order of the code."""
    plain = {name for name, method in methods.items() if not _decorators(method) & {*_NOT_METHODS}}
    found: dict[str, None] = {}
    for method in methods.values():
        called = {id(node.func) for node in ast.walk(method) if isinstance(node, ast.Call)}
        for node in ast.walk(method):
            name = own_attribute(node)
            if name in plain and id(node) not in called and isinstance(getattr(node, "ctx", None), ast.Load):
                found[name] = None
    return list(found)


def reached(name: str, methods: Methods) -> list[Function]:
    """A method, and all methods and properties of its class that it calls, directly or indirectly."""
    seen: list[str] = []
    waiting = [name]
    while waiting:
        name = waiting.pop(0)
        if name in methods and name not in seen:
            seen.append(name)
            waiting += called_names(methods[name], methods)
    return [methods[name] for name in seen]


def called_names(tree: ast.AST, methods: Methods) -> list[str]:
    """The methods that this code calls on its own object, and the properties that it reads."""
    found = []
    for node in ast.walk(tree):
        function = node.func if isinstance(node, ast.Call) else node
        name = own_attribute(function)
        if name in methods and (function is not node or _decorators(methods[name]) & {*_NOT_METHODS[:2]}):
            found.append(name)
    return found


def assigned_names(class_: type, methods: Methods) -> frozenset[str]:
    """The attributes that methods assign, and the values that the class itself has."""
    values = {
        name
        for base in class_.__mro__
        if base.__module__.split(".")[0] not in LIBRARIES
        for name, value in vars(base).items()
        if not callable(value) and not name.startswith("__")
    }
    names = {
        name
        for method in methods.values()
        for node in ast.walk(method)
        if (name := own_attribute(node)) and isinstance(getattr(node, "ctx", None), ast.Store)
    }
    return frozenset((values | names) - methods.keys())


def own_attribute(node: ast.AST) -> str:
    """The name in `self.name`; "" for any other expression."""
    if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "self":
        return node.attr
    return ""


def reads(parts: Iterable[ast.AST]) -> Iterator[str]:
    """The attributes that this code reads at once: not in functions that it only defines."""
    for part in parts:
        for node in at_once(part):
            name = own_attribute(node)
            if name and isinstance(getattr(node, "ctx", None), ast.Load):
                yield name
            elif isinstance(node, ast.AugAssign):
                yield own_attribute(node.target)


def writes(parts: Iterable[ast.AST]) -> Iterator[str]:
    """The attributes that this code assigns, deletes or changes, in functions that it defines, too."""
    for part in parts:
        for node in ast.walk(part):
            if isinstance(getattr(node, "ctx", None), ast.Store | ast.Del):
                yield _root(node)
            elif isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
                yield _root(node.func.value) if node.func.attr in _MUTATORS else ""
            elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
                yield _looked_up(node) if node.func.id in ("setattr", "delattr") else ""


def guards(parts: Iterable[ast.AST], methods: Methods) -> Iterator[str]:
    """The attributes that this code tests, directly, by a local name, or in a method that a test calls."""
    for part in parts:
        known = aliases(part)
        for test in tests_in(part):
            inside = [test, *(m for name in called_names(test, methods) for m in reached(name, methods))]
            yield from reads(inside)
            for node in ast.walk(test):
                if isinstance(node, ast.Name):
                    yield from known.get(node.id, ())


def tests_in(part: ast.AST) -> Iterator[ast.AST]:
    """The expressions of a function that decide what runs, and the statements in the body of a `try`."""
    for node in ast.walk(part):
        if isinstance(node, ast.If | ast.While | ast.IfExp | ast.Assert):
            yield node.test
        elif isinstance(node, ast.comprehension):
            yield from node.ifs
        elif isinstance(node, ast.Match):
            yield node.subject
        elif isinstance(node, ast.Try):
            yield from node.body if node.handlers else ()
        elif isinstance(node, ast.BoolOp | ast.Compare):
            yield node
        elif isinstance(node, ast.Call) and _looked_up(node):
            yield ast.Attribute(ast.Name("self", ast.Load()), _looked_up(node), ast.Load())


def at_once(part: ast.AST) -> Iterator[ast.AST]:
    """The nodes of this code, without the bodies of functions and classes that it defines."""
    for child in ast.iter_child_nodes(part):
        if not isinstance(child, _Scope):
            yield child
            yield from at_once(child)
    if own_attribute(part):
        yield part


def aliases(part: ast.AST) -> dict[str, set[str]]:
    """Local names, each with the attributes in the expressions that it was assigned."""
    found: dict[str, set[str]] = {}
    for node in ast.walk(part):
        if isinstance(node, ast.Assign | ast.AnnAssign | ast.NamedExpr) and node.value is not None:
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            names = [leaf.id for target in targets for leaf in ast.walk(target) if isinstance(leaf, ast.Name)]
            for name in names:
                found.setdefault(name, set()).update(reads([node.value]))
    return found


def _root(node: ast.AST) -> str:
    """The attribute in `self.name`, `self.name[0]` or `self.name.field`; "" for any other expression."""
    while isinstance(node, ast.Attribute | ast.Subscript) and not own_attribute(node):
        node = node.value
    return own_attribute(node)


def _looked_up(call: ast.Call) -> str:
    """The name in `hasattr(self, "name")` and the like; "" for any other call."""
    named = isinstance(call.func, ast.Name) and call.func.id in (*_LOOKUPS, "setattr", "delattr")
    if not named or len(call.args) < 2 or not isinstance(call.args[1], ast.Constant):
        return ""
    return str(call.args[1].value) if isinstance(call.args[0], ast.Name) else ""


def _decorators(method: Function) -> set[str]:
    names = (ast.unparse(decorator).split(".")[-1] for decorator in method.decorator_list)
    return set(names)
