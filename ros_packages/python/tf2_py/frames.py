"""The tree of frames."""

import itertools

from tf2_py.cache import FrameCache, Nanoseconds, StoredTransform
from tf2_py.errors import LookupException, TransformException
from tf2_py.formatting import connectivity_error
from tf2_py.rigid_transform import IDENTITY, RigidTransform

MAX_GRAPH_DEPTH = 1000  # a longer path to the root contains a loop


class Frames(dict[str, FrameCache | None]):
    """The cache of each frame by its name; None for a root, which has no transforms."""

    def walk_up(
        self, frame: str, ends: tuple[str, ...], time: Nanoseconds
    ) -> tuple[str, list[StoredTransform], TransformException | None]:
        """Walk from a frame towards the root, until a frame in `ends`.

        Returns the last frame, the transforms on the path, and the error that stopped the walk.
        """
        path: list[StoredTransform] = []
        while frame not in ends and (cache := self[frame]) is not None:
            try:
                path.append(cache.lookup(time))
            except TransformException as error:
                return frame, path, error
            frame = path[-1].parent
            if len(path) > MAX_GRAPH_DEPTH:
                raise self._loop_error()
        return frame, path, None

    def latest_common_time(self, target: str, source: str) -> Nanoseconds:
        """The latest time at which all transforms between two frames are available; 0 if all are static."""
        above_source, above_target = self._latest_stamps(source), self._latest_stamps(target)
        common_parent = next((name for name in above_target if name in above_source), None)
        if common_parent is None:
            raise connectivity_error(target, source)
        stamps: list[Nanoseconds] = []
        for path in (above_source, above_target):
            stamps += filter(None, itertools.islice(path.values(), list(path).index(common_parent)))
        return min(stamps, default=0)

    def _latest_stamps(self, frame: str) -> dict[str, Nanoseconds]:
        """The latest stamp of each frame from this one to the root."""
        found: dict[str, Nanoseconds] = {}
        while True:
            cache = self[frame]
            latest = cache.latest if cache is not None else None
            if frame in found:
                raise self._loop_error()
            found[frame] = latest.stamp if latest is not None else 0
            if latest is None:
                return found
            frame = latest.parent

    def _loop_error(self) -> LookupException:
        frames = self.as_string()
        return LookupException(f"The tf tree is invalid because it contains a loop.\n{frames}\n")

    def as_string(self) -> str:
        """Each frame and its parent, one per line."""
        return "".join(
            f"Frame {name} exists with parent {cache.latest.parent if cache.latest else 'NO_PARENT'}.\n"
            for name, cache in self.items()
            if cache is not None
        )


def compose(path: list[StoredTransform]) -> RigidTransform:
    """The composition of the transforms on a path."""
    if not path:
        return IDENTITY
    transform = path[0].transform
    for step in path[1:]:
        transform = step.transform.after(transform)
    return transform
