"""A moving picture of the robot, as an animated PNG: it plays wherever a PNG is shown, sanitised or not."""

from __future__ import annotations

import bisect
import io
import math

import numpy as np
from PIL import Image, ImageDraw

from sim.recording import Pose, Recording
from sim.view.figure import PATH
from sim.view.scene import NO_ROBOT, scene
from sim.world import RobotModel

SMOOTH = 2  # frames are drawn so many times larger, then scaled down
COLOURS = 32


class MovingPicture(bytes):
    """The bytes of an animated PNG; Jupyter shows it playing."""

    def __repr__(self) -> str:
        return f"<MovingPicture of {len(self) / 1024:.0f} KiB>"  # notebooks keep this text beside the picture

    def _repr_png_(self) -> bytes:
        return bytes(self)


def animate(recording: Recording, *, speed: float = 2.0, frames_per_second: int = 8) -> MovingPicture:
    """The robot's way through its world.

    speed: simulated seconds per second of the picture. frames_per_second: of the picture.
    Raises ValueError for a run without a robot, and for a speed or rate that isn't above 0.
    """
    if not (speed > 0 and frames_per_second > 0):
        raise ValueError("speed and frames_per_second must be above 0")
    stage = _Stage(recording)
    end = recording.path[-1].stamp
    count = max(1, math.ceil(end * frames_per_second / speed))
    frames = [stage.frame(min(end, index * speed / frames_per_second)) for index in range(count + 1)]
    palette = frames[-1].quantize(COLOURS, dither=Image.Dither.NONE)
    small = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    durations = [1000 // frames_per_second] * count + [1500]  # ms; the last frame stays for a while
    buffer = io.BytesIO()
    small[0].save(
        buffer, "PNG", save_all=True, append_images=small[1:], duration=durations, loop=0, optimize=True
    )
    return MovingPicture(buffer.getvalue())


class _Stage:
    """The world drawn once by matplotlib; only robot, trail and clock are drawn again for each frame."""

    def __init__(self, recording: Recording) -> None:
        figure, axes = scene(recording)
        if not recording.path:
            raise ValueError(NO_ROBOT)
        figure.set_dpi(figure.dpi * SMOOTH * 0.75)
        figure.canvas.draw()
        self.background = Image.fromarray(np.asarray(figure.canvas.buffer_rgba())).convert("RGB")
        self.poses = recording.path
        self.stamps = [pose.stamp for pose in self.poses]
        points = axes.transData.transform([(pose.x, pose.y) for pose in self.poses])
        self.pixels = [(float(x), self.background.height - float(y)) for x, y in points]
        edge = axes.transData.transform([(0.0, 0.0), (RobotModel().radius, 0.0)])
        self.radius = float(edge[1][0] - edge[0][0])

    def frame(self, stamp: float) -> Image.Image:
        """The picture at a moment of simulated time, in seconds."""
        index = max(0, bisect.bisect_right(self.stamps, stamp + 1e-9) - 1)
        image = self.background.copy()
        draw = ImageDraw.Draw(image)
        if index:
            draw.line(self.pixels[: index + 1], fill=PATH, width=2 * SMOOTH)
        self._robot(draw, self.pixels[index], self.poses[index])
        draw.text((8 * SMOOTH, 6 * SMOOTH), f"{stamp:.1f} s", fill="black", font_size=12 * SMOOTH)
        return image.resize((image.width // SMOOTH, image.height // SMOOTH), Image.Resampling.BOX)

    def _robot(self, draw: ImageDraw.ImageDraw, centre: tuple[float, float], pose: Pose) -> None:
        (x, y), r = centre, self.radius
        draw.ellipse((x - r, y - r, x + r, y + r), fill="#8fb8dc", outline="black", width=SMOOTH)
        nose = (x + r * math.cos(pose.yaw), y - r * math.sin(pose.yaw))
        draw.line([centre, nose], fill="black", width=2 * SMOOTH)
