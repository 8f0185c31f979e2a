"""Values for CSV files that people open in spreadsheets."""
from grader.marking.progress_line import printable

RUNS = ("=", "+", "-", "@", "\t", "\r")  # a spreadsheet takes text that begins so for a formula


def inert(value: object) -> object:
    """The value without control characters, and quoted where a spreadsheet would take it for a formula."""
    if not isinstance(value, str):
        return value
    return f"'{printable(value)}" if value.startswith(RUNS) else printable(value)
