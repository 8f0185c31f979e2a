"""Writes RULES.md, the page of all rules: python -m tests.rules.page"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from tests.rules.table import CATEGORIES, LESSONS, TABLES, Rule, table_of, users

PAGE = TABLES / "RULES.md"
HEAD = """# What the lessons teach, and what looks for it

Written by `python -m tests.rules.page` from the tables beside it. Each rule that a lesson states has a row:
the cells that state it, the check that looks for it, wrong nodes of the score page that lose points
at this check, and right nodes that keep the rule and earn everything; or the reason why nothing looks for it.
"""


def render() -> str:
    """The page, as Markdown."""
    parts = [HEAD, "\n".join(_totals()), "Why a rule has no check:\n", "\n".join(_reasons())]
    return "\n".join([*parts, *(f"\n{_lesson(lesson)}" for lesson in LESSONS)]) + "\n"


def _totals() -> Iterator[str]:
    yield _row("lesson", "rules", "checked", *CATEGORIES)
    yield _row(*["--"] * (3 + len(CATEGORIES)))
    total: Counter[str] = Counter()
    for lesson in LESSONS:
        count = Counter(rule.category for rule in table_of(lesson).rules)
        yield _counts(lesson, count)
        total += count
    yield _counts("all", total) + "\n"


def _counts(name: str, count: Counter[str]) -> str:
    numbers = [count.total(), count[""], *(count[category] for category in CATEGORIES)]
    return _row(name, *(str(number) if number else "" for number in numbers))


def _reasons() -> Iterator[str]:
    yield from (f"- **{category}**: it {meaning}." for category, meaning in CATEGORIES.items())


def _lesson(lesson: str) -> str:
    lines = [f"## {lesson}\n", _row("rule", "cells", "check", "wrong", "right"), _row(*["--"] * 5)]
    lines += [_rule(rule) for rule in table_of(lesson).rules if not rule.unchecked]
    lines += ["", _row("rule without a check", "cells", "why"), _row(*["--"] * 3)]
    for rule in table_of(lesson).rules:
        if rule.unchecked:
            lines.append(_row(rule.rule, _cells(rule), _why_unchecked(rule)))
    return "\n".join(lines)


def _why_unchecked(rule: Rule) -> str:
    why = f"{rule.category}: {rule.reason}" if rule.reason else rule.category
    used_by = ", ".join(users(rule.technique)[:2]) if rule.technique else ""
    return f"{why}. Right nodes that keep it: {used_by}" if used_by else why


def _rule(rule: Rule) -> str:
    return _row(rule.rule, _cells(rule), rule.check, ", ".join(rule.wrong), ", ".join(rule.right))


def _cells(rule: Rule) -> str:
    return ", ".join(dict.fromkeys(cell for cell, _ in rule.quotes))


def _row(*cells: str) -> str:
    return f"| {' | '.join(cell.replace('|', '&#124;') for cell in cells)} |"


if __name__ == "__main__":
    PAGE.write_text(render(), encoding="utf-8")
