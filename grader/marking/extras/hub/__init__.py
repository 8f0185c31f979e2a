"""A JupyterHub for a class: one installation, Unix users, nbgrader's exchange; `make hub`."""
