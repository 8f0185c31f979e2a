"""What happens to a notebook's file on its way, and what becomes of it."""

import io
import re
import zipfile

import pytest

from grader.marking.errors import Unusable
from grader.marking.submission.plain_cells import MAX_CELL_CHARS, MAX_CELLS, MAX_CHARS, read_notebook
from grader.marking.submission.rebuild import rebuild
from grader.marking.submission.recover_json import MAX_JSON_PARTS
from tests.marking.submission.damage import SOLVED, STARTER, cell, data, own, same, solved

WHOLE = data(SOLVED)
GREEK = WHOLE.decode().replace("import rclpy", "# Grüße, Ω\\nimport rclpy", 1)
LATIN = GREEK.replace("Ω", "")
AGAIN = "Download the notebook again in JupyterLab (File, Download) and hand that in."


def old(version):
    """The notebook as the formats 2 and 3 had it: cells in worksheets, code as `input`, headings."""
    notebook = solved()
    cells = notebook.pop("cells")
    for each in cells:
        del each["id"]
        if each["cell_type"] == "code":
            each["input"] = each.pop("source")
    cells[0]["cell_type"] = "heading"
    return {**notebook, "nbformat": version, "worksheets": [{"cells": cells}]}


def twice_a_key():
    return WHOLE.replace(b'"source": "nodes.hello.grade', b'"source": "x", "source": "nodes.hello.grade')


def many(each, number):
    """A notebook with so many equal cells; `data` would take seconds for them."""
    before, after = data({**solved(), "cells": ["here"]}).split(b'"here"')
    return before + b",".join([data(each)] * number) + after


def zipped():
    with zipfile.ZipFile(file := io.BytesIO(), "w") as archive:
        archive.writestr("nodes.ipynb", WHOLE)
    return file.getvalue()


REPAIRED = {
    "byte order mark": (
        b"\xef\xbb\xbf" + WHOLE,
        "The notebook's file began with a byte order mark; it was read without.",
    ),
    "UTF-16": (
        WHOLE.decode().encode("utf-16"),
        "The notebook's file was saved as UTF-16; it was read as such.",
    ),
    "UTF-16 without mark": (
        WHOLE.decode().encode("utf-16-le"),
        "The notebook's file was saved as UTF-16; it was read as such.",
    ),
    "UTF-32": (
        WHOLE.decode().encode("utf-32"),
        "The notebook's file was saved as UTF-32; it was read as such.",
    ),
    "zeros behind": (
        WHOLE + b"\0" * 5000,
        "There were zero bytes in the notebook's file; they were left out.",
    ),
    "zeros within": (
        WHOLE.replace(b"rclpy", b"rcl\0py", 3),
        "There were zero bytes in the notebook's file; they were left out.",
    ),
    "garbage behind": (
        WHOLE + b"}\n <html>",
        "The notebook's file contained something else after its end; that was left out.",
    ),
    "two notebooks in a file": (
        WHOLE + b"\n" + WHOLE,
        "The notebook's file contained something else after its end; that was left out.",
    ),
    "a key twice": (
        twice_a_key(),
        "The notebook's file had `source` twice in one place; the last was read.",
    ),
    "format 3": (
        data(old(3)),
        "The notebook's format is `3`; it was read as well as possible. Expected was `4`.",
    ),
    "format 2": (
        data(old(2)),
        "The notebook's format is `2`; it was read as well as possible. Expected was `4`.",
    ),
    "format of tomorrow": (
        data({**solved(), "nbformat": 5}),
        "The notebook's format is `5`; it was read as well as possible. Expected was `4`.",
    ),
    "format unknown": (
        data({**solved(), "nbformat": None}),
        "The notebook's format is unknown; it was read as well as possible. Expected was `4`.",
    ),
    "cut off in its metadata": (
        WHOLE[: WHOLE.rindex(b'"language_info"')],
        "The notebook's file is damaged after cell 39; the cells before that were marked.",
    ),
}

