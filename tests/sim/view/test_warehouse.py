"""A warehouse in pictures: places have their names, and people their color."""

import io

import pytest
from PIL import Image

from sim import World, run
from sim.view import animate, plot_path
from sim.view.plot import KINDS
from sim.view.world_data import world_data


@pytest.fixture(scope="module")
def recording():
    return run(world="warehouse", seconds=1.0)


def test_pages_get_the_places_of_a_warehouse_and_of_no_other_world():
    world = World.load("warehouse")
    places = world_data(world)["places"]
    assert list(places) == ["charger", "desk", "shelf_1", "shelf_2", "shelf_3", "shelf_4"]
    assert places["desk"] == list(world.warehouse.desk[:2])
    assert "places" not in world_data(World.load("room"))
    assert [body["kind"] for body in world_data(world)["bodies"]] == ["robot", "box", "box", "person"]


def test_a_figure_has_the_named_locations(recording):
    (axes,) = plot_path(recording).axes
    assert {"charger", "desk", "shelf_4"} <= {text.get_text() for text in axes.texts}


def test_an_animation_shows_walking_people(recording):
    image = Image.open(io.BytesIO(bytes(animate(recording)))).convert("RGB")
    red, green, blue = (int(KINDS["person"][at : at + 2], 16) for at in (1, 3, 5))
    near = [
        count
        for count, (r, g, b) in image.getcolors(1 << 20)
        if abs(r - red) + abs(g - green) + abs(b - blue) < 24
    ]
    assert sum(near) > 40
