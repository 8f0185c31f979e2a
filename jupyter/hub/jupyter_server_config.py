"""JupyterLab on a hub: what a student's server has on top of the configuration of `make lab`."""
c = get_config()  # noqa: F821  (Jupyter provides it)

# nbgrader's list of assignments: to submit and to fetch feedback. The extensions of `make lab` stay.
c.ServerApp.jpserver_extensions.update({
    "nbgrader.server_extensions.assignment_list": True,
    "grader.marking.extras.hub.submit_button": True,
})
# Of a kernel that listens on a port, other users of the machine could read the outputs.
c.KernelManager.transport = "ipc"
# A hub that stops asks no questions.
c.JupyterApp.answer_yes = True
