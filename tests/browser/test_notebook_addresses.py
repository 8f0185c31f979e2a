"""Notebook 7 lacks the course's extension: no button leads there, and its addresses lead to JupyterLab."""

import pytest

from tests.browser.lab import SHOWN

pytestmark = pytest.mark.browser


def test_no_button_and_no_command_opens_notebook_7(open_lab):
    with open_lab("tiny/right.ipynb") as lab:
        assert lab.page.get_by_role("button", name="Notebook", exact=True).count() == 0
        names = ("open-nbclassic", "open-notebook", "launch-tree")
        assert [name for name in names if lab.has_command(f"jupyter-notebook:{name}")] == []


@pytest.mark.parametrize("path", ["notebooks/tiny/right.ipynb", "tree/tiny/right.ipynb"])
def test_the_address_of_a_notebook_opens_it_in_lab(lab, path):
    lab.page.goto(f"{lab.address}/{path}")
    lab.page.wait_for_url("**/lab/tree/tiny/right.ipynb*")
    lab.wait_for_kernel()
    assert lab.page.locator(f"{SHOWN} .validate-button").is_visible()


def test_the_list_of_files_and_terminals_lead_to_lab(lab):
    for address in ("tree", "terminals/1"):
        lab.page.goto(f"{lab.address}/{address}")
        lab.page.wait_for_url("**/lab*")
        lab.wait("window.jupyterapp")
