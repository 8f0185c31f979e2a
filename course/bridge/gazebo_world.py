"""Writes a world of the course as a world of Gazebo: walls, boxes and round pillars, without what moves."""

import math
from xml.etree import ElementTree

from sim import World

THICKNESS, HEIGHT = 0.02, 0.5  # m
SYSTEMS = {
    "gz-sim-physics-system": "gz::sim::systems::Physics",
    "gz-sim-user-commands-system": "gz::sim::systems::UserCommands",
    "gz-sim-scene-broadcaster-system": "gz::sim::systems::SceneBroadcaster",
    "gz-sim-sensors-system": "gz::sim::systems::Sensors",
}


def to_sdf(world: World) -> str:
    """The text of an SDF file."""
    root = ElementTree.Element("sdf", version="1.9")
    place = ElementTree.SubElement(root, "world", name=world.name)
    physics = ElementTree.SubElement(place, "physics", name="1ms", type="ignored")
    _texts(physics, max_step_size="0.001", real_time_factor="1")
    for file, system in SYSTEMS.items():
        plugin = ElementTree.SubElement(place, "plugin", filename=file, name=system)
        if system.endswith("Sensors"):
            _texts(plugin, render_engine="ogre2")
    _light(place)
    _add(place, "floor", "0 0 0 0 0 0", "plane", normal="0 0 1", size="100 100")
    for number, ((x0, y0), (x1, y1)) in enumerate(world.walls, 1):
        length, yaw = math.dist((x0, y0), (x1, y1)), math.atan2(y1 - y0, x1 - x0)
        pose = f"{(x0 + x1) / 2:g} {(y0 + y1) / 2:g} {HEIGHT / 2} 0 0 {yaw:.5g}"
        _add(place, f"wall_{number}", pose, "box", size=f"{length:g} {THICKNESS} {HEIGHT}")
    for number, box in enumerate(world.boxes, 1):
        pose = f"{box.x:g} {box.y:g} {HEIGHT / 2} 0 0 {box.yaw:.5g}"
        _add(place, f"box_{number}", pose, "box", size=f"{box.width:g} {box.height:g} {HEIGHT}")
    for number, circle in enumerate(world.circles, 1):
        pose = f"{circle.x:g} {circle.y:g} {HEIGHT / 2} 0 0 0"
        _add(place, f"pillar_{number}", pose, "cylinder", radius=f"{circle.radius:g}", length=str(HEIGHT))
    ElementTree.indent(root)
    return '<?xml version="1.0"?>\n' + ElementTree.tostring(root, encoding="unicode") + "\n"


def _light(world: ElementTree.Element) -> None:
    light = ElementTree.SubElement(world, "light", name="sun", type="directional")
    _texts(light, pose="0 0 10 0 0 0", direction="-0.5 0.1 -0.9")


def _add(world: ElementTree.Element, name: str, pose: str, kind: str, **shape: str) -> None:
    """Add a model that cannot move, with one link, which is seen and can be hit."""
    model = ElementTree.SubElement(world, "model", name=name)
    _texts(model, static="true", pose=pose)
    link = ElementTree.SubElement(model, "link", name="link")
    for part in ("collision", "visual"):
        geometry = ElementTree.SubElement(ElementTree.SubElement(link, part, name=part), "geometry")
        _texts(ElementTree.SubElement(geometry, kind), **shape)


def _texts(parent: ElementTree.Element, **texts: str) -> None:
    for name, text in texts.items():
        ElementTree.SubElement(parent, name).text = text
