"""How far a robot's odometry may be off, since something has touched the robot."""

from sim.world.robot import DT

TURNED = 0.05  # rad; measured: in 12 drives of 60 s with 1 to 28 contacts the yaw was off by up to 0.07 rad


class OdometryError:
    """An estimate of the error: 0 until something touches the robot, because its wheels never slip otherwise.

    While something touches it, all that the wheels roll may be lost, and the heading may change a little.
    From then on each step may go aside.

    Attributes:
        place: of the position, m.
        turn: of the yaw, rad.
        speed, rate: of the velocity (m/s) and the yaw rate (rad/s): all that the wheels roll at this moment.
    """

    def __init__(self) -> None:
        self.place = self.turn = self.speed = self.rate = 0.0

    def update(self, v: float, w: float, is_touched: bool) -> None:
        """Add a step of the physics, with the velocity (m/s) and yaw rate (rad/s) of the wheels."""
        self.speed, self.rate = (abs(v), abs(w)) if is_touched else (0.0, 0.0)
        if is_touched:
            self.turn = TURNED
            self.place += abs(v) * DT
        self.place += self.turn * abs(v) * DT
