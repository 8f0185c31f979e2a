"""Files that cells write with %%writefile, and modules that were imported from them."""

import importlib
import sys
from pathlib import Path

import pytest

from sim.notebook.written_files import OutdatedFile, OutdatedModule, WrittenFiles, written_path

ONE = "%%writefile my_part.py\ndef value():\n    return 1\n"
TWO = ONE.replace("1", "2")


@pytest.fixture
def files(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(str(tmp_path))
    yield WrittenFiles()
    sys.modules.pop("my_part", None)


def write(files, source, cell="a"):
    files.begin(source)
    path = Path(written_path(source))
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(source.split("\n", 1)[1])
    files.end(cell, source)


def test_a_cell_that_was_changed_and_not_run_makes_its_file_outdated(files):
    write(files, ONE)
    module = importlib.import_module("my_part")
    assert files.outdated([module], {"a": ONE}) is None
    found = files.outdated([module], {"a": TWO})
    assert found == files.outdated([module.value], {"a": TWO}) == OutdatedFile("my_part.py")
    assert found.saw == "the cell that writes my_part.py was changed, and has not run since"
    assert found.hint == (
        "Run that cell (Shift+Enter), then the cells that import the file; then run this one again."
    )
    assert files.outdated([len, 3, None, WrittenFiles], {"a": TWO}) is None


def test_a_module_that_was_imported_before_its_file_was_written_again_is_outdated(files):
    write(files, ONE)
    module = importlib.import_module("my_part")
    write(files, ONE)  # the same content
    assert files.outdated([module], {"a": ONE}) is None
    write(files, TWO)
    found = files.outdated([module], {"a": TWO})
    assert found == files.outdated([module.value], {"a": TWO}) == OutdatedModule("my_part")
    assert found.saw == "the file of my_part was written again, and the module has not been reloaded since"
    assert found.hint == "Run the cell with importlib.reload(my_part); then run this one again."
    importlib.reload(module)
    assert files.outdated([module], {"a": TWO}) is None


def test_files_below_a_folder_count(files):
    setup = "%%writefile ws/src/greeter/setup.py\nsetup()\n"
    write(files, setup)
    cells = {"a": setup + "# changed\n", "b": "%%writefile ws/src/station/setup.py\n# never run\n"}
    assert files.outdated([Path("ws/src/greeter")], cells) == OutdatedFile("ws/src/greeter/setup.py")
    assert files.outdated([Path("ws/src/station")], cells) is None


def test_of_two_cells_that_write_one_file_the_last_one_counts(files):
    write(files, ONE)
    write(files, TWO, "b")
    assert files.outdated(["my_part.py"], {"a": ONE + "#", "b": TWO}) is None
    assert files.outdated(["my_part.py"], {"a": ONE, "b": ONE}) == OutdatedFile("my_part.py")


def test_a_file_that_was_changed_in_an_editor_or_whose_cell_was_deleted_is_not_outdated(files):
    write(files, ONE)
    Path("my_part.py").write_text("def value():\n    return 3\n")
    assert files.outdated(["my_part.py"], {"a": ONE}) is None
    assert files.outdated(["my_part.py"], {}) is None


@pytest.mark.parametrize(
    "source, path",
    [(ONE, "my_part.py"), ("%%writefile -a log.txt\nx\n", ""), ("x = 1\n", ""), ("%%bash\nls\n", "")],
)
def test_only_a_cell_that_writes_a_whole_file_has_a_path(source, path):
    assert written_path(source) == path
