import json
from pathlib import Path

import pytest

from grader.course_files.notebook_format import InvalidNotebook, cell_ids, main, normalized

ROOT = Path(__file__).parents[3]


def text_of(*cells: dict, **changes: object) -> str:
    notebook = {"cells": list(cells), "metadata": {}, "nbformat": 4, "nbformat_minor": 5, **changes}
    return json.dumps(notebook)


def code(source: str | list[str] = "1 + 1", **changes: object) -> dict:
    cell = {"cell_type": "code", "source": source, "metadata": {}, "outputs": [], "execution_count": None}
    return cell | changes


def graded(grade_id: str) -> dict:
    return {"nbgrader": {"grade_id": grade_id, "grade": True}}


def test_outputs_counts_and_widget_state_go():
    output = {"output_type": "stream", "name": "stdout", "text": "2"}
    ran = code(id="a", outputs=[output], execution_count=7, metadata={"execution": {"shell.reply": "now"}})
    messy = text_of(ran, metadata={"widgets": {"state": 1}, "kernelspec": {"name": "conda-env"}})
    tidy = json.loads(normalized(messy, "x.ipynb"))
    assert tidy["cells"] == [code(["1 + 1"], id="a")]
    assert tidy["metadata"]["kernelspec"]["name"] == "python3"
    assert set(tidy["metadata"]) == {"kernelspec", "language_info"}


def test_what_someone_meant_stays():
    metadata = {"tags": ["hide"], **graded("test_counter"), "editable": False, "deletable": False}
    tidy = json.loads(normalized(text_of(code(metadata=metadata)), "x.ipynb"))
    assert tidy["cells"][0]["metadata"] == metadata


def test_normalizing_twice_changes_nothing():
    once = normalized(text_of(code(), code(metadata=graded("b"))), "x.ipynb")
    assert normalized(once, "x.ipynb") == once
    assert once.endswith("}\n")


def test_the_order_of_keys_does_not_matter():
    cell = code(id="a", metadata={"tags": ["t"], "editable": True})
    turned = {key: cell[key] for key in reversed(cell)}
    turned["metadata"] = {"editable": True, "tags": ["t"]}
    assert normalized(text_of(cell), "x.ipynb") == normalized(text_of(turned), "x.ipynb")


def test_a_missing_id_comes_from_the_grade_id_or_a_number():
    cells = [code(), code(metadata=graded("drive square!")), code(), code(id="cell-1")]
    assert cell_ids(cells) == ["cell-2", "drive-square-", "cell-3", "cell-1"]


def test_an_inserted_cell_changes_no_other_id():
    before = [code(id="cell-1"), code(id="cell-2")]
    assert cell_ids([before[0], code(), before[1]]) == ["cell-1", "cell-3", "cell-2"]


def test_a_copied_cell_gets_an_id_of_its_own():
    copied = code(id="a", metadata=graded("a"))
    assert cell_ids([copied, copied, code(id="not valid!")]) == ["a", "a-1", "cell-1"]


def test_the_command_names_what_differs_then_repairs_it(tmp_path, capsys):
    path = tmp_path / "lesson.ipynb"
    path.write_text(normalized(text_of(code(id="a")), "").replace('_count": null', '_count": 3'))
    assert main(["--check", str(tmp_path)]) == 1
    shown = capsys.readouterr().out
    assert shown.startswith(f"not normalized: {path}\n")
    assert '    -   "execution_count": 3,\n    +   "execution_count": null,\n' in shown
    assert shown.endswith("Run `make tidy` and commit what it changes.\n")
    assert main([str(tmp_path)]) == 0
    assert capsys.readouterr().out.startswith(f"normalized: {path}\n")
    assert main(["--check", str(tmp_path)]) == 0
    assert capsys.readouterr().out == ""


def test_a_long_difference_is_cut(tmp_path, capsys):
    path = tmp_path / "lesson.ipynb"
    path.write_text(json.dumps(json.loads(text_of(*(code(id=f"c{n}") for n in range(9)))), indent=3))
    assert main(["--check", str(path)]) == 1
    assert "\n    ... and " in capsys.readouterr().out


def test_a_missing_newline_is_named(tmp_path, capsys):
    path = tmp_path / "lesson.ipynb"
    path.write_text(normalized(text_of(code(id="a")), "").rstrip("\n"))
    assert main(["--check", str(path)]) == 1
    assert "    the file should end with one newline\n" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "x.ipynb is not a notebook: expected JSON, saw Expecting value: line 1 column 1 (char 0). "
         "Is it incomplete, or does it contain merge conflict markers?"),
        ("[]", "x.ipynb: expected notebook format 4, saw None. Open and save it in JupyterLab."),
        (text_of(nbformat=3), "x.ipynb: expected notebook format 4, saw 3. Open and save it in JupyterLab."),
        (text_of({"cell_type": "poem", "source": ""}), "x.ipynb is not a valid notebook: "
         "{'cell_type': 'poem', 'source': '', 'id': 'cell-1', 'metadata': {}} "
         "is not valid under any of the given schemas. Repair it, or take it from git."),
    ],
)
def test_a_file_that_is_no_notebook_is_refused_with_a_reason(text, words):
    with pytest.raises(InvalidNotebook) as refused:
        normalized(text, "x.ipynb")
    assert str(refused.value) == words


def test_a_path_without_notebooks_is_named(capsys):
    assert main(["--check", "nowhere"]) == 1
    expected = "Expected a notebook or a folder of notebooks at nowhere, saw nothing there.\n"
    assert capsys.readouterr().err == expected


def test_the_notebooks_of_the_course_are_in_the_one_form(monkeypatch, capsys):
    monkeypatch.chdir(ROOT)
    assert main(["--check"]) == 0, capsys.readouterr().out
