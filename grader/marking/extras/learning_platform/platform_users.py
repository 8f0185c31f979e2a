"""Finds the students of the gradebook among the people in a platform's file; nothing is guessed."""
import unicodedata
from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field


@dataclass(frozen=True)
class PlatformUser:
    """Someone in a platform's file. number: the platform's own. ids: user name, mail and the like."""

    name: str
    number: str = ""
    ids: tuple[str, ...] = ()

    @property
    def label(self) -> str:
        """For the instructor: who this is."""
        mails = [each for each in self.ids if "@" in each]
        known = [each for each in (self.number, *(mails or self.ids[:1])) if each]
        return f"{self.name} ({', '.join(known)})" if known else self.name


@dataclass(frozen=True)
class KnownStudent:
    """A student of the class. numbers: of the platform, where they are known."""

    student: str
    first: str = ""
    last: str = ""
    mail: str = ""
    numbers: frozenset[str] = frozenset()


@dataclass
class UserMatches:
    """found: the student of each person, by position. ambiguous: the students that a person may be."""

    found: dict[int, str] = field(default_factory=dict)
    ambiguous: dict[int, list[str]] = field(default_factory=dict)


def match_users(people: Sequence[PlatformUser], students: Iterable[KnownStudent]) -> UserMatches:
    """Match people and students one to one: by number, then by id or mail, then by name.

    A key that two people or two students have decides nothing. Those whom a key identifies are not looked
    for by a weaker one.
    """
    matches, left = UserMatches(), {each.student: each for each in students}
    for level in (_numbers, _ids, _names):
        waiting = [at for at in range(len(people)) if at not in matches.found and at not in matches.ambiguous]
        sides = {student: level(each) for student, each in left.items()}
        holders: dict[str, list[str]] = defaultdict(list)
        for student, keys in sides.items():
            for key in keys:
                holders[key].append(student)
        pairs = {at: sorted({who for key in level(people[at]) for who in holders[key]}) for at in waiting}
        if level is _names:
            pairs = {at: [who for who in them if _agree(people[at], left[who])] for at, them in pairs.items()}
        _decide(pairs, matches)
        left = {who: each for who, each in left.items() if who not in matches.found.values()}
    return matches


def _decide(pairs: dict[int, list[str]], matches: UserMatches) -> None:
    """Enter the pairs of one level: found where both sides have only each other."""
    counts: dict[str, int] = defaultdict(int)
    for students in pairs.values():
        for student in students:
            counts[student] += 1
    for at, students in pairs.items():
        if len(students) == 1 and counts[students[0]] == 1:
            matches.found[at] = students[0]
        elif students:
            matches.ambiguous[at] = students


def plain_name(text: str) -> str:
    """A name for comparison: letters and digits alone, in lower case."""
    folded = unicodedata.normalize("NFC", text).casefold()
    return "".join(letter for letter in folded if letter.isalnum() or unicodedata.combining(letter))


def _key(text: str) -> str:
    return unicodedata.normalize("NFC", text).strip().casefold()


def _numbers(one: PlatformUser | KnownStudent) -> set[str]:
    return ({one.number} if isinstance(one, PlatformUser) else set(one.numbers)) - {""}


def _ids(one: PlatformUser | KnownStudent) -> set[str]:
    ids = one.ids if isinstance(one, PlatformUser) else (one.student, one.mail)
    return {_key(each) for each in ids} - {""}


def _names(one: PlatformUser | KnownStudent) -> set[str]:
    if isinstance(one, PlatformUser):
        return {plain_name(one.name)} - {""}
    orders = (one.first + one.last, one.last + one.first, one.student)
    return {plain_name(name) for name in orders} - {""}


def _agree(person: PlatformUser, student: KnownStudent) -> bool:
    """Return whether nothing says that two with the same name are different people."""
    mails = {_key(each) for each in person.ids if "@" in each}
    own = {_key(each) for each in (student.mail, student.student) if "@" in each}
    return (not mails or not own or bool(mails & own)) and not (
        person.number and student.numbers and person.number not in student.numbers
    )
