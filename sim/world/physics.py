"""Adds a world's obstacles, movable boxes and people to a pymunk space."""

from __future__ import annotations

import pymunk

from sim.world.obstacles import MovableBox, placed, ring
from sim.world.people import WalkingPerson
from sim.world.robot import Pose, wrap
from sim.world.validated_model import WorldError
from sim.world.world import World

_FRICTION = 0.5
# Overlap (m) of bodies in contact that the solver tolerates; pymunk's default, 0.1, is meant for pixels.
_COLLISION_SLOP = 1e-3
# The fraction of any deeper overlap that remains after a second: all of it is removed in the next step.
_COLLISION_BIAS = 0


class PushedBox:
    """A movable box in the physics, with friction between box and floor."""

    def __init__(self, space: pymunk.Space, box: MovableBox) -> None:
        self._space, self._outline = space, box.outline()
        self.body = pymunk.Body(box.mass, pymunk.moment_for_box(box.mass, (box.width, box.height)))
        self.body.position, self.body.angle = (box.x, box.y), box.yaw
        self.shape = pymunk.Poly(self.body, self._outline)
        self.shape.friction = _FRICTION
        space.add(self.body, self.shape)
        ground = space.static_body
        pivot = pymunk.PivotJoint(ground, self.body, (box.x, box.y), (0, 0))
        gear = pymunk.GearJoint(ground, self.body, 0, 1)
        pivot.max_force, gear.max_force = box.max_friction_force, box.max_friction_torque
        for joint in (pivot, gear):
            # Joints of finite force without position correction: they slow the box and don't pull it back.
            joint.max_bias = 0
            space.add(joint)

    @property
    def pose(self) -> Pose:
        """Its pose: x, y (m) and yaw (rad, in (-pi, pi]) in the map frame."""
        x, y = self.body.position
        return x, y, wrap(self.body.angle)

    def place(self, x: float, y: float) -> bool:
        """Put it at (x, y), at rest; where something else is, leave it and return False."""
        body, before = self.body, self.body.position
        body.position = x, y
        self._space.reindex_shapes_for_body(body)
        if self._space.shape_query(self.shape):
            body.position = before
            self._space.reindex_shapes_for_body(body)
            return False
        body.velocity, body.angular_velocity = (0.0, 0.0), 0.0
        return True

    def sides(self) -> list[tuple[float, float, float, float]]:
        """Its four sides in the map frame, each (x0, y0, x1, y1)."""
        corners = placed(self._outline, *self.body.position, self.body.angle)
        return [(*start, *end) for start, end in ring(corners)]


def make_space() -> pymunk.Space:
    """An empty space, seen from above: without gravity."""
    space = pymunk.Space()
    space.collision_slop = _COLLISION_SLOP
    space.collision_bias = _COLLISION_BIAS
    return space


def add_obstacles(space: pymunk.Space, world: World) -> dict[pymunk.Shape, str]:
    """Add static obstacles in the order of the world's file, because the order changes the solver's rounding.

    Returns the kind of each shape: wall, box or circle.
    """
    ground = space.static_body
    shapes: dict[pymunk.Shape, str] = {}
    shapes |= {pymunk.Segment(ground, start, end, 0): "wall" for start, end in world.walls}
    shapes |= {pymunk.Poly(ground, box.corners()): "box" for box in world.boxes}
    shapes |= {
        pymunk.Circle(ground, circle.radius, (circle.x, circle.y)): "circle" for circle in world.circles
    }
    for shape in shapes:
        shape.friction = _FRICTION
        space.add(shape)
    return shapes


def add_boxes(space: pymunk.Space, world: World, names: dict[pymunk.Shape, str]) -> list[PushedBox]:
    """Add the boxes that can be pushed, in the order of the world's file, and their shapes to `names`.

    Raises:
        WorldError: one of them is inside something.
    """
    boxes = []
    for number, box in enumerate(world.movable, start=1):
        boxes.append(added := PushedBox(space, box))
        for hit in space.shape_query(added.shape):
            # pymunk's sign of a depth depends on the kinds of the two shapes.
            depth = max(abs(point.distance) for point in hit.contact_point_set.points)
            if hit.shape in names and depth > _COLLISION_SLOP:
                raise WorldError(
                    f"World {world.name!r}: box_{number} does not fit at ({box.x:g}, {box.y:g}), "
                    f"where a {names[hit.shape]} is; move one of the two."
                )
        names[added.shape] = "box"
    return boxes


def add_people(space: pymunk.Space, world: World, names: dict[pymunk.Shape, str]) -> list[WalkingPerson]:
    """Add the people in the order of the world's file, and their shapes to `names`."""
    walkers = [WalkingPerson(space, person) for person in world.people]
    for walker in walkers:
        walker.shape.friction = _FRICTION
        names[walker.shape] = "person"
    return walkers


def check_start(space: pymunk.Space, world: World, name: str, names: dict[pymunk.Shape, str]) -> None:
    """Raise WorldError if a robot, which is not in the space yet, overlaps something at its start."""
    x, y, _ = world.starts()[name]
    hit = space.point_query_nearest((x, y), world.robot.radius, pymunk.ShapeFilter())
    if hit:
        what = names[hit.shape]
        who = "the robot" if name == "robot" else name
        raise WorldError(
            f"World {world.name!r}: {who} (radius {world.robot.radius:g} m) does not fit at the start "
            f"({x:g}, {y:g}), where a {what} is; move the start or the {what}."
        )
