"""Variants of an exercise: numbers and names that are drawn for each student of a class.

Without variants, as the course is delivered, every exercise has the values of its first rows.
"""

from __future__ import annotations

import contextlib
import copy
import hashlib
import hmac
import json
import re
from collections.abc import Iterator, Mapping, Sequence
from contextvars import ContextVar
from dataclasses import dataclass, replace
from types import MappingProxyType, SimpleNamespace
from typing import TYPE_CHECKING, Any, Self

from grader.seeds import REVEALED

if TYPE_CHECKING:
    from grader.checks.check import Check, Hints

Column = Sequence[Any]  # of values: the first is that of the course


class Variants:
    """The variants of an exercise, and where the values are in its texts.

        Variants(
            {"period": (0.5, 0.25, 0.2), "often": ("twice", "four times", "five times")},
            {"word": ("Count", "Step")},
            texts=("every {period:g} s", "create_timer({period:g}, ", "{often} a second", "`{word}: 1`"),
        )

    has six variants: a row of the first table is drawn, and, independent of it, a row of the second one.

    texts: phrases of the exercise's section in the notebook, with or without its answer, and of the sentences
    and hints of its checks. Wherever the phrase with the first row's values is, other values replace them.
    elsewhere: phrases of the other cells of the notebook.

    Raises ValueError for tables that can't work.
    """

    def __init__(
        self, *tables: Mapping[str, Column], texts: Sequence[str], elsewhere: Sequence[str] = ()
    ) -> None:
        names = [name for table in tables for name in table]
        if repeated := {name for name in names if names.count(name) > 1}:
            raise ValueError(f"two tables of variants have a column {repeated.pop()!r}")
        for table in tables:
            rows = {len(column) for column in table.values()}
            if len(rows) != 1 or rows <= {0, 1}:
                raise ValueError(f"the columns {', '.join(table)} need the same number of rows, at least two")
        self._tables, self._texts, self._elsewhere = tables, tuple(texts), tuple(elsewhere)
        for phrases in (self._texts, self._elsewhere):
            begin = [_filled(phrase, self.values(0)) for phrase in phrases]
            if repeated := {phrase for phrase in begin if begin.count(phrase) > 1}:
                raise ValueError(f"two phrases of variants are {repeated.pop()!r} in the first one")

    @property
    def count(self) -> int:
        """Return how many there are."""
        number = 1
        for table in self._tables:
            number *= _rows(table)
        return number

    def values(self, number: int) -> dict[str, Any]:
        """Return the values of a variant by column. Raises ValueError for a number that none has."""
        if not 0 <= number < self.count:
            raise ValueError(f"there are {self.count} variants, 0 to {self.count - 1}, and no {number}")
        found: dict[str, Any] = {}
        for table in self._tables:
            number, row = divmod(number, _rows(table))
            found |= {name: column[row] for name, column in table.items()}
        return found

    def describe(self, number: int) -> str:
        """Return the values of a variant in words: of each table the first column, which decides."""
        values = self.values(number)
        return ", ".join(f"{name} {values[name]}" for name in (next(iter(table)) for table in self._tables))

    def phrases(self, number: int) -> dict[str, str]:
        """Return what replaces the phrases in the exercise's section and in its checks' sentences."""
        return self._replacements(self._texts, number)

    def phrases_elsewhere(self, number: int) -> dict[str, str]:
        """Return what replaces the phrases in the rest of the notebook."""
        return self._replacements(self._elsewhere, number)

    def _replacements(self, phrases: Sequence[str], number: int) -> dict[str, str]:
        first, drawn = self.values(0), self.values(number)
        return {_filled(phrase, first): _filled(phrase, drawn) for phrase in phrases}


def with_phrases(text: str, phrases: Mapping[str, str]) -> str:
    """Replace phrases of a text, all at once, where they aren't parts of longer words and numbers."""
    longest_first = sorted(phrases, key=len, reverse=True)
    pattern = "|".join(map(_whole, longest_first))
    return re.sub(pattern, lambda found: phrases[found[0]], text) if phrases else text


def drawn_number(secret: str, exercise: str, count: int) -> int:
    """The number of a student's variant, from the student's secret; see `seeds.secret_of_student`."""
    name = revealed_name(exercise)
    if secret.startswith(REVEALED):
        return int(json.loads(secret.removeprefix("seeds "))[name][0])
    digest = hmac.new(secret.encode(), name.encode(), hashlib.sha256).digest()
    return int.from_bytes(digest[:8], "big") % count


def revealed_name(exercise: str) -> str:
    """The name of an exercise's variant among the seeds of a receipt."""
    return f"variant of {exercise}"


@dataclass(eq=False, kw_only=True)
class Varied:
    """An exercise that may have variants.

    variants: of the exercise; None if there are none. number: of the variant that this object judges.
    """

    variants: Variants | None = None
    number: int = 0

    @property
    def drawn(self) -> SimpleNamespace:
        """Return the values of the variant that is being judged, for its checks; or else of this one.

        Raises ValueError for an exercise without variants.
        """
        return SimpleNamespace(**self._known.values(_judged.get().get(self._name, self.number)))

    @property
    def _name(self) -> str:
        return str(vars(self)["name"])

    @property
    def _known(self) -> Variants:
        if self.variants is None:
            raise ValueError(f"exercise {self._name} has no variants")
        return self.variants

    def variant(self, number: int) -> Self:
        """Return the exercise that judges this variant, with its sentences.

        Raises ValueError for an exercise without variants, and for a number that none has.
        """
        phrases = self._known.phrases(number)
        checks: dict[str, Check] = {}
        for item in vars(self)["checks"]:
            after = tuple(checks[before.name] for before in item.after)
            checks[item.name] = replace(_with_texts(item, phrases), after=after)
        made = copy.copy(self)
        vars(made).update(number=number, checks=list(checks.values()))
        return made

    @contextlib.contextmanager
    def in_use(self) -> Iterator[None]:
        """Set `drawn`, also for its checks, to the values of this object's variant while the block runs."""
        token = _judged.set({**_judged.get(), self._name: self.number})
        try:
            yield
        finally:
            _judged.reset(token)


_judged: ContextVar[Mapping[str, int]] = ContextVar("variants being judged", default=MappingProxyType({}))


def _with_texts(item: Check, phrases: Mapping[str, str]) -> Check:
    """The check with its sentence, guess and hints in a variant."""
    guess = item.guess
    return replace(
        item,
        sentence=with_phrases(item.sentence, phrases),
        guess=with_phrases(guess, phrases) if isinstance(guess, str) else _table(guess, phrases),
        hints=_table(item.hints, phrases),
    )


def _table(table: Hints, phrases: Mapping[str, str]) -> Hints:
    return {with_phrases(sentence, phrases): cause for sentence, cause in table.items()}


def _rows(table: Mapping[str, Column]) -> int:
    return len(next(iter(table.values())))


def _filled(phrase: str, values: Mapping[str, Any]) -> str:
    return phrase.format(**values)


def _whole(phrase: str) -> str:
    before = r"(?<![\w.])" if phrase[:1].isdigit() else r"(?<!\w)" if phrase[:1].isalpha() else ""
    after = r"(?!\w)" if phrase[-1:].isalnum() else ""
    return f"{before}{re.escape(phrase)}{after}"
