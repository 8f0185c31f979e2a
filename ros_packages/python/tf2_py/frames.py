"""The frames that are known, and the ways between them."""

import itertools

from tf2_py.cache import Frame, Known, Nanoseconds
from tf2_py.errors import LookupException, TransformException
from tf2_py.rigid import STAY, Motion
from tf2_py.words import unconnected

DEEPEST = 1000  # frames on the way to the root: more of them go round in a circle


class Frames(dict[str, Frame | None]):
    """Each frame by its name; None: a root, of which nothing is known."""

    def climb(
        self, frame: str, ends: tuple[str, ...], time: Nanoseconds
    ) -> tuple[str, list[Known], TransformException | None]:
        """From a frame towards the root: where it ends, all steps, and why it could not go on."""
        steps: list[Known] = []
        while frame not in ends and (cache := self[frame]) is not None:
            try:
                steps.append(cache.at(time))
            except TransformException as broken:
                return frame, steps, broken
            frame = steps[-1].parent
            if len(steps) > DEEPEST:
                raise self._loop()
        return frame, steps, None

    def common_time(self, target: str, source: str) -> Nanoseconds:
        """The newest time for which the whole way is known; 0 if it is all static."""
        above_source, above_target = self._newest(source), self._newest(target)
        meeting = next((name for name in above_target if name in above_source), None)
        if meeting is None:
            raise unconnected(target, source)
        stamps: list[Nanoseconds] = []
        for way in (above_source, above_target):
            stamps += filter(None, itertools.islice(way.values(), list(way).index(meeting)))
        return min(stamps, default=0)

    def _newest(self, frame: str) -> dict[str, Nanoseconds]:
        """The frames from this one to the root, each with its newest stamp."""
        found: dict[str, Nanoseconds] = {}
        while True:
            cache = self[frame]
            known = cache.newest if cache is not None else None
            if frame in found:
                raise self._loop()
            found[frame] = known.stamp if known is not None else 0
            if known is None:
                return found
            frame = known.parent

    def _loop(self) -> LookupException:
        frames = self.words()
        return LookupException(f"The tf tree is invalid because it contains a loop.\n{frames}\n")

    def words(self) -> str:
        """Each frame and its parent, a line for each."""
        return "".join(
            f"Frame {name} exists with parent {frame.newest.parent if frame.newest else 'NO_PARENT'}.\n"
            for name, frame in self.items()
            if frame is not None
        )


def whole(steps: list[Known]) -> Motion:
    """The motion of all these steps, one after the other."""
    if not steps:
        return STAY
    motion = steps[0].motion
    for step in steps[1:]:
        motion = step.motion.after(motion)
    return motion
