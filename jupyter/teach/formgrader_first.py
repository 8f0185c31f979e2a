"""Adds the URL /teach, which opens JupyterLab with the formgrader, and marks in the sandbox from there.

The formgrader is opened by a query parameter, but Jupyter appends its token to the default URL as if there
were none.
"""
from pathlib import Path
from typing import Any

import nbgrader.server_extensions.formgrader as formgrader
from jupyter_server.base.handlers import JupyterHandler, RedirectWithParams
from jupyter_server.utils import url_path_join
from tornado import web

from grader.marking.gradebook import formgrader_marking

SCRIPT = "formgrader/static/js/utils.js"
# Its links to notebooks and folders begin at the top of the site, where on a hub there is no notebook.
LINK = '.attr("href", prefix + path)'
WHOLE_LINK = r'.attr("href", base_url.replace(/\/formgrader$/, "") + prefix + path)'


def _jupyter_server_extension_points() -> list[dict[str, str]]:
    return [{"module": "formgrader_first"}]


def _load_jupyter_server_extension(server: Any) -> None:
    """Redirect /teach to the formgrader, with the token if there is one; its Autograde button uses `mark`."""
    formgrader_marking.install()
    here, lab = (url_path_join(server.base_url, path) for path in ("teach", "lab?formgrader=true"))
    script = url_path_join(server.base_url, SCRIPT)
    handlers = [(here, RedirectWithParams, {"url": lab, "permanent": False}), (script, _Script)]
    server.web_app.add_handlers(".*$", handlers)


class _Script(JupyterHandler):
    @web.authenticated
    def get(self) -> None:
        file = Path(formgrader.__file__).parent.joinpath(*SCRIPT.split("/")[1:])
        self.set_header("Content-Type", "text/javascript; charset=utf-8")
        self.finish(file.read_text(encoding="utf-8").replace(LINK, WHOLE_LINK))
