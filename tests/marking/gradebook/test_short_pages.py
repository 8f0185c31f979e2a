import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_output, new_raw_cell

from grader.marking.gradebook.safe_html import clean
from grader.marking.gradebook.short_pages import MARKUP, MAX_PAGE_CHARS, MAX_TEXT_CHARS, TOO_LONG, shorten

NOTE = new_output("stream", text=f"{TOO_LONG}\n")


def shortened(*cells):
    notebook = nbformat.v4.new_notebook(cells=[*cells])
    return nbformat.from_dict(shorten(notebook, {})[0]).cells


def html(text):
    return new_output("display_data", {"text/html": text})


def test_what_is_of_an_ordinary_size_stays():
    picture = new_output("display_data", {"image/png": "A" * 10_000_000, "text/plain": "a picture"})
    replay = html(f'<div class="ros2-replay" data-replay="{"A" * 300_000}">a replay</div>')
    error = new_output("error", ename="E", evalue="e", traceback=["E: e"])
    cells = [new_markdown_cell("words"), new_code_cell("x = 1", outputs=[picture, *[replay] * 20, error])]
    assert shortened(*cells) == cells


@pytest.mark.parametrize("text", ["<div>" * 200_000, "<p " + "a " * 400_000 + ">"])
def test_html_that_would_take_an_hour_to_clean_is_left_out(text):
    assert clean(text) == f"<p>{TOO_LONG}</p>"


def test_a_cell_too_long_to_be_colored_is_left_out():
    long = "x" * (MAX_TEXT_CHARS + 1)
    cells = shortened(new_code_cell(long), new_markdown_cell(long), new_raw_cell(long))
    assert [cell.source for cell in cells] == [f"# {TOO_LONG}", TOO_LONG, TOO_LONG]


def test_a_long_text_is_shortened_to_its_beginning_and_its_end():
    lines = "".join(f"{number:06}\n" for number in range(200_000))
    ends = f"{lines[:10_000]}\n[... 1,380,000 more characters ...]\n{lines[-10_000:]}"
    [cell] = shortened(
        new_code_cell(
            "x",
            outputs=[
                new_output("stream", text=lines),
                new_output("execute_result", {"text/plain": "y" * 400_000}),
                new_output("error", ename="E", evalue="e", traceback=lines.split("\n")),
                new_output("stream", text="the end\n"),
            ],
        )
    )
    printed, shown, error, last = cell.outputs
    assert printed.text == "\n".join(error.traceback) == ends
    line = "y" * 10_000
    assert shown.data["text/plain"] == f"{line}\n[... 380,000 more characters ...]\n{line}"
    assert last.text == "the end\n"


def test_when_the_page_is_full_the_rest_is_left_out():
    long = html("-" * ((MAX_PAGE_CHARS - 2000) // MARKUP))
    full = new_code_cell("x", outputs=[long, *[html("")] * 3])
    behind = new_code_cell("y", outputs=[html(""), html("")])
    first, last = shortened(full, behind)
    assert first.outputs == [*full.outputs[:3], NOTE]
    assert (last.source, last.outputs) == (f"# {TOO_LONG}", [NOTE])


@pytest.mark.parametrize(
    ("output", "most"),
    [(html(""), 2_001), (html('<div data-replay="QQ">'), 25), (html("<p>" * 10_000), 9)],
)
def test_a_page_holds_so_many_of_an_output(output, most):
    [cell] = shortened(new_code_cell("", outputs=[output] * 3_000))
    assert cell.outputs == [*[output] * (len(cell.outputs) - 1), NOTE]
    assert len(cell.outputs) == most
