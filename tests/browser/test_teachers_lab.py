import json
import shutil
import urllib.error
import urllib.request
from contextlib import chdir

import pytest

from grader.marking.command.mark_class import Settings, mark_class
from tests.browser.lab import ROOT, Lab, log_of, server
from tests.browser.pictures import patient_page
from tests.marking.classroom import ASSIGNMENT, classroom, submit
from tests.marking.fake_pool import opening


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    """JupyterLab as `make teach` starts it, in a class with two submissions that are marked."""
    course = classroom(tmp_path_factory.mktemp("class"))
    submit(course, "anna", "bob")
    with chdir(course.root):
        mark_class(course, ASSIGNMENT, Settings(feedback=False), opening(course))
    shutil.copytree(ROOT / "jupyter", course.root / "jupyter")
    with server(course.root, settings="jupyter/teach") as url:
        yield url


def test_the_formgrader_answers(address):
    with urllib.request.urlopen(f"{address}/formgrader/api/submissions/{ASSIGNMENT}") as answer:
        found = {each["student"]: each for each in json.load(answer)}
    assert {student: each["autograded"] for student, each in found.items()} == {"anna": True, "bob": True}
    assert found["anna"]["max_score"] == 15
    assert (found["anna"]["last_name"], found["anna"]["first_name"]) == ("anna", "")
    with urllib.request.urlopen(f"{address}/formgrader/manage_assignments") as answer:
        assert 'class="alert' not in answer.read().decode()


def test_the_address_that_is_printed_leads_to_the_formgrader_and_keeps_its_token(address):
    class Stay(urllib.request.HTTPRedirectHandler):
        def redirect_request(self, *_):
            return None

    with pytest.raises(urllib.error.HTTPError) as led:
        urllib.request.build_opener(Stay).open(f"{address}/teach?token=abc")
    assert (led.value.code, led.value.headers["Location"]) == (302, "/lab?formgrader=true&token=abc")
    assert f"{address}/teach\n" in log_of(address).read_text()


@pytest.mark.browser
def test_lab_opens_on_the_formgrader_and_a_marked_submission_can_be_seen(browser, address):
    page = patient_page(browser, viewport={"width": 1280, "height": 900})
    lab = Lab(page, address)
    page.goto(address)
    panel = page.frame_locator("iframe[src*='formgrader']")
    panel.get_by_role("link", name=ASSIGNMENT).first.wait_for()
    assert page.url.startswith(f"{address}/lab?formgrader=true")
    lab.screenshot("teach")
    commands = ("open-formgrader", "open-create-assignment")
    assert [lab.has_command(f"nbgrader:{name}") for name in commands] == [True, True]
    assert not lab.has_command("nbgrader:open-assignment-list")
    page.goto(f"{address}/formgrader/gradebook/{ASSIGNMENT}/nodes")
    page.get_by_role("link", name="Submission #1").click()
    page.get_by_text("counter: ").wait_for()
    lab.screenshot("formgrader_submission")
    page.close()
