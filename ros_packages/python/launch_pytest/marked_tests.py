"""Runs a test beside its launch, or after it."""

from __future__ import annotations

import asyncio
import inspect
import sys
from collections.abc import AsyncGenerator, Awaitable, Callable, Coroutine
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from launch_pytest.launch_run import LaunchRun

YIELDS_ONCE = (
    "a generator marked with `launch` yields once: what precedes the yield runs beside the launch, and the "
    "rest after it. {name} yields {how}."
)


def run_test(
    function: Callable, arguments: dict[str, Any], launch: LaunchRun, *, after_shutdown: bool
) -> None:
    """Run a test function, a coroutine function, a generator or an asynchronous generator.

    after_shutdown: shut the launch down first. Raises what the test raises, and RuntimeError where the launch
    is over already.
    """
    if after_shutdown:
        launch.shut_down()
    elif launch.is_over:
        raise RuntimeError(
            f"{function.__name__} runs beside the launch, which is over: another test with the same fixture "
            "has shut it down, or everything in it has exited. With scope='function' each test has its own."
        )
    if inspect.isgeneratorfunction(function):
        _run_generator(function, arguments, launch)
    elif inspect.isasyncgenfunction(function):
        _run_async_generator(function, arguments, launch)
    elif inspect.iscoroutinefunction(function):
        _run_coroutine(function(**arguments), launch)
    else:
        function(**arguments)


def _run_coroutine(coroutine: Coroutine[Any, Any, Any], launch: LaunchRun) -> Any:
    """Run it in the event loop of the launch, or in a new one when that is closed."""
    loop = launch.service.event_loop
    if loop is None:
        return asyncio.run(coroutine)
    return asyncio.run_coroutine_threadsafe(coroutine, loop).result()


def _run_generator(function: Callable, arguments: dict[str, Any], launch: LaunchRun) -> None:
    steps = function(**arguments)
    end = object()
    if next(steps, end) is end:
        raise RuntimeError(YIELDS_ONCE.format(name=function.__name__, how="never"))
    launch.shut_down()
    if next(steps, end) is not end:
        raise RuntimeError(YIELDS_ONCE.format(name=function.__name__, how="more than once"))


def _run_async_generator(function: Callable, arguments: dict[str, Any], launch: LaunchRun) -> None:
    steps, end = function(**arguments), object()

    async def step(waiting: Awaitable[Any]) -> Any:
        return await waiting

    if _run_coroutine(step(_next_without_loop(steps, end)), launch) is end:
        raise RuntimeError(YIELDS_ONCE.format(name=function.__name__, how="never"))
    launch.shut_down()
    if _run_coroutine(step(anext(steps, end)), launch) is not end:
        raise RuntimeError(YIELDS_ONCE.format(name=function.__name__, how="more than once"))


def _next_without_loop(steps: AsyncGenerator[Any, None], end: Any) -> Awaitable[Any]:
    """The first step of an asynchronous generator, which no event loop closes when it ends itself."""
    hooks = sys.get_asyncgen_hooks()
    sys.set_asyncgen_hooks(None, None)
    try:
        return anext(steps, end)
    finally:
        sys.set_asyncgen_hooks(*hooks)
