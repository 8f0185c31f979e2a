"""Delta debugging: the fewest departures with which a run still fails.

The method is ddmin of Zeller and Hildebrandt, "Simplifying and isolating failure-inducing input" (2002).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence


def shrink(ids: Sequence[str], fails: Callable[[list[str]], bool]) -> Iterator[list[str]]:
    """Yield ever shorter lists of these ids with which it fails; none can be left out of the last.

    fails: whether it fails with these departures alone.
    """
    current, parts = list(dict.fromkeys(ids)), 2
    while len(current) > 1:
        size = -(-len(current) // parts)
        chunks = [current[start : start + size] for start in range(0, len(current), size)]
        smaller = next(filter(fails, _candidates(chunks, parts)), None)
        if smaller is not None:
            parts = 2 if smaller in chunks else max(parts - 1, 2)
            current = smaller
            yield current
        elif parts >= len(current):
            return
        else:
            parts = min(2 * parts, len(current))


def _candidates(chunks: list[list[str]], parts: int) -> Iterator[list[str]]:
    """Each chunk alone, then all but each chunk."""
    yield from chunks
    if parts > 2:
        for left_out in chunks:
            yield [item for chunk in chunks if chunk is not left_out for item in chunk]
