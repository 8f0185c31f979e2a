"""Moments for people, in the time of the machine on which they are read."""
from datetime import UTC, datetime


def format_local(moment: datetime) -> str:
    """A moment (UTC, without a zone) as in "Tue 1 December 2026, 18:00 CET"."""
    found = moment.replace(tzinfo=UTC).astimezone()
    return f"{found:%a} {found.day} {found:%B %Y, %H:%M %Z}"


def local_zone() -> str:
    """The name of this machine's time zone now, such as CET."""
    return f"{datetime.now().astimezone():%Z}"
