"""The scripts of the pages: unit tests in node, types by tsc, style by eslint; each where it is installed."""

import shutil
import subprocess
from pathlib import Path

import pytest

FOLDER = Path(__file__).parent
NODE = shutil.which("node")
MISSING = "node is not installed: install Node.js 20 or newer to check the scripts"
NO_TOOLS = "tsc and eslint are not installed: `make lint` installs them, where npm and a network are there"
node = pytest.mark.skipif(NODE is None, reason=MISSING)


def passes(*command: str) -> None:
    done = subprocess.run(command, cwd=FOLDER, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


@node
def test_what_needs_no_browser_passes_its_unit_tests():
    passes(NODE, "--test")


@node
@pytest.mark.skipif(not (FOLDER / "node_modules/.bin/tsc").exists(), reason=NO_TOOLS)
@pytest.mark.parametrize("page", ["live", "replay", "plots", "prediction", "order_game", "pages"])
def test_types_are_right(page):
    passes(NODE, "node_modules/typescript/bin/tsc", "-p", f"tsconfig.{page}.json")


@node
@pytest.mark.skipif(not (FOLDER / "node_modules/.bin/eslint").exists(), reason=NO_TOOLS)
def test_style_is_right():
    passes("npm", "run", "--silent", "style")
