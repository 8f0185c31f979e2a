"""Waits for processes of a launch: until they have started, have exited, or have written something.

Each function exists twice. `wait_for_output(...)` is a coroutine, for tests that are coroutines, and
`wait_for_output_sync(...)` a plain function. The process needs cached_output=True where its output matters.
`timeout` is in seconds; without one, they wait as long as the launch runs.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Coroutine
from typing import Any

from launch import LaunchContext
from launch.actions import ExecuteProcess
from launch.event_handler import EventHandler
from launch.events.process import RunningProcessEvent

Validate = Callable[[str], Any]  # returns whether an output is right, or asserts that it is


async def wait_for_output(
    launch_context: LaunchContext,
    execute_process_action: ExecuteProcess,
    validate_output: Validate,
    timeout: float | None = None,
) -> bool:
    """Wait until `validate_output` accepts all that was written to stdout. Returns whether it has."""
    action = execute_process_action

    def accepted() -> bool:
        return _accepts(validate_output, action.get_stdout())

    return await _wait(launch_context, action, accepted, timeout)


async def wait_for_stderr(
    launch_context: LaunchContext,
    execute_process_action: ExecuteProcess,
    validate_output: Validate,
    timeout: float | None = None,
) -> bool:
    """Work like `wait_for_output`, for stderr."""
    action = execute_process_action

    def accepted() -> bool:
        return _accepts(validate_output, action.get_stderr())

    return await _wait(launch_context, action, accepted, timeout)


async def assert_output(
    launch_context: LaunchContext,
    execute_process_action: ExecuteProcess,
    validate_output: Validate,
    timeout: float | None = None,
) -> None:
    """Work like `wait_for_output`. Raises AssertionError if it is not accepted in time."""
    if not await wait_for_output(launch_context, execute_process_action, validate_output, timeout):
        _refuse(validate_output, execute_process_action.get_stdout(), "stdout")


async def assert_stderr(
    launch_context: LaunchContext,
    execute_process_action: ExecuteProcess,
    validate_output: Validate,
    timeout: float | None = None,
) -> None:
    """Work like `assert_output`, for stderr."""
    if not await wait_for_stderr(launch_context, execute_process_action, validate_output, timeout):
        _refuse(validate_output, execute_process_action.get_stderr(), "stderr")


async def wait_for_start(
    launch_context: LaunchContext, execute_process_action: ExecuteProcess, timeout: float | None = None
) -> bool:
    """Wait until the process has started. Returns whether it has."""
    action = execute_process_action
    return await _wait(launch_context, action, lambda: "pid" in (action.process_details or {}), timeout)


async def wait_for_exit(
    launch_context: LaunchContext, execute_process_action: ExecuteProcess, timeout: float | None = None
) -> bool:
    """Wait until the process has exited. Returns whether it has."""
    action = execute_process_action
    return await _wait(launch_context, action, lambda: action.return_code is not None, timeout)


def wait_for_output_sync(
    launch_context: LaunchContext,
    execute_process_action: ExecuteProcess,
    validate_output: Validate,
    timeout: float | None = None,
) -> bool:
    """Work like `wait_for_output`."""
    waiting = wait_for_output(launch_context, execute_process_action, validate_output, timeout)
    return _run(launch_context, waiting)


def wait_for_stderr_sync(
    launch_context: LaunchContext,
    execute_process_action: ExecuteProcess,
    validate_output: Validate,
    timeout: float | None = None,
) -> bool:
    """Work like `wait_for_stderr`."""
    waiting = wait_for_stderr(launch_context, execute_process_action, validate_output, timeout)
    return _run(launch_context, waiting)


def assert_output_sync(
    launch_context: LaunchContext,
    execute_process_action: ExecuteProcess,
    validate_output: Validate,
    timeout: float | None = None,
) -> None:
    """Work like `assert_output`."""
    _run(launch_context, assert_output(launch_context, execute_process_action, validate_output, timeout))


def assert_stderr_sync(
    launch_context: LaunchContext,
    execute_process_action: ExecuteProcess,
    validate_output: Validate,
    timeout: float | None = None,
) -> None:
    """Work like `assert_stderr`."""
    _run(launch_context, assert_stderr(launch_context, execute_process_action, validate_output, timeout))


def wait_for_start_sync(
    launch_context: LaunchContext, execute_process_action: ExecuteProcess, timeout: float | None = None
) -> bool:
    """Work like `wait_for_start`."""
    return _run(launch_context, wait_for_start(launch_context, execute_process_action, timeout))


def wait_for_exit_sync(
    launch_context: LaunchContext, execute_process_action: ExecuteProcess, timeout: float | None = None
) -> bool:
    """Work like `wait_for_exit`."""
    return _run(launch_context, wait_for_exit(launch_context, execute_process_action, timeout))


async def _wait(
    context: LaunchContext, action: ExecuteProcess, condition: Callable[[], bool], timeout: float | None
) -> bool:
    """Wait until the condition holds, which only events of this process can change; whether it does."""
    changed = asyncio.Event()

    def matches(event: Any) -> bool:
        if isinstance(event, RunningProcessEvent) and event.action is action:
            changed.set()
        return False

    handler = EventHandler(matcher=matches)
    context.register_event_handler(handler)
    try:
        async with asyncio.timeout(timeout):
            while not condition() and context.asyncio_loop is not None:
                await changed.wait()
                changed.clear()
    except TimeoutError:
        pass
    finally:
        context.unregister_event_handler(handler)
    return condition()


def _run(context: LaunchContext, waiting: Coroutine[Any, Any, Any]) -> Any:
    """Run a coroutine in the launch's event loop, or in a new one when that is closed."""
    loop = context.asyncio_loop
    if loop is None:
        return asyncio.run(waiting)
    return asyncio.run_coroutine_threadsafe(waiting, loop).result()


def _accepts(validate: Validate, output: str) -> bool:
    try:
        accepted = validate(output)
    except AssertionError:
        return False
    return accepted is None or bool(accepted)


def _refuse(validate: Validate, output: str, stream: str) -> None:
    """Raise the AssertionError of `validate`, or one that has the output."""
    validate(output)
    raise AssertionError(f"{validate.__name__} does not accept the process's {stream}, which is {output!r}")
