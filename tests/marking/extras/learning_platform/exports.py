"""Files as Moodle and Canvas export them, and archives of submissions."""
import csv
import io
import zipfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

ENGLISH = ("Identifier", "Full name", "Email address", "Status", "Grade", "Maximum Grade", "Grade can be changed")
ENGLISH += ("Last modified (submission)", "Last modified (grade)", "Feedback comments")
GERMAN = ("ID", "Vollständiger Name", "E-Mail-Adresse", "Status", "Bewertung", "Bestwertung")
GERMAN += ("Bewertung kann geändert werden", "Zuletzt geändert (Abgabe)", "Zuletzt geändert (Bewertung)")
GERMAN += ("Feedback als Kommentar",)
CANVAS = ("Student", "ID", "SIS User ID", "SIS Login ID", "Section")
CANVAS += ("01_class (4711)", "Essay (4712)", "Current Score", "Final Grade")


def moodle(
    people: Sequence[Sequence[Any]], header: Sequence[str] = ENGLISH, most: str = "15.00", **fields: str
) -> str:
    """A worksheet as PHP's fputcsv writes it. people: number, name, mail, time if known. fields: of each row."""
    german = header == GERMAN
    word, yes = ("Teilnehmer/in", "Ja") if german else ("Participant ", "Yes")
    rows = [
        (
            f"{word}{number}",
            *(name, mail, "Zur Bewertung abgegeben" if german else "Submitted for grading"),
            *(fields.get("grade", ""), most, fields.get("can", yes)),
            *([*time, "Monday, 2 March 2026, 10:00 AM"][0], "-", 'Sehr "gut", danke\nWeiter so'),
        )
        for number, name, mail, *time in people
    ]
    return php_csv([header, *rows])


def php_csv(rows: Sequence[Sequence[str]], delimiter: str = ",") -> str:
    """Quoted where there is a space, too, and with LF, as PHP does it."""
    quote = set(' "\n\t\r,;')
    cells = [['"' + cell.replace('"', '""') + '"' if quote & set(cell) else cell for cell in row] for row in rows]
    return "".join(delimiter.join(row) + "\n" for row in cells)


def canvas(people: Sequence[Sequence[str]], header: Sequence[str] = CANVAS, most: str = "15.0") -> str:
    """An export. people: student, ID, SIS user, login; then grades of the two assignments."""
    file = io.StringIO()
    table = csv.writer(file, lineterminator="\n")
    table.writerow(header)
    table.writerow(["    Points Possible", "", "", "", "", most, "10.0", "(read only)", "(read only)"])
    for student, number, user, login, *grades in people:
        one, two = [*grades, "", ""][:2]
        table.writerow([student, number, user, login, "Section 1", one, two, "93.5", "A"])
    return file.getvalue()


def archive(path: Path, files: Mapping[str, bytes | str]) -> Path:
    """A ZIP of these files."""
    path.write_bytes(packed(files))
    return path


def packed(files: Mapping[str, bytes | str]) -> bytes:
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as made:
        for name, data in files.items():
            made.writestr(name, data)
    return file.getvalue()
