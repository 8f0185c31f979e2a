import shutil
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page

from grader.marking.release.make_exercises import release
from grader.marking.release.samples import SHARES, submit_samples
from tests.browser.lab import ROOT, Lab, copy_for_students, server
from tests.browser.pictures import CHROMIUM, COUNT_FRAMES, chromium
from tests.marking.tiny import tiny
from tests.patience import PATIENCE

WINDOW = {"width": 1280, "height": 900}


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    missing = pytest.mark.skip(reason="no Chromium here: install it with `apt install chromium`")
    for item in items:
        if "browser" in item.keywords and not CHROMIUM:
            item.add_marker(missing)


@pytest.fixture(scope="package")
def browser() -> Iterator[Browser]:
    """Chromium, as long as a test of this folder follows another; no longer: see `chromium`."""
    with chromium() as started:
        yield started


@pytest.fixture(scope="module")
def tab(browser) -> Iterator[Page]:
    """A tab without network. To open one takes four times what it takes to load a page into it."""
    context = browser.new_context(offline=True)
    context.set_default_timeout(PATIENCE * 1000)
    page = context.new_page()
    page.on("pageerror", lambda error: page.faults.append(str(error)))
    yield page
    context.close()


@pytest.fixture
def page(tab) -> Page:
    """The tab of the module, empty again; what goes wrong in its scripts is kept in its `faults`."""
    tab.goto("about:blank")
    tab.emulate_media(color_scheme="null")
    tab.set_viewport_size({"width": 900, "height": 800})
    tab.faults = []
    return tab


@pytest.fixture(scope="session")
def students_folder(tmp_path_factory) -> Path:
    """The course as students have it, with the folders solved/ and tiny/.

    solved/ has the assignments with all answers; tiny/ has three submissions of a small one.
    """
    folder = copy_for_students(tmp_path_factory.mktemp("students"))
    course = tiny(tmp_path_factory.mktemp("tiny"))
    release(course)
    submit_samples(course, "01_tiny")
    (folder / "tiny").mkdir()
    for student in SHARES:
        submitted = course / "class" / "submitted" / student / "01_tiny" / "tiny.ipynb"
        shutil.copy(submitted, folder / "tiny" / f"{student}.ipynb")
    shutil.copytree(ROOT / "solutions", folder / "solved", ignore=shutil.ignore_patterns(".*", "my_*"))
    return folder


@pytest.fixture(scope="package")
def address(students_folder) -> Iterator[str]:
    """A running JupyterLab in the students' folder."""
    with server(students_folder) as url:
        yield url


@pytest.fixture(scope="package")
def open_lab(browser, address) -> Iterator[Callable[[str], AbstractContextManager[Lab]]]:
    """Open a notebook; in the end it is closed, and its kernel is shut down.

    JupyterLab itself is loaded once for all files, which takes longer than most of what a test does there;
    where one could not be opened or closed, it is loaded again. The page counts the frames that its pictures
    paint, as `framesPainted`.
    """
    page = browser.new_page(viewport=WINDOW)
    page.add_init_script(COUNT_FRAMES)
    lab = Lab(page, address)

    @contextmanager
    def opened(notebook: str) -> Iterator[Lab]:
        page.set_viewport_size(WINDOW)
        try:
            lab.turn_to(notebook)
            yield lab
            lab.leave()
        except BaseException:
            lab.shut_down()
            page.goto("about:blank")
            raise

    yield opened
    page.close()


@pytest.fixture
def lab(browser, address) -> Iterator[Lab]:
    page = browser.new_page(viewport=WINDOW)
    yield Lab(page, address)
    page.close()
