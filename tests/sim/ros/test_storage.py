"""Worlds in saved recordings: each comes back equal, and one that cannot be is refused."""

import json
from io import BytesIO

import pytest
from mcap.reader import make_reader
from mcap.writer import Writer

from sim import Recording, World
from sim.evidence.storage import ATTACHMENT, StorageError


@pytest.mark.parametrize("name", World.names())
def test_every_world_comes_back_from_a_saved_recording(tmp_path, name):
    world = World.load(name)
    assert Recording.load(Recording(world=world).save(tmp_path / "run.mcap")).world == world


def changed(path, **changes):
    """A saved recording whose world holds other values."""
    saved = Recording(world=World.load("room")).save(path)
    (attachment,) = make_reader(BytesIO(saved.read_bytes())).iter_attachments()
    data = json.loads(attachment.data)
    data["world"] |= changes
    with path.open("wb") as file:
        writer = Writer(file)
        writer.start()
        writer.add_attachment(0, 0, ATTACHMENT, "application/json", json.dumps(data).encode())
        writer.finish()
    return path


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"lidar": {"rays": 10**9}}, "lidar.rays is 1000000000; write a whole number from 1 to 10000."),
        ({"robot": 3}, "robot is 3; write a [robot] table with any of radius, mass, "),
        ({"bounds": [0, 0]}, "bounds is [0, 0]; write [xmin, ymin, xmax, ymax] (meters) with "),
        ({"walls": [[[0, 0]]]}, "walls[0] is [[0, 0]]; write two or more corners [x, y] (meters), "),
        ({"name": ["room"]}, "name is ['room']; write a text."),
        ({"os": "system"}, "os is not a known key; the keys are bounds, start, "),
    ],
)
def test_a_world_that_cannot_be_is_refused(tmp_path, changes, sentence):
    path = changed(tmp_path / "run.mcap", **changes)
    with pytest.raises(StorageError) as caught:
        Recording.load(path)
    assert str(caught.value).startswith(
        f"{path} contains a world that is not possible: the world: {sentence}"
    )
