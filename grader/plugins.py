"""Finds what other parts and distributions add to the grader, by entry points."""

import importlib.util
from importlib.metadata import EntryPoint, entry_points

COMMANDS = "grader.commands"  # of `python -m grader`: functions of the words behind them, to the exit status
POOLS = "grader.pools"  # places where `python -m grader mark` can mark


def plugins(group: str) -> dict[str, EntryPoint]:
    """The entry points of a group by name, without those whose package is not here.

    The installed course names all of its own, and a student's folder has few of their packages.
    """
    return {entry.name: entry for entry in sorted(entry_points(group=group)) if _is_here(entry)}


def _is_here(entry: EntryPoint) -> bool:
    try:
        return importlib.util.find_spec(entry.module.rpartition(".")[0] or entry.module) is not None
    except ModuleNotFoundError:  # the package in which it would be
        return False
