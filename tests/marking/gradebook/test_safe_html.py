import nbformat
import pytest

from grader.marking.gradebook.safe_html import clean, plain_outputs


@pytest.mark.parametrize(
    "html",
    [
        '<table style="width:9em"><caption>3/4</caption><tbody><tr><td>x</td></tr></tbody></table>',
        '<img src="data:image/png;base64,iVBORw0KGgo=" alt="the path" width="300">',
        "<details><summary>Hint 1</summary><p>Begin with the timer.</p></details>",
        "<h2>Task</h2>\n<blockquote>\n<p>Write a <code>Node</code>.</p>\n</blockquote>",
        '<div class="highlight"><pre><span class="k">def</span> <span class="nf">main</span></pre></div>',
        '<div class="ros2-replay" data-replay="QUJD+/8="><img src="data:image/png;base64,AA==" alt=""></div>',
        '<div style="margin:1em;margin-top:0.5em;margin:0 auto 2px 3%">words</div>',
        '<a href="https://docs.ros.org/en/jazzy">ROS</a> <a href="mailto:a@b.org">a</a>',
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
        ('<img src="x" onerror="steal()">', "<img>"),
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
        ('<img src="/hub/logout">', "<img>"),
        ('<img src="../../hub/logout" alt="out">', '<img alt="out">'),
        ('<a href="data:text/html;base64,QUJD">look</a>', "<a>look</a>"),
        ('<a href="/hub/logout">look</a>', "<a>look</a>"),
        ('<p style="margin-top: -900px; color: red">over all</p>', '<p style="color:red">over all</p>'),
        ('<p style="MARGIN:calc(1px*cos(3.14)) 1px">over all</p>', "<p>over all</p>"),
        ('<p style="margin:\\2d 5px">over all</p>', "<p>over all</p>"),
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
