"""`play` where VS Code's own manager of widgets shows it, without any extension of the course.

The manager is the one that VS Code's Jupyter extension bundles, from npm. What VS Code itself does around it
is in vscode.js: connect it to a kernel, load scripts of widgets, and put HTML into the output.
"""

import json
import shutil
import subprocess
import sys
import tarfile
from pathlib import Path

import pytest
from playwright.sync_api import Frame

from tests.browser.pictures import COUNT_FRAMES, Picture
from tests.browser.test_play_in_lab import DRIVEN, ENDED, IMPORTS
from tests.patience import PATIENCE, until

pytestmark = [pytest.mark.browser, pytest.mark.soak]  # npm loads packages
PACKAGES = {"renderer": "@vscode/jupyter-ipywidgets8@1.0.9", "requirejs": "requirejs@2.3.7"}
FILES = {"renderer": "dist/ipywidgets.js", "requirejs": "require.js"}
EXTENSIONS = Path(sys.prefix, "share", "jupyter", "nbextensions")  # where VS Code looks for widgets
PAGE = Path(__file__).with_name("vscode.js")
PLACE = "/from-vscode/"
FRAME = """() => {
    const frame = document.createElement("iframe");
    frame.name = "vscode";
    frame.style = "position: fixed; inset: 0; width: 100%; height: 100%; z-index: 100000; background: white";
    document.body.append(frame);
}"""


@pytest.fixture(scope="module")
def scripts(tmp_path_factory) -> dict[str, Path]:
    """VS Code's manager of widgets and RequireJS, which it loads widgets with."""
    if not shutil.which("npm"):
        pytest.skip("npm is not installed: it brings the renderer of VS Code")
    found = {}
    for name, package in PACKAGES.items():
        folder = tmp_path_factory.mktemp(name)
        command = ["npm", "pack", "--silent", package]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=PATIENCE)
        if done.returncode:
            pytest.skip(f"npm can't load {package} here")
        with tarfile.open(folder / done.stdout.strip()) as archive:
            archive.extractall(folder, filter="data")
        found[name] = folder / "package" / FILES[name]
    return found


@pytest.fixture
def vscode(lab, scripts) -> Frame:
    """A frame with VS Code's manager and a kernel; its page does nothing but hold the connection."""
    page = lab.page
    page.route(f"**{PLACE}renderer.js", lambda route: route.fulfill(path=scripts["renderer"]))
    page.route(f"**{PLACE}widgets/**", serve_widget)
    page.goto(f"{lab.address}/lab")
    page.wait_for_function("window.jupyterapp?.serviceManager.isReady")
    page.evaluate(FRAME)
    frame = page.frame("vscode")
    frame.evaluate(f"() => {{{COUNT_FRAMES}}}")
    frame.add_script_tag(path=scripts["requirejs"])
    places = {"renderer": f"{lab.address}{PLACE}renderer.js", "widgets": f"{lab.address}{PLACE}widgets/"}
    frame.evaluate(PAGE.read_text("utf-8"), places)
    yield frame
    frame.evaluate("shutDown()")


def serve_widget(route) -> None:
    route.fulfill(path=EXTENSIONS / route.request.url.partition(f"{PLACE}widgets/")[2])


def execute(frame: Frame, code: str) -> str:
    return frame.evaluate("code => execute(code)", code)


def eventually(frame: Frame, expression: str) -> None:
    """Wait until a Python expression is true in the kernel."""
    ask = f"print({expression})"
    until(lambda: execute(frame, ask).strip() == "True" or frame.page.wait_for_timeout(100), expression)


def test_a_robot_is_driven_with_keys_and_its_run_becomes_a_replay(vscode):
    assert execute(vscode, f"{IMPORTS}\n{DRIVEN}") == ""
    picture = Picture(vscode.locator(".ros2-view.live"))
    picture.wait_for_time(0.2)
    first = picture.pixels()
    picture.canvas.click()
    vscode.page.keyboard.down("ArrowUp")
    eventually(vscode, "way(player) > 0.3")
    vscode.page.keyboard.up("ArrowUp")
    forward = json.loads(execute(vscode, "print(sent(player, '/cmd_vel'))"))
    assert forward[0] > 0
    assert picture.pixels() != first
    picture.screenshot("play-in-vscode")
    picture.click("End the run")
    eventually(vscode, f"{ENDED}[0] == 'interrupted'")
    ending = Picture(vscode.locator(".ros2-replay .ros2-view"))
    ending.scrub(0.0)
    begin = ending.pixels()
    ending.scrub(1.0)
    assert ending.pixels() != begin
    ending.screenshot("replay-in-vscode")
