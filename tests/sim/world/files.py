"""World files of a test's own."""

from sim.world import World

HEADINGS = ["Picture", "Topics", "Frames and units", "Start", "Ends when"]
CARD = "[card]\n" + "\n".join(f'"{heading}" = "text"' for heading in HEADINGS) + "\n"


def load(folder, text):
    """The world that a file mine.toml with this text describes."""
    path = folder / "mine.toml"
    path.write_text(text, encoding="utf-8")
    return World.load(path)
