import nbformat
import pytest

from grader.marking.gradebook.safe_html import clean, plain_outputs
from grader.marking.release.demo import mark_samples
from tests.marking.tiny import answer, course, grade


@pytest.mark.parametrize(
    "html",
    [
        '<table style="width:9em"><caption>3/4</caption><tbody><tr><td>x</td></tr></tbody></table>',
        '<img src="data:image/png;base64,iVBORw0KGgo=" alt="the path" width="300">',
        "<details><summary>Hint 1</summary><p>Begin with the timer.</p></details>",
        "<h2>Task</h2>\n<blockquote>\n<p>Write a <code>Node</code>.</p>\n</blockquote>",
        '<div class="highlight"><pre><span class="k">def</span> <span class="nf">main</span></pre></div>',
        '<div class="ros2-replay" data-replay="QUJD+/8="><img src="images/a.png" alt="the path"></div>',
    ],
)
def test_what_scores_and_tasks_are_made_of_stays(html):
    assert clean(html) == html


@pytest.mark.parametrize(
    ("html", "harmless"),
    [
        ("a<script>steal()</script>b", "ab"),
        ("a<SCRIPT type=module>steal()</SCRIPT >b", "ab"),
        ("a<script>steal()", "a"),
        ("<scr<script></script>ipt>steal()", ""),
        ('<img src="x" onerror="steal()">', '<img src="x">'),
        ('<a href="javascript:steal()">look</a>', "<a>look</a>"),
        ('<p style="position: fixed; color: red">over all</p>', '<p style="color:red">over all</p>'),
        ('<iframe src="/x"></iframe>', ''),
        (b"a<style>body {display: none}</style>", "a"),
        ('<input id="task1" value="100">', ''),
        ('<div id="task1">4</div>', "<div>4</div>"),
        ('<div class="navbar-fixed-top">over all</div>', "<div>over all</div>"),
        ('<span class="k full-credit">for</span>', "<span>for</span>"),
        ('<img src="https://example.org/seen.png">', "<img>"),
        ('<img src="//example.org/seen.png">', "<img>"),
        ('<img src="\\\\example.org/seen.png">', "<img>"),
        ('<img src="http://[">', "<img>"),
        ('<img src="data:text/html;base64,QUJD">', "<img>"),
        ('<span data-replay="QUJD">not a div</span>', "<span>not a div</span>"),
        ('<div data-replay="QUJD" onclick="steal()">words</div>', '<div data-replay="QUJD">words</div>'),
        ('<div data-replay="{}">no base64</div>', "<div>no base64</div>"),
        (f'<div data-replay="{"A" * 400_001}">too long</div>', "<div>too long</div>"),
    ],
)
def test_what_could_run_or_leave_its_place_goes(html, harmless):
    assert clean(html) == harmless


def test_of_an_output_stays_what_is_only_shown():
    output = nbformat.v4.new_output(
        "display_data",
        data={
            "application/javascript": "steal()",
            "application/vnd.jupyter.widget-view+json": {"model_id": "1"},
            "image/png": "AA==",
            "text/plain": "words",
        },
        metadata={
            "image/png": {"width": "1 onload=steal()", "height": 20, "alt": "the path"},
            "image/jpeg": ["width"],
            "filenames": {"image/png": "https://example.org/seen.png"},
        },
    )
    notebook = nbformat.v4.new_notebook(
        cells=[nbformat.v4.new_code_cell(outputs=[output]), nbformat.v4.new_markdown_cell("words")],
        metadata={"widgets": {}, "kernelspec": {"name": "python3", "display_name": "Python 3"}},
    )
    plain, _ = plain_outputs(notebook, {})
    assert plain.cells[0].outputs[0].data == {"image/png": "AA==", "text/plain": "words"}
    assert plain.cells[0].outputs[0].metadata == {"image/png": {"height": 20, "alt": "the path"}}
    assert list(plain.metadata) == ["kernelspec"]


def test_feedback_shows_a_score_table_and_runs_no_script(tmp_path):
    output = "<table><caption>a table</caption></table><script>steal()</script>"
    show = f"from IPython.display import HTML, display\ndisplay(HTML('{output}'))"
    folder = course(
        tmp_path,
        answer("show", f"### BEGIN SOLUTION\n{show}\n### END SOLUTION"),
        grade("test_show", 1, "1.0"),
        nbformat.v4.new_markdown_cell("A *word* <script>steal()</script>", id="words"),
    )
    page = mark_samples(folder, "01_tiny")[0].feedback.read_text()
    assert "<table><caption>a table</caption></table>" in page
    assert "<p>A <em>word</em> </p>" in page
    assert "steal()</script>" not in page
