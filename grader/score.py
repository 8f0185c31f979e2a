"""The outcome of an exercise: a float for nbgrader, a table for people."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict
from functools import cached_property
from typing import Any

from grader import page
from grader.checks.verdicts import Verdict, halves
from grader.orders import OrderDifference
from grader.stderr_redirect import redirect_stderr
from sim.evidence import Recording

UNSAFE = 0.4  # of all points: the most that is earned with a robot that is unsafe


class Score(float):
    """Points between 0 and `max`; shows itself in Jupyter as a table, in a terminal as `text`.

    nbgrader reads the points from `repr`, which is always a plain finite number between 0 and `max`.

    max: the points that can be reached.
    verdicts: one per check, and one for an error of the student's, if any.
    capped: more was earned than `UNSAFE` allows, for a robot that is unsafe.
    recordings: what the verdicts speak of; `Verdict.run` is an index into it.
    differences: for each run that misses points in another order alone.
    """

    exercise: str
    title: str
    max: float
    verdicts: tuple[Verdict, ...]
    recordings: tuple[Recording, ...]
    differences: tuple[OrderDifference, ...]
    capped: bool

    def __new__(
        cls,
        exercise: str,
        verdicts: Iterable[Verdict],
        recordings: Sequence[Recording] = (),
        *,
        title: str = "",
        differences: Sequence[OrderDifference] = (),
    ) -> Score:
        """Add up the verdicts. `exercise` is its name."""
        verdicts = tuple(verdicts)
        most = _rounded_down(math.fsum(verdict.points for verdict in verdicts))
        earned = _rounded_down(math.fsum(verdict.earned for verdict in verdicts))
        limit = halves(UNSAFE * most) if any(verdict.unsafe for verdict in verdicts) else most
        score = super().__new__(cls, min(max(earned, 0.0), limit))
        score.capped = earned > limit
        score.exercise, score.title, score.max = exercise, title or exercise, most
        score.verdicts, score.recordings = verdicts, tuple(recordings)
        score.differences = tuple(differences)
        return score

    def with_verdicts(self, verdicts: Iterable[Verdict]) -> Score:
        """Return the same score with other verdicts on its recordings."""
        common = self.exercise, verdicts, self.recordings
        return Score(*common, title=self.title, differences=self.differences)

    @property
    def broken(self) -> list[Verdict]:
        """Checks that failed because of a mistake in the course: their `alarm` is for the instructor."""
        return [verdict for verdict in self.verdicts if verdict.status == "broken"]

    @property
    def text(self) -> str:
        """The table for a terminal."""
        return page.text(self.title, float(self), self.max, self.verdicts, self._runs, self._note)

    @property
    def pictures(self) -> list[tuple[str, Any]]:
        """Return pictures that say more than words: pairs of a caption and what Jupyter displays, each once.

        Of a drive it is the replay, so that one sees when it went wrong; it holds a PNG for pages without
        scripts.
        """
        from grader.pictures import score_pictures

        orders = [("Another order of the events", found) for found in self.differences]
        return [*score_pictures(self.verdicts, self.recordings), *orders]

    @cached_property
    def _graph(self) -> tuple[int, str]:
        """Return which verdict the graph of its run explains, and that as HTML."""
        from grader.pictures import graph_of_missed_check

        with redirect_stderr():
            try:
                return graph_of_missed_check(self.verdicts, self.recordings)
            except Exception:  # a picture is an extra: without it the points still have to be shown
                return 0, ""

    @cached_property
    def _replays(self) -> dict[int, str]:
        """The keys of the runs that have a replay, by index."""
        from grader.pictures import replay_keys

        return replay_keys(self.verdicts, self.recordings)

    def as_dict(self) -> dict[str, Any]:
        """Plain data, ready for JSON; without the recordings."""
        verdicts = [{**asdict(verdict), "earned": verdict.earned} for verdict in self.verdicts]
        return {
            "exercise": self.exercise,
            "title": self.title,
            "points": float(self),
            "max": self.max,
            "verdicts": verdicts,
        }

    @property
    def _runs(self) -> list[str]:
        """Return what to call each run; nothing to tell apart where there is only one."""
        count = len(self.recordings)
        return [_run(recording, f"{n} of {count}") for n, recording in enumerate(self.recordings, 1)] * (
            count > 1
        )

    @property
    def _note(self) -> str:
        """Return why it is less than the sum of its lines; "" where it isn't."""
        missed = next((verdict.sentence for verdict in self.verdicts if verdict.unsafe), "")
        most = f"at most {UNSAFE:.0%} of the points"
        return f"Safety comes first: without “{missed.rstrip('.')}” there are {most}." if self.capped else ""

    def __repr__(self) -> str:
        return f"{float(self):.4f}".rstrip("0").rstrip(".")

    __str__ = __repr__

    def _repr_html_(self) -> str:
        shown = self.title, float(self), self.max, self.verdicts, self._runs, self._note
        return page.html(*shown, below=self._graph, replays=self._replays)

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, str]:
        # Each picture is an output of its own: a sanitizer that is strict about HTML lets the table pass.
        _after_cell(self._show_pictures)
        return {"text/plain": repr(self), "text/html": self._repr_html_()}

    def _show_pictures(self) -> None:
        from IPython.display import display

        with redirect_stderr():
            try:
                for caption, picture in self.pictures:
                    display(picture, metadata={"image/png": {"alt": caption}})
            except Exception as error:  # a picture is an extra: without it the points still have to be shown
                print(f"(A picture could not be drawn: {error})")


def _after_cell(show: Callable[[], None]) -> None:
    """Call a function when the cell has shown its result: below that, but still in its output."""
    from IPython import get_ipython

    ipython = get_ipython()
    if ipython is None:
        return show()

    def once() -> None:
        ipython.events.unregister("post_execute", once)
        show()

    ipython.events.register("post_execute", once)


def _run(recording: Recording, count: str) -> str:
    # No seed: when marking it's a private one.
    return f"{count}, world {recording.world.name}" if recording.world else count


def _rounded_down(points: float) -> float:
    """Points with the four decimals that `repr` shows, never more than were earned."""
    return math.floor(points * 1e4 + 1e-3) / 1e4
