"""Sphinx's settings for the web site of the course; `make_site` copies this file beside the pages.

Nothing of the site is loaded from the network, and it opens from a folder: search is a script, and formulas
are MathML, which browsers draw themselves.
"""
from pathlib import Path
from typing import Any

project = html_title = "ROS 2 in notebooks"
extensions = ["myst_nb"]
html_theme = "furo"
html_math_renderer = "mathml"
html_show_sourcelink = html_copy_source = html_show_copyright = html_show_sphinx = False
html_static_path, html_css_files = [str(Path(__file__).with_name("static"))], ["site.css"]
html_search_scorer = str(Path(__file__).with_name("search.js"))  # by site_search.py
exclude_patterns = ["AGENTS.md", "README.md"]
suppress_warnings = ["myst.header", "myst.xref_missing", "mystnb.mime_priority", "mystnb.unknown_mime_type"]
nb_execution_mode = "off"  # they were executed before, in the course's own environment
nb_merge_streams = True
nb_ipywidgets_js: dict[str, dict[str, str]] = {}
# A live picture needs a kernel; its text says what was played.
nb_mime_priority_overrides = [("html", "application/vnd.jupyter.widget-view+json", None)]
myst_enable_extensions = ["dollarmath"]
myst_dmath_double_inline = True


def _add_formula(translator: Any, node: Any) -> None:
    from docutils import nodes
    from docutils.utils.math.latex2mathml import tex2mathml

    block = node.tagname == "math_block"
    formula = tex2mathml(node.astext(), as_block=block)
    translator.body.append(f'<div style="margin: 1em 0">{formula}</div>' if block else formula)
    raise nodes.SkipNode


def setup(app: Any) -> None:
    """Let formulas be MathML."""
    app.add_html_math_renderer("mathml", (_add_formula, None), (_add_formula, None))
