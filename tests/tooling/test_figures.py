"""The drawings in the texts of lessons and exercises: SVG files in course/images, in light and dark."""

import json
import re
from pathlib import Path
from xml.etree import ElementTree

import pytest

ROOT = Path(__file__).parents[2]
FIGURES = sorted((ROOT / "course" / "images").glob("*.svg"))
IMAGE = re.compile(r"!\[([^]]*)\]\(([^)]+)\)")
FENCE = re.compile(r"^```\n(.*?)^```", re.MULTILINE | re.DOTALL)
DRAWN = re.compile(r"-{2,}>|<-{2,}|\+-{2,}|[─│┌└▼▲]")  # arrows and boxes of characters
RULE = re.compile(r"([^{}]+)\{([^{}]*)\}")
DARK = re.compile(r"@media \(prefers-color-scheme: dark\) \{(.*?\})\s*\}", re.DOTALL)
ALT = 25  # characters: less doesn't say what a drawing shows


def texts() -> list[tuple[Path, str]]:
    """The cells with text of all lessons, pages and exercises."""
    found = []
    for folder in ("course", "solutions"):
        for path in sorted((ROOT / folder).glob("*/*.ipynb")):
            cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
            found += [(path, "".join(cell["source"])) for cell in cells if cell["cell_type"] == "markdown"]
    return found


def colors(sheet: str) -> dict[str, dict[str, str]]:
    """The properties of each selector."""
    found: dict[str, dict[str, str]] = {}
    for selector, body in RULE.findall(sheet):
        pairs = (pair.split(":", 1) for pair in body.split(";") if ":" in pair)
        found.setdefault(selector.strip(), {}).update({name.strip(): value.strip() for name, value in pairs})
    return found


def contrast(one: str, other: str) -> float:
    """The contrast of two colors, #rrggbb, as WCAG 2 computes it."""

    def brightness(color: str) -> float:
        parts = (int(color[start : start + 2], 16) / 255 for start in (1, 3, 5))
        linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
        return sum(weight * part for weight, part in zip((0.2126, 0.7152, 0.0722), linear, strict=True))

    low, high = sorted((brightness(one), brightness(other)))
    return (high + 0.05) / (low + 0.05)


def test_no_text_draws_with_characters():
    drawn = [
        f"{path.relative_to(ROOT)}: {block}"
        for path, text in texts()
        for block in FENCE.findall(text)
        if DRAWN.search(block)
    ]
    assert drawn == []


def test_every_drawing_is_used_and_its_alt_text_says_what_it_shows():
    used = [
        ((path.parent / name).resolve(), alt) for path, text in texts() for alt, name in IMAGE.findall(text)
    ]
    assert {path for path, _ in used} >= set(FIGURES)
    assert [path for path, alt in used if not path.is_file() or (path in FIGURES and len(alt) < ALT)] == []


@pytest.mark.parametrize("figure", FIGURES, ids=lambda figure: figure.stem)
def test_a_drawing_can_be_read_in_light_and_dark(figure):
    source = figure.read_text(encoding="utf-8")
    ElementTree.fromstring(source)
    assert len(source) < 6000 and "http" not in source.replace("http://www.w3.org/2000/svg", "")
    (dark,) = DARK.findall(source)
    light = colors(DARK.sub("", source).partition("<style>")[2].partition("</style>")[0])
    for scheme in (light, {name: light.get(name, {}) | value for name, value in colors(dark).items()}):
        grounds = [scheme[name]["fill"] for name in (".ground", ".box", ".bad")]
        for ground in grounds:
            assert [contrast(scheme[name]["fill"], ground) >= 4.5 for name in ("text", ".note")] == [True] * 2
        lines = [scheme[name]["stroke"] for name in (".line", ".box", ".bad")]
        lines += [scheme[name]["fill"] for name in (".head", ".dot", ".mark")]
        assert [contrast(line, grounds[0]) >= 3 for line in lines] == [True] * 6
