"""Finds what other parts and distributions add to the grader, by entry points."""

import importlib.util
from importlib.metadata import EntryPoint, entry_points

COMMANDS = "grader.commands"  # of `python -m grader`: functions of the words behind them, to the exit status
POOLS = "grader.pools"  # places where `python -m grader mark` can mark


def plugin(group: str, name: str) -> EntryPoint | None:
    """The entry point of this name; None if there is none, or if its package is not here.

    The installed course names all of its own, and a student's folder has few of their packages.
    """
    return next(filter(_is_here, entry_points(group=group, name=name)), None)


def plugin_names(group: str) -> list[str]:
    """The names that `plugin` finds in a group, sorted."""
    return sorted({entry.name for entry in entry_points(group=group) if _is_here(entry)})


def _is_here(entry: EntryPoint) -> bool:
    try:
        return importlib.util.find_spec(entry.module.rpartition(".")[0] or entry.module) is not None
    except ImportError:  # there is no package in which it would be, or that can't be imported
        return False