REFUSED = {
    "empty": (b"", f"`nodes.ipynb` is empty; expected a notebook. {AGAIN}"),
    "zeros": (
        b"\0" * 4096,
        f"`nodes.ipynb` contains nothing but zeros and blanks; expected a notebook. {AGAIN}",
    ),
    "Python": (
        b"import rclpy\n\n\nclass Hello:\n    pass\n",
        f"`nodes.ipynb` is not a notebook: expected JSON, beginning with `{{`, saw something else. {AGAIN}",
    ),
    "a picture": (
        b"\x89PNG\r\n\x1a\n\xff\xd8",
        f"`nodes.ipynb` is not a notebook: expected JSON, beginning with `{{`, saw something else. {AGAIN}",
    ),
    "web page": (
        b"<!DOCTYPE html>\n<html><title>Please log in</title></html>",
        f"`nodes.ipynb` contains a web page, perhaps a login page; expected a notebook. {AGAIN}",
    ),
    "zip archive": (
        zipped(),
        "`nodes.ipynb` is a zip archive; expected a notebook. "
        "Unpack it and hand in the notebook inside.",
    ),
    "merge marks": (
        WHOLE.replace(b'   "source"', b'<<<<<<< HEAD\n   "source"\n=======\n   "source"\n>>>>>>> mine\n', 1),
        "`nodes.ipynb` contains git's merge conflict markers (`<<<<<<<`), which means two versions of it. "
        "Choose one, open it in JupyterLab, save it and hand it in again.",
    ),
    "JSON, but a list": (b"[1, 2]", f"`nodes.ipynb` contains JSON, but not a notebook. {AGAIN}"),
    "JSON, but other data": (
        b'{"name": "Alice", "worksheets": 5}',
        "`nodes.ipynb` contains no cells; expected a notebook. "
        "Hand in the notebook's own file, as JupyterLab saves it.",
    ),
    "cut off in its first cell": (
        WHOLE[:60],
        f"`nodes.ipynb` is damaged from its beginning; expected a notebook. {AGAIN}",
    ),
    "number without end": (
        b'{"nbformat": ' + b"4" * 10_000 + b"}",
        f"`nodes.ipynb` is damaged from its beginning; expected a notebook. {AGAIN}",
    ),
    "tables without end": (
        b'{"cells": ' + b"[" * 200_000,
        f"`nodes.ipynb` contains endlessly nested tables; expected a notebook. {AGAIN}",
    ),
    "too many cells": (
        many(own("x"), 50_000),
        f"`nodes.ipynb` has 50000 cells; at most {MAX_CELLS} can be marked. "
        "Delete those that you don't need and hand it in again.",
    ),
    "too much text": (
        data({**solved(), "cells": [own("#" * MAX_CELL_CHARS)] * 6}),
        "The cells of `nodes.ipynb` contain 6.0 million characters of text; at most 5 million can be marked. "
        "Make them shorter.",
    ),
    "too many parts": (
        b'{"cells": [' + b"{}," * MAX_JSON_PARTS,
        "`nodes.ipynb` is made of 20 million parts; at most 10 million can be read. "
        "Clear its outputs (Edit, Clear Outputs of All Cells) and hand it in again.",
    ),
    "no cells of the course": (
        data({**solved(), "cells": [own("print('hello')")]}),
        "Expected a notebook with this assignment's cells (`battery`, `battery-points`, `counter`, "
        "`counter-points`, `heart` and 8 more), saw none of them. Hand in the notebook of this assignment.",
    ),
    "no cells at all": (
        data({**solved(), "cells": []}),
        "Expected a notebook with this assignment's cells (`battery`, `battery-points`, `counter`, "
        "`counter-points`, `heart` and 8 more), saw none of them. Hand in the notebook of this assignment.",
    ),
}


@pytest.mark.parametrize(("content", "words"), REPAIRED.values(), ids=REPAIRED)
def test_a_damaged_file_is_read_as_well_as_possible_and_that_is_reported(content, words):
    result = rebuild(STARTER, read_notebook(content, "nodes.ipynb"))
    assert (result.repairs, result.flags) == ([words], [])
    assert same(result.notebook)


@pytest.mark.parametrize(("content", "words"), REFUSED.values(), ids=REFUSED)
def test_a_file_that_holds_no_notebook_gets_a_verdict(content, words):
    with pytest.raises(Unusable) as caught:
        rebuild(STARTER, read_notebook(content, "nodes.ipynb"))
    assert str(caught.value) == words


