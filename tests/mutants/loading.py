"""Imports one module from a syntax tree in place of its file, and notes which of its statements are run."""

from __future__ import annotations

import ast
import copy
import importlib.machinery
import importlib.util
import sys
from types import CodeType, ModuleType
from typing import Any

NOTE = "__note_statement__"
statements_run: set[int] = set()
"""First lines of the statements in functions that were run; its reader may clear it."""


def import_from(tree: ast.Module, module: str, file: str) -> None:
    """Let every later import of this module make it of the tree."""
    sys.meta_path.insert(0, _Finder(tree, module, file))


class _Finder:
    def __init__(self, tree: ast.Module, module: str, file: str) -> None:
        self.tree, self.module, self.file = tree, module, file

    def find_spec(self, name: str, path: Any, target: ModuleType | None = None) -> Any:
        if name != self.module:
            return None
        loader = _Loader(name, self.file)
        loader.tree = self.tree
        return importlib.util.spec_from_file_location(name, self.file, loader=loader)


class _Loader(importlib.machinery.SourceFileLoader):
    tree: ast.Module

    def get_code(self, fullname: str) -> CodeType:
        return compile(self.tree, self.path, "exec", dont_inherit=True)

    def exec_module(self, module: ModuleType) -> None:
        setattr(module, NOTE, statements_run.add)
        super().exec_module(module)


def noting(tree: ast.Module) -> ast.Module:
    """The tree with a call before each statement in a function, which adds its line to `statements_run`."""
    noted = copy.deepcopy(tree)
    functions = [n for n in ast.walk(noted) if isinstance(n, ast.FunctionDef | ast.AsyncFunctionDef)]
    blocks = {id(block): block for function in functions for block in _blocks(function)}
    for block in blocks.values():
        block[:] = [part for statement in block for part in _noted(statement)]
    return ast.fix_missing_locations(noted)


def _blocks(function: ast.AST) -> list[list[ast.stmt]]:
    lists = [
        value for node in ast.walk(function) for _, value in ast.iter_fields(node) if isinstance(value, list)
    ]
    return [value for value in lists if value and isinstance(value[0], ast.stmt)]


def _noted(statement: ast.stmt) -> list[ast.stmt]:
    if isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant):
        return [statement]  # a docstring stays the first statement
    call = ast.parse(f"{NOTE}({statement.lineno})").body[0]
    return [ast.copy_location(call, statement), statement]
