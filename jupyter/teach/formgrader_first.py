"""Adds the URL /teach, which opens JupyterLab with the formgrader, and marks in the sandbox from there.

The formgrader is opened by a query parameter, but Jupyter appends its token to the default URL as if there
were none.
"""
from typing import Any

from jupyter_server.base.handlers import RedirectWithParams
from jupyter_server.utils import url_path_join

from grader.marking.gradebook import formgrader_marking


def _jupyter_server_extension_points() -> list[dict[str, str]]:
    return [{"module": "formgrader_first"}]


def _load_jupyter_server_extension(server: Any) -> None:
    """Redirect /teach to the formgrader, with the token if there is one; its Autograde button uses `mark`."""
    formgrader_marking.install()
    here, lab = (url_path_join(server.base_url, path) for path in ("teach", "lab?formgrader=true"))
    server.web_app.add_handlers(".*$", [(here, RedirectWithParams, {"url": lab, "permanent": False})])