def test_a_file_that_breaks_off_is_marked_as_far_as_it_goes():
    cut = WHOLE[: WHOLE.index(b"nodes.counter.grade")]
    result = rebuild(STARTER, read_notebook(cut, "nodes.ipynb"))
    assert [name for name, state in result.answers.items() if state == "answered"] == ["hello", "counter"]
    assert result.repairs == [
        "The notebook's file is damaged after cell 12; the cells before that were marked.",
        "The answers `battery`, `heart`, `main`, `weather-module` and `weather-node` were missing; "
        "empty cells took their places.",
        "The test cells `counter-points`, `battery-points`, `heart-points`, `main-points` and "
        "`weather-points` were missing; the instructor's own were run.",
        "The cells `battery-see`, `heart-see`, `main-given`, `main-see`, `weather-see` and 1 more were "
        "missing; those that were handed out were run.",
    ]


@pytest.mark.parametrize(
    ("old", "new"), [(b'",\n   "metadata"', b'"$\n   "metadata"'), (b'"id": "', b'"id": '), (b": {", b": ", )]
)
@pytest.mark.parametrize("number", [0, 3, 12])
def test_one_wrong_byte_costs_one_cell(old, new, number):
    begin = [found.start() for found in re.finditer(rb"\n  \{\n", WHOLE)][number]
    content = WHOLE[:begin] + WHOLE[begin:].replace(old, new, 1)
    notebook = read_notebook(content, "nodes.ipynb")
    whole = [cell.text for cell in read_notebook(WHOLE, "nodes.ipynb").cells]
    assert [cell.text for cell in notebook.cells] == whole[:number] + whole[number + 1 :]
    where = f"after cell {number}" if number else "in its first cell"
    words = f"The notebook's file is damaged {where}; the next cell that can be read was marked."
    assert notebook.repairs == [words]


def test_what_is_damaged_in_many_places_is_marked_as_far_as_it_goes():
    content = WHOLE.replace(b'"cell_type": "code"', b'"cell_type" "code"')
    notebook = read_notebook(content, "nodes.ipynb")
    assert len(notebook.repairs) == 11
    assert notebook.repairs[-1].endswith("the cells before that were marked.")


def test_a_file_that_is_not_utf_8_is_read_as_latin_1():
    notebook = read_notebook(LATIN.encode("latin-1"), "nodes.ipynb")
    assert notebook.repairs == ["The notebook's file was not saved as UTF-8; it was read as Latin 1."]
    assert any("# Grüße, \n" in cell.text for cell in notebook.cells)


def test_a_few_damaged_characters_is_distinguished_from_another_encoding():
    notebook = read_notebook(GREEK.encode().replace("Ω".encode(), b"\xce"), "nodes.ipynb")
    assert notebook.repairs == ["In the notebook's file 1 character was damaged; it was read as �."]
    notebook = read_notebook(GREEK.encode().replace("Ω".encode(), b"\xce \xcf"), "nodes.ipynb")
    assert notebook.repairs == ["In the notebook's file 2 characters were damaged; they were read as �."]
    assert any("# Grüße, � �\n" in cell.text for cell in notebook.cells)


def test_outputs_of_a_hundred_megabytes_are_no_matter():
    notebook = solved()
    cell(notebook, "hello")["outputs"] = [{"output_type": "stream", "name": "stdout", "text": "x" * 10**8}]
    result = rebuild(STARTER, read_notebook(data(notebook), "nodes.ipynb"))
    assert (result.repairs, result.flags) == ([], [])
    assert same(result.notebook)


def test_an_answer_of_a_megabyte_is_run():
    assert MAX_CHARS > MAX_CELL_CHARS == 10**6
    notebook = solved()
    cell(notebook, "hello")["source"] = "#" * MAX_CELL_CHARS
    result = rebuild(STARTER, read_notebook(data(notebook), "nodes.ipynb"))
    assert result.repairs == []
    assert next(c.source for c in result.notebook.cells if c.id == "hello") == "#" * MAX_CELL_CHARS


def test_merge_marks_in_a_students_text_are_text():
    notebook = solved()
    cell(notebook, "title")["source"] = "<<<<<<< HEAD\n=======\n>>>>>>> mine"
    assert read_notebook(data(notebook), "nodes.ipynb").repairs == []
