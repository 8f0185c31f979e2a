"""The map's order agrees with what each lesson and each page of the bridge needs."""

import json
import re
from pathlib import Path

import pytest

from grader import course_map
from grader.course_files.course_notebooks import BRIDGE

ROOT = Path(__file__).parents[3]
CHAPTERS = course_map(ROOT / "course").chapters
NOTEBOOKS = [book for chapter in CHAPTERS for part in chapter.parts for book in part.notebooks if not book.most]
LESSONS = [book.number for book in NOTEBOOKS if book.path.parent.name != BRIDGE]
PAGES = {book.number: book for book in NOTEBOOKS if book.path.parent.name == BRIDGE}
OFFERED = {
    page.number: part for chapter in CHAPTERS for part in chapter.parts for page in part.pages
}


def needed_lessons(text):
    """The numbers in a sentence such as "lessons 1 to 3 and 11, and lesson 4b": 1, 2, 3, 11, 4b."""
    found = set()
    for listed in re.findall(r"lessons? ((?:\d+[a-z]?(?:, and |, | and | to )?)+)", text):
        numbers = re.findall(r"\d+[a-z]?", listed)
        found.update(numbers)
        for first, last in re.findall(r"(\d+) to (\d+)", listed):
            found.update(map(str, range(int(first), int(last) + 1)))
    return found


def place(number):
    """Where a lesson is in the map: "5" is where 5a is."""
    return next(i for i, lesson in enumerate(LESSONS) if re.fullmatch(f"{number}[a-z]?", lesson))


def needed_by_page(number):
    """The lessons that a page of the bridge needs, and those that the pages need that it needs."""
    needs = PAGES[number].needs
    pages = re.findall(r"pages? (\d+)", needs)
    for first, last in re.findall(r"pages (\d+) to (\d+)", needs):
        pages += range(int(first), int(last) + 1)
    return needed_lessons(needs).union(*(needed_by_page(f"B{page}") for page in pages))


def test_the_numbers_in_a_sentence_are_found():
    assert needed_lessons("lessons 1 to 3 and 11, and part 6 of lesson 4b") == {"1", "2", "3", "11", "4b"}
    assert needed_lessons("lesson 0, and Python's classes") == {"0"}
    assert needed_lessons("Python 3.11") == set()


@pytest.mark.parametrize("book", NOTEBOOKS[1 : len(LESSONS)], ids=lambda book: book.number)
def test_a_lesson_needs_only_lessons_that_the_map_has_before_it(book):
    needed = needed_lessons(book.needs)
    assert needed, "the title cell names the lessons that come before"
    assert [number for number in needed if place(number) >= place(book.number)] == []


def test_the_lessons_are_in_the_order_of_their_numbers():
    assert sorted(LESSONS, key=lambda number: (int(number.rstrip("abc")), number)) == LESSONS


@pytest.mark.parametrize("number", PAGES)
def test_a_page_of_the_bridge_is_offered_after_the_last_lesson_that_it_needs(number):
    last = max(needed_by_page(number), key=place)
    assert OFFERED[number].notebooks[0].number.rstrip("abc") == last.rstrip("abc")


@pytest.mark.parametrize("number", PAGES)
def test_a_lesson_links_at_its_end_to_the_pages_that_are_offered_after_it(number):
    lessons = [book.path for book in OFFERED[number].notebooks if not book.most]
    cells = json.loads(lessons[-1].read_text("utf-8"))["cells"]
    (summary,) = ["".join(cell["source"]) for cell in cells if cell["id"] == "summary"]
    assert f"](../{BRIDGE}/{PAGES[number].path.name})" in summary


def test_each_page_of_the_bridge_is_offered_once():
    offers = [page.number for chapter in CHAPTERS for part in chapter.parts for page in part.pages]
    assert sorted(offers) == sorted(PAGES)
