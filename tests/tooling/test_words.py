"""`make lint` rejects British spelling and the words of .ci/words.txt, in prose and in names."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
CODESPELL = Path(sys.executable).with_name("codespell")
DICTIONARIES = ("--dictionary", "-", "--dictionary", ".ci/words.txt")
WORDS = [line.split("->") for line in (ROOT / ".ci/words.txt").read_text(encoding="utf-8").splitlines()]


def found(path: Path, text: str) -> list[str]:
    """What codespell says of a file with this text, without its place."""
    path.write_text(text, encoding="utf-8")
    checked = subprocess.run([CODESPELL, *DICTIONARIES, path], cwd=ROOT, capture_output=True, text=True)
    assert checked.stderr == ""
    return [line.split(": ", 1)[1] for line in checked.stdout.splitlines()]


@pytest.mark.parametrize("name", ["page.md", "node.py", "lesson.ipynb", "view.js"])
def test_every_word_is_found_with_what_to_write(tmp_path, name):
    expected = [f"{word} ==> {instead.strip().rstrip(',')}" for word, instead in WORDS]
    assert found(tmp_path / name, "\n".join(f"a {word}." for word, _ in WORDS)) == expected


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("The colour of the wall", "colour ==> color"),
        ("last_heard = 0.0", "heard ==> received"),
        ("class HearsNothing:", "Hears ==> Receives, Subscribes to"),
        ("It waits for ever.", "for ever ==> forever"),
    ],
)
def test_a_word_is_found_in_names_and_sentences(tmp_path, text, words):
    assert found(tmp_path / "a.py", text) == [words]


@pytest.mark.parametrize(
    "text",
    [
        "Real wheels slip.",
        'self.get_logger().info(f"I heard: {msg.data}")',
        "if future.cancelled(): ...",
        "It is for everybody.",
        "To tell a wall from a box.",
        "the heart of the robot, its hardware, thirteen hours",
    ],
)
def test_allowed_uses_are_left_alone(tmp_path, text):
    assert found(tmp_path / "a.md", text) == []
