"""Leads addresses of Notebook 7 (/tree, /notebooks/...) to JupyterLab, which has the course's extension."""
from typing import Any

from jupyter_server.base.handlers import JupyterHandler
from jupyter_server.utils import url_path_join
from tornado import web

ADDRESSES = r"/(tree|notebooks|edit|consoles|terminals)(/.*)?"


def _jupyter_server_extension_points() -> list[dict[str, str]]:
    return [{"module": "lab_addresses"}]


def _load_jupyter_server_extension(server: Any) -> None:
    """Redirect the addresses; for a file, to that file in JupyterLab."""
    pattern = url_path_join(server.base_url, ADDRESSES)
    server.web_app.add_handlers(".*$", [(pattern, _ToLab)])


class _ToLab(JupyterHandler):
    @web.authenticated
    def get(self, kind: str, path: str | None) -> None:
        file = path if kind != "terminals" and (path or "/") != "/" else ""
        target = url_path_join(self.base_url, "lab", f"tree{file}" if file else "")
        query = self.request.query
        self.redirect(f"{target}?{query}" if query else target)
