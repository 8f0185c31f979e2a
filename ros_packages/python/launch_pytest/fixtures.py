"""The decorator `launch_pytest.fixture`, and which launch belongs to which fixture."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from typing import Any

import pytest

# The current LaunchRun of each fixture, by the fixture's name.
LAUNCHES: pytest.StashKey[dict[str, Any]] = pytest.StashKey()
_names: dict[int, tuple[Any, str]] = {}  # id of a decorated function -> (it, the fixture's name)


def fixture(function: Callable | None = None, /, **options: Any) -> Any:
    """Make a function that returns or yields a launch description a fixture that executes it.

    That is a LaunchDescription, or a sequence that begins with one; it is the fixture's value. What follows a
    yield is done after the launch.
    options: those of `pytest.fixture`. The launch is shut down where the fixture's scope ends.
    """
    if function is None:
        return lambda decorated: fixture(decorated, **options)
    if inspect.iscoroutinefunction(function) or inspect.isasyncgenfunction(function):
        raise TypeError(
            "launch_pytest.fixture needs a function that returns or yields a launch description: "
            f"{function.__name__} is asynchronous."
        )
    name = options.setdefault("name", None) or function.__name__
    made = pytest.fixture(**options)(_executing(function, name))
    _names[id(made)] = made, name
    return made


def fixture_name(made: Any) -> str | None:
    """The name of a fixture made by `fixture`; None for anything else."""
    return _names.get(id(made), (None, None))[1]


def _executing(function: Callable, name: str) -> Callable:
    """The fixture function: executes what `function` returns or yields, from its set-up to its tear-down."""
    signature = inspect.signature(function)
    has_request = "request" in signature.parameters
    opened = contextmanager(function) if inspect.isgeneratorfunction(function) else _returned(function)
    request_parameter = inspect.Parameter("request", inspect.Parameter.KEYWORD_ONLY)

    def execute(*arguments: Any, **fixtures: Any) -> Iterator[Any]:
        from launch_pytest.launch_run import LaunchRun  # imported late, because it is slow

        request = fixtures["request"] if has_request else fixtures.pop("request")
        launches = request.config.stash.setdefault(LAUNCHES, {})
        with opened(*arguments, **fixtures) as value:
            launch = LaunchRun(value)
            launch.start()
            launches[name] = launch
            yield value
            del launches[name]
            launch.shut_down()
            launch.raise_failure()

    execute.__name__, execute.__doc__, execute.__module__ = name, function.__doc__, function.__module__
    if not has_request:
        signature = signature.replace(parameters=[*signature.parameters.values(), request_parameter])
    execute.__signature__ = signature
    return execute


def _returned(function: Callable) -> Callable[..., AbstractContextManager]:
    return lambda *arguments, **fixtures: nullcontext(function(*arguments, **fixtures))
