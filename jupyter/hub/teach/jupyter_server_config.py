"""The server on which teachers mark a course on a hub: what it has on top of `make teach`."""
c = get_config()  # noqa: F821  (Jupyter provides it)

# A page of its own: JupyterHub lets no page show another one in a frame, as the panel of JupyterLab would.
c.LabApp.default_url = c.ServerApp.default_url = "/formgrader"
c.KernelManager.transport = "ipc"
# A hub that stops asks no questions.
c.JupyterApp.answer_yes = True
