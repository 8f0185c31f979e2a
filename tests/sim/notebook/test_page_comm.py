"""The comm to the page of a notebook."""

import sys

from sim.notebook.page_comm import PageComm


def test_a_kernel_without_comms_shows_nothing_beside_the_notebook(monkeypatch):
    monkeypatch.setitem(sys.modules, "comm", None)  # as in an old kernel: importing it is an error
    page = PageComm()
    page.open(lambda order, texts: None)
    page.show({"text/plain": "the robot"})
    assert page._comm is None
