"""launch_pytest tests launch files: real processes, and programs of a run."""

import os
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

import pytest

from tests.patience import PATIENCE

PREFIX = re.compile(r'^(failed on (setup|teardown) with ")?(Failed: )?')
PLUGIN = "-p", "launch_pytest.plugin"
OPTIONS = "-q", "--disable-plugin-autoload", "-p", "no:cacheprovider"
HEAD = """
import sys
import launch, launch_pytest, pytest
from launch import LaunchDescription
from launch.actions import ExecuteProcess, OpaqueFunction, RegisterEventHandler, TimerAction
from launch.event_handlers import OnProcessExit, OnProcessIO
from launch_pytest.actions import ReadyToTest
from launch_pytest.tools import process as process_tools

def python(text, **options):
    return ExecuteProcess(cmd=[sys.executable, "-c", text], **options)
"""
RIGHT = """
SAYS = "import sys, time; print('out', flush=True); print('err', file=sys.stderr, flush=True)"

@pytest.fixture
def program():
    return python(SAYS, cached_output=True)

@pytest.fixture
def server():
    return python("import time; print('up', flush=True); time.sleep(1000)", cached_output=True)

@launch_pytest.fixture
def description(program):
    return LaunchDescription([program, ReadyToTest()])

def ready_when_up(server):
    up = OnProcessIO(target_action=server, on_stdout=lambda event: [ReadyToTest()])
    ended = OnProcessExit(target_action=server, on_exit=[ReadyToTest()])
    return [RegisterEventHandler(up), RegisterEventHandler(ended)]

@launch_pytest.fixture
def serving(server):  # a Python that is still starting would not end as one that waits
    return [LaunchDescription([server, *ready_when_up(server)]), server]

@launch_pytest.fixture(scope="module")
def shared():
    return LaunchDescription([python("import time; time.sleep(1000)")])

@launch_pytest.fixture
def yielding(server):
    yield LaunchDescription([server])
    assert server.return_code is not None  # the launch is over

@pytest.mark.launch(fixture=yielding)
def test_a_fixture_that_yields(server, launch_context):
    process_tools.assert_output_sync(launch_context, server, lambda text: text == "up\\n", timeout=100)
    assert server.return_code is None

@launch_pytest.fixture(name="late")
def when_up(request):
    server = python("import time; print('up', flush=True); time.sleep(1000)")
    return LaunchDescription([server, *ready_when_up(server)]), server

@pytest.mark.launch(fixture=shared, shutdown=True)
def test_shut_down_tests_run_last(launch_service):
    assert launch_service.event_loop is None

@pytest.mark.launch(fixture=shared)
def test_tests_share_a_launch_of_their_module(launch_service):
    assert launch_service.event_loop is not None

@pytest.mark.launch(fixture=description)
def test_a_function(program, launch_context):
    process_tools.assert_output_sync(launch_context, program, lambda text: text == "out\\n", timeout=100)
    process_tools.assert_stderr_sync(launch_context, program, lambda text: text == "err\\n", timeout=100)
    assert process_tools.wait_for_exit_sync(launch_context, program, timeout=100)
    assert program.return_code == 0

@pytest.mark.launch(fixture=description)
@pytest.mark.parametrize("n", [1, 2])
def test_a_generator(program, launch_context, n):
    def validate(text):
        assert text.splitlines() == ["out"], "nothing was written"
    process_tools.assert_output_sync(launch_context, program, validate, timeout=100)
    assert process_tools.wait_for_exit_sync(launch_context, program)
    yield
    assert program.return_code == 0
    process_tools.assert_output_sync(launch_context, program, validate)
    assert not process_tools.wait_for_output_sync(launch_context, program, lambda text: text == "other")

@pytest.mark.launch(fixture=serving)
async def test_a_coroutine(serving, server, launch_context, event_loop):
    import asyncio
    assert serving[1] is server and asyncio.get_running_loop() is event_loop
    assert await process_tools.wait_for_start(launch_context, server, timeout=100)
    is_up = lambda text: text == "up\\n"
    assert await process_tools.wait_for_output(launch_context, server, is_up, timeout=100)
    assert not await process_tools.wait_for_exit(launch_context, server, timeout=0.01)
    assert not await process_tools.wait_for_stderr(launch_context, server, lambda text: text, timeout=0.01)

@pytest.mark.launch(fixture=serving, shutdown=True)
async def test_a_coroutine_after_the_shutdown(server):
    assert server.return_code == -2

@pytest.mark.launch(fixture=serving)
async def test_an_asynchronous_generator(server, launch_context):
    await process_tools.assert_output(launch_context, server, lambda text: text == "up\\n", timeout=100)
    yield
    assert server.return_code == -2

class TestClass:
    @pytest.mark.launch(fixture=serving)
    def test_a_method(self, server, launch_context):
        assert process_tools.wait_for_start_sync(launch_context, server, timeout=100)

@pytest.mark.launch(fixture=when_up)
def test_the_action_can_be_in_an_event_handler(late):
    assert late[1].process_details["pid"]

def test_without_a_launch():
    pass
"""
WRONG = """
def stays():
    return python("import time; time.sleep(1000)")

@launch_pytest.fixture
def nothing():
    return 3

@launch_pytest.fixture
def broken():
    return LaunchDescription([OpaqueFunction(function=lambda context: 1 / 0)])

@launch_pytest.fixture
def never_ready():
    never = RegisterEventHandler(OnProcessExit(target_action=stays(), on_exit=[ReadyToTest()]))
    return LaunchDescription([never, python("")])

@launch_pytest.fixture
def breaks_later():
    return LaunchDescription([TimerAction(period=0.05, actions=[OpaqueFunction(function=lambda _: 1 / 0)])])

@launch_pytest.fixture
def good():
    return LaunchDescription([stays()])

@launch_pytest.fixture(scope="module")
def shared():
    return LaunchDescription([stays()])

@pytest.fixture
def ordinary():
    return LaunchDescription([])

@pytest.mark.launch(fixture=nothing)
def test_no_description():
    pass

@pytest.mark.launch(fixture=broken)
def test_broken():
    pass

@pytest.mark.launch(fixture=never_ready)
def test_never_ready():
    pass

@pytest.mark.launch(fixture=breaks_later)
def test_breaks_later(launch_service):
    while launch_service.event_loop:
        pass

@pytest.mark.launch(fixture=shared)
def test_first():
    yield

@pytest.mark.launch(fixture=shared)
def test_second():
    yield

@pytest.mark.launch(fixture=good)
def test_yields_twice():
    yield
    yield

@pytest.mark.launch(fixture=good)
async def test_yields_never():
    if False:
        yield

@pytest.mark.launch(fixture=good)
def test_that_returns_early():
    return
    yield

@pytest.mark.launch(fixture=good)
async def test_yields_twice_async():
    yield
    yield

@pytest.mark.launch
def test_bare_mark():
    pass

@pytest.mark.launch(fixture=ordinary)
def test_ordinary_fixture():
    pass

@pytest.mark.launch(3, fixture=good, after=True)
def test_unknown():
    pass

@pytest.mark.launch(fixture=good, shutdown=True)
def test_shutdown_of_a_generator():
    yield

def test_unmarked(launch_context):
    pass

@pytest.mark.launch(fixture=good)
def test_output(launch_context):
    program = python("", cached_output=True)
    def is_ready(text):
        return text == "ready"
    process_tools.assert_output_sync(launch_context, program, is_ready, timeout=0.01)

@pytest.mark.launch(fixture=good)
def test_error_output(launch_context):
    def validate(text):
        assert text, "nothing on stderr"
    program = python("", cached_output=True)
    process_tools.assert_stderr_sync(launch_context, program, validate, timeout=0.01)

def test_asynchronous_fixture():
    with pytest.raises(TypeError) as error:
        @launch_pytest.fixture
        async def description():
            yield
    raise error.value
"""
MESSAGES = {
    "test_no_description": (
        "launch_pytest.launch_run.LaunchFailed: a launch_pytest fixture returns a LaunchDescription, or "
        "a sequence that begins with one: this one returned 3."
    ),
    "test_broken": ("launch_pytest.launch_run.LaunchFailed: the launch failed: division by zero"),
    "test_never_ready": (
        "launch_pytest.launch_run.LaunchFailed: the launch ended before ReadyToTest was executed, so no "
        "test could run."
    ),
    "test_breaks_later": ("launch_pytest.launch_run.LaunchFailed: the launch failed: division by zero"),
    "test_second": (
        "RuntimeError: test_second runs beside the launch, which is over: another test with the same "
        "fixture has shut it down, or everything in it has exited. With scope='function' each test has "
        "its own."
    ),
    "test_yields_twice": (
        "RuntimeError: a generator marked with `launch` yields once: what precedes the yield runs beside"
        " the launch, and the rest after it. test_yields_twice yields more than once."
    ),
    "test_yields_never": (
        "RuntimeError: a generator marked with `launch` yields once: what precedes the yield runs beside"
        " the launch, and the rest after it. test_yields_never yields never."
    ),
    "test_that_returns_early": (
        "RuntimeError: a generator marked with `launch` yields once: what precedes the yield runs beside"
        " the launch, and the rest after it. test_that_returns_early yields never."
    ),
    "test_yields_twice_async": (
        "RuntimeError: a generator marked with `launch` yields once: what precedes the yield runs beside"
        " the launch, and the rest after it. test_yields_twice_async yields more than once."
    ),
    "test_bare_mark": (
        "@pytest.mark.launch needs fixture=F, where F is a function that is decorated with "
        "@launch_pytest.fixture; it has no fixture."
    ),
    "test_ordinary_fixture": (
        "@pytest.mark.launch needs fixture=F, where F is a function that is decorated with "
        "@launch_pytest.fixture; it has fixture=<pytest_fixture(<function ordinary at 0x0>)>."
    ),
    "test_unknown": ("@pytest.mark.launch takes fixture=F and shutdown=True, but not 3, after."),
    "test_shutdown_of_a_generator": (
        "a generator runs beside the launch and, after its yield, without it: its @pytest.mark.launch "
        "takes no `shutdown`."
    ),
    "test_unmarked": (
        "the fixtures launch_service, launch_context and event_loop need a test that is marked with "
        "@pytest.mark.launch(fixture=...)."
    ),
    "test_output": ("AssertionError: is_ready does not accept the process's stdout, which is ''"),
    "test_error_output": ("AssertionError: nothing on stderr"),
    "test_asynchronous_fixture": (
        "TypeError: launch_pytest.fixture needs a function that returns or yields a launch description: "
        "description is asynchronous."
    ),
}
@pytest.fixture(scope="module")
def outcomes(tmp_path_factory):
    """Runs the tests in a text by pytest; the first message of each that failed, "" of each that passed."""

    def outcomes_of(text: str, *options: str) -> dict[str, str]:
        folder = tmp_path_factory.mktemp("tests")
        (folder / "test_it.py").write_text(HEAD + text)
        command = [sys.executable, "-m", "pytest", *options, "--junitxml=report.xml", "test_it.py"]
        done = subprocess.run(
            command,
            cwd=folder,
            env={**os.environ, "ROS_LOG_DIR": str(folder)},
            capture_output=True,
            text=True,
            timeout=PATIENCE,
        )
        assert (folder / "report.xml").exists(), done.stdout + done.stderr
        cases = ElementTree.parse(folder / "report.xml").iter("testcase")
        return {case.get("name"): _message(case) for case in cases}

    return outcomes_of


