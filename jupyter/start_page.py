"""Serves the start page as HTML: the text of course/start.ipynb around the course map and three questions."""
import asyncio
import datetime
import json
from pathlib import Path
from typing import Any

import mistune
from jupyter_server.base.handlers import JupyterHandler
from jupyter_server.utils import url_path_join
from tornado import web

from grader import course_map
from grader.course_files.review_questions import review_html, review_questions

ADDRESS = "ros2-course/start"
NOTEBOOK = "course/start.ipynb"


def _jupyter_server_extension_points() -> list[dict[str, str]]:
    return [{"module": "start_page"}]


def _load_jupyter_server_extension(server: Any) -> None:
    pattern = url_path_join(server.base_url, ADDRESS)
    server.web_app.add_handlers(".*$", [(pattern, _StartPage)])


class _StartPage(JupyterHandler):
    @web.authenticated
    async def get(self) -> None:
        root = Path(self.settings["server_root_dir"]).expanduser()
        try:
            page = await asyncio.to_thread(start_page, root)
        except LookupError as error:
            self.set_status(404)
            page = f"<p>{mistune.escape(str(error))}</p>"
        self.set_header("Content-Type", "text/html; charset=UTF-8")
        self.finish(page)


def start_page(root: Path) -> str:
    """The page, with addresses relative to course/. Raises LookupError if `root` has no course."""
    notebook = root / NOTEBOOK
    cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"] if notebook.exists() else []
    questions = review_html(review_questions(root / "course", datetime.date.today()))
    page = questions + course_map(root / "course")._repr_html_()
    markdown = mistune.create_markdown(escape=True)
    parts = [markdown("".join(cell["source"])) if cell["cell_type"] == "markdown" else page for cell in cells]
    return "\n".join(parts or [page])
