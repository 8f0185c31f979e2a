"""Commands and other things that distributions add by entry points."""

import sys

import pytest

from grader.__main__ import main
from grader.plugins import COMMANDS, plugin, plugin_names


@pytest.fixture
def installed(tmp_path, monkeypatch):
    """Distributions of strangers: entry points by name, and modules by name."""

    def install(entries: dict[str, str], modules: dict[str, str]) -> None:
        monkeypatch.syspath_prepend(str(tmp_path))
        metadata = tmp_path / "strangers-1.dist-info"
        metadata.mkdir()
        lines = [f"{name} = {place}\n" for name, place in entries.items()]
        (metadata / "entry_points.txt").write_text(f"[{COMMANDS}]\n{''.join(lines)}")
        (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: strangers\nVersion: 1\n")
        for name, source in modules.items():
            monkeypatch.delitem(sys.modules, name, raising=False)
            path = tmp_path / f"{name.replace('.', '/')}.py"
            path.parent.mkdir(exist_ok=True)
            path.write_text(source)

    return install


def test_a_stranger_s_command_runs_with_its_words(installed, capsys):
    module = "def main(words):\n    print(words)\n    return 7\n"
    installed({"greet": "greeting:main"}, {"greeting": module})
    assert main(["greet", "a", "--b"]) == 7
    assert capsys.readouterr().out == "['a', '--b']\n"
    assert "greet" in plugin_names(COMMANDS)


def test_a_package_that_can_not_be_imported_costs_its_own_command_alone(installed, capsys):
    modules = {"lacking": "import no_such_package\n", "good": "def main(words):\n    return 3\n"}
    installed({"lacks": "lacking:main", "good": "good:main", "gone": "nowhere.at.all:main"}, modules)
    assert (main(["good"]), main(["lacks"])) == (3, 1)
    assert capsys.readouterr().err == (
        "lacks can't be loaded: No module named 'no_such_package'. Install what it needs; for a command of the "
        "course, `make tools` does.\n"
    )
    assert "good" in plugin_names(COMMANDS) and "gone" not in plugin_names(COMMANDS)
    assert plugin(COMMANDS, "gone") is None


def test_where_the_course_was_set_up_before_it_had_commands_it_says_what_to_do(monkeypatch, capsys):
    monkeypatch.setattr("grader.plugins.entry_points", lambda **selected: [])
    assert main(["mark", "01_nodes"]) == 2
    assert capsys.readouterr().err == (
        "usage: python -m grader COMMAND ...\nCommands, each with --help: none, since this course was changed "
        "after it was set up: run `make setup`\n"
    )