def _message(case: ElementTree.Element) -> str:
    """The message of a test's failure or error."""
    found = [each for kind in ("failure", "error") for each in case.iter(kind)]
    messages = [PREFIX.sub("", each.get("message")).rstrip('"') for each in found]
    return "".join(re.sub(r"0x[0-9a-f]+", "0x0", message.split("\n")[0]) for message in messages)


def test_tests_of_all_kinds_run_beside_real_processes_and_after_them(outcomes):
    found = outcomes(RIGHT, *OPTIONS, *PLUGIN)
    assert {name: message for name, message in found.items() if message} == {}
    assert len(found) == 12


def test_each_mistake_is_explained(outcomes):
    found = outcomes(WRONG, *OPTIONS, *PLUGIN)
    assert found == MESSAGES | {"test_first": ""}


def test_pytest_finds_the_plugin_by_itself(outcomes):
    text = "def test_it(request):\n    assert request.config.pluginmanager.has_plugin('launch_pytest')\n"
    assert outcomes(text, "-p", "no:cacheprovider") == {"test_it": ""}


def test_the_plugin_alone_does_not_import_launch():
    program = "import sys, launch_pytest.plugin; print([name for name in sys.modules if name == 'launch'])"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=PATIENCE)
    assert done.stdout == "[]\n", done.stderr


def test_an_unknown_name_is_an_attribute_error():
    import launch_pytest

    with pytest.raises(AttributeError, match=r"^module 'launch_pytest' has no attribute 'nothing'$"):
        _ = launch_pytest.nothing


def test_ready_to_test_does_nothing_in_another_launch(tmp_path, monkeypatch):
    from launch import LaunchDescription, LaunchService
    from launch_pytest.actions import ReadyToTest

    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path))
    service = LaunchService()
    service.include_launch_description(LaunchDescription([ReadyToTest()]))
    assert service.run() == 0


def test_files_that_last_failed_skips_are_skipped(tmp_path):
    (tmp_path / "test_failing.py").write_text("def test_it():\n    assert False\n")
    (tmp_path / "test_passing.py").write_text("def test_it():\n    pass\n")
    command = [sys.executable, "-m", "pytest", *OPTIONS[:2], *PLUGIN, "."]
    for options in ([], ["--last-failed"]):
        done = subprocess.run([*command, *options], cwd=tmp_path, capture_output=True, text=True)
        assert done.returncode == 1, done.stdout
    assert "1 failed in" in done.stdout
