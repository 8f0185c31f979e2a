"""Score tables on nbgrader's pages, which clean what a notebook shows."""

import re

import nh3

from grader import Score
from grader.marking.gradebook.safe_html import clean
from tests.grader.test_score import MIXED, NEWS, typo, verdict


def test_the_html_survives_sanitizing():
    page = Score("talk", MIXED)._repr_html_()
    styles = set(re.findall(r"([a-z-]+): ", " ".join(re.findall(r'style="([^"]+)"', page))))
    parsed = nh3.clean(
        page,
        tags=set(re.findall(r"<(\w+)", page)),
        attributes={"*": {"style", "scope"}},
        filter_style_properties=styles,
    )
    assert clean(page) == parsed


def test_the_graph_passes_the_sanitizer_of_the_pages_and_hostile_names_stay_text():
    recording = typo()
    recording.graph.nodes.append('/x"><script>steal()</script>')
    page = clean(Score("talk", [verdict(2.0, "failed", **NEWS)], [recording])._repr_html_())
    assert re.search(r'<img src="data:image/png;base64,[^"]+" alt="[^"]+" style="max-width:\s?100%">', page)
    assert "<details><summary>The graph of this run" in page
    assert "script" not in page
