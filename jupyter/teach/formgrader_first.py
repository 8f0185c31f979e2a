"""The address that `make teach` prints: it opens JupyterLab with the formgrader.

A parameter of Lab's address opens that, and Jupyter writes its token behind an address as if it had none.
"""
from typing import Any

from jupyter_server.base.handlers import RedirectWithParams
from jupyter_server.utils import url_path_join


def _jupyter_server_extension_points() -> list[dict[str, str]]:
    return [{"module": "formgrader_first"}]


def _load_jupyter_server_extension(server: Any) -> None:
    """Lead from /teach to the formgrader, with the token if there is one."""
    here, lab = (url_path_join(server.base_url, path) for path in ("teach", "lab?formgrader=true"))
    server.web_app.add_handlers(".*$", [(here, RedirectWithParams, {"url": lab, "permanent": False})])
