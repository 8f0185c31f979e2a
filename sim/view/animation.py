"""A run as an animation: a player for notebooks, or an animated PNG for pages that show no scripts."""

from __future__ import annotations

import io
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from PIL import Image, ImageDraw

from sim.evidence import Pose, Recording
from sim.view.body_tracks import MAX_POSE_GAP, body_tracks, index_at
from sim.view.interactive import player_html
from sim.view.path_data import pack_animation
from sim.view.path_plot import moving_tracks, plot_path, world_figure
from sim.view.plot import KINDS, PATH, TURTLES, note_failure, small_png
from sim.view.strokes import hexadecimal
from sim.world import Body
from sim.world.obstacles import placed

SMOOTH = 2  # antialiasing: frames are drawn larger by this factor, then scaled down
COLORS = 32
SAMPLES = 6  # frames from which the palette is made if the drawing changes


class MovingPicture:
    """An animation for Jupyter: a player that plays by itself; `bytes(picture)` is an animated PNG."""

    def __init__(self, recording: Recording, speed: float, frames_per_second: int) -> None:
        self._recording, self._speed, self._rate = recording, speed, frames_per_second

    def __repr__(self) -> str:
        return f"<MovingPicture of {self._recording.stamp:g} s>"  # stored in notebooks next to the picture

    @property
    def html(self) -> str:
        """The player as HTML, for use in other pages."""
        return self._html(shared=False)

    def _html(self, *, shared: bool) -> str:
        recording, world = self._recording, self._recording.world
        assert world is not None  # what moves is in it
        failure = f"; {recording.failure}" if recording.failure else ""
        description = f"The run in the world {world.name}, {recording.stamp:g} s{failure}"
        data = pack_animation(recording, self._speed)
        return player_html(data, small_png(plot_path(recording)), description, shared=shared)

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, str]:
        return {"text/html": self._html(shared=True), "text/plain": repr(self)}

    def __bytes__(self) -> bytes:
        renderer, speed, rate = _FrameRenderer(self._recording), self._speed, self._rate
        count = max(1, math.ceil(renderer.end * rate / speed))
        frames = [renderer.frame(min(renderer.end, index * speed / rate)) for index in range(count + 1)]
        whole = frames[-1] if renderer.drawing is None else _sheet(frames[:: max(count // SAMPLES, 1)])
        palette = whole.quantize(COLORS, dither=Image.Dither.NONE)
        small = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
        durations = [1000 // rate] * count + [1500]  # ms; the last frame is shown longer
        more = {"append_images": small[1:], "duration": durations, "loop": 0}
        buffer = io.BytesIO()
        small[0].save(buffer, "PNG", save_all=True, optimize=True, **more)
        return buffer.getvalue()


def animate(recording: Recording, *, speed: float = 2.0, frames_per_second: int = 8) -> MovingPicture:
    """An animation of a run's bodies and the robots' paths.

    It plays when it comes into sight, unless the reader's system asks for reduced motion.
    speed: simulated seconds per second of the animation. frames_per_second: of the animated PNG.
    Raises ValueError for a run in which nothing moves, and for a speed or rate that isn't above 0.
    """
    if not (speed > 0 and frames_per_second > 0):
        raise ValueError("speed and frames_per_second must be above 0")
    moving_tracks(recording)
    return MovingPicture(recording, speed, frames_per_second)


def _sheet(frames: Sequence[Image.Image]) -> Image.Image:
    """One image with all frames, one below the other."""
    width, height = frames[0].size
    sheet = Image.new("RGB", (width, height * len(frames)))
    for index, frame in enumerate(frames):
        sheet.paste(frame, (0, height * index))
    return sheet


class _FrameRenderer:
    """Draws the world once with matplotlib, and bodies, trails and clock for each frame."""

    def __init__(self, recording: Recording) -> None:
        figure, self.axes = world_figure(recording)
        note_failure(figure, recording)
        figure.set_dpi(figure.dpi * SMOOTH * 0.75)
        figure.canvas.draw()
        self.background = Image.fromarray(np.asarray(figure.canvas.buffer_rgba())).convert("RGB")  # type: ignore[attr-defined]
        self.scale = float(np.ptp(self.axes.transData.transform([(0.0, 0.0), (1.0, 0.0)])[:, 0]))
        self.bodies, self.drawing = recording.bodies, recording.drawing
        self.tracks = body_tracks(recording)
        self.trails = [self._pixels([pose[1:3] for pose in track]) for track in self.tracks]
        self.end = max(track[-1].stamp for track in self.tracks)

    def _pixels(self, points: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
        height = self.background.height
        return [(float(x), height - float(y)) for x, y in self.axes.transData.transform(points)]

    def frame(self, stamp: float) -> Image.Image:
        """The picture at a simulated time, in seconds."""
        image = self.background.copy()
        draw = ImageDraw.Draw(image)
        for stroke, points in self.drawing.at(stamp) if self.drawing is not None else ():
            width = max(round(stroke.width * self.scale), 1)
            draw.line(self._pixels(points), fill=hexadecimal(stroke.color), width=width)
        for body, track, trail in zip(self.bodies, self.tracks, self.trails, strict=True):
            index = index_at(track, stamp)
            if abs(track[index].stamp - stamp) > MAX_POSE_GAP and body.kind == "turtle":
                continue
            if index and body.kind == "robot":
                draw.line(trail[: index + 1], fill=PATH, width=2 * SMOOTH)
            self._draw(draw, body, trail[index], track[index])
        draw.text((8 * SMOOTH, 6 * SMOOTH), f"{stamp:.1f} s", fill="black", font_size=12 * SMOOTH)
        return image.reduce(SMOOTH)

    def _draw(self, draw: ImageDraw.ImageDraw, body: Body, center: tuple[float, float], pose: Pose) -> None:
        fill = KINDS.get(body.kind, "#8fb8dc")
        if body.kind == "turtle":
            fill = TURTLES[self.bodies.index(body) % len(TURTLES)]
        if body.outline:
            corners = self._pixels(placed(body.outline, *pose[1:]))
            draw.polygon(corners, fill=fill, outline="black", width=SMOOTH)
            return
        (x, y), r = center, body.radius * self.scale
        draw.ellipse((x - r, y - r, x + r, y + r), fill=fill, outline="black", width=SMOOTH)
        nose = (x + r * math.cos(pose.yaw), y - r * math.sin(pose.yaw))
        draw.line([center, nose], fill="black", width=2 * SMOOTH)
