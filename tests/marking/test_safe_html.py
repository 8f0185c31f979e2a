import nbformat
import pytest

from grader.marking.demo import mark_samples
from grader.marking.safe_html import clean
from tests.marking.tiny import answer, course, grade


@pytest.mark.parametrize(
    "html",
    [
        '<table style="width: 9em;"><caption>3/4</caption><tbody><tr><td>x</td></tr></tbody></table>',
        '<img src="data:image/png;base64,iVBORw0KGgo=" alt="the path" width="300">',
        "<details><summary>Hint 1</summary><p>Begin with the timer.</p></details>",
        "<h2>Task</h2>\n<blockquote>\n<p>Write a <code>Node</code>.</p>\n</blockquote>",
    ],
)
def test_what_scores_and_tasks_are_made_of_stays(html):
    assert clean(html) == html


@pytest.mark.parametrize(
    ("html", "harmless"),
    [
        ("<script>steal()</script>", "&lt;script&gt;steal()&lt;/script&gt;"),
        ('<img src="x" onerror="steal()">', '<img src="x">'),
        ('<a href="javascript:steal()">look</a>', "<a>look</a>"),
        ('<p style="position: fixed; color: red">over all</p>', '<p style="color: red;">over all</p>'),
        ('<iframe src="/x"></iframe>', '&lt;iframe src="/x"&gt;&lt;/iframe&gt;'),
        (b"<style>body {display: none}</style>", "&lt;style&gt;body {display: none}&lt;/style&gt;"),
    ],
)
def test_what_could_run_or_leave_its_place_goes(html, harmless):
    assert clean(html) == harmless


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
    assert "<p>A <em>word</em> &lt;script&gt;steal()&lt;/script&gt;</p>" in page
    assert "<script>steal()" not in page
