"""Who uploaded a file, by its name in an archive of Moodle or Canvas, or in one packed by hand."""
import re
from collections.abc import Collection
from dataclasses import dataclass
from pathlib import PurePosixPath

from grader.marking.extras.learning_platform.platform_users import PlatformUser

MOODLE = re.compile(r"(?P<name>.+)_(?P<number>\d+)_assignsubmission_(?P<kind>[a-z]+)(_(?P<rest>.*))?")
CANVAS = re.compile(r"(?P<name>.+?)(?P<late>_LATE)?_(?P<number>\d+)_(?P<file>\d+)_(?P<rest>.+)")
ANONYMOUS = re.compile(r"(?P<number>anon_[0-9A-Za-z]+)(?P<late>_LATE)?_(?P<file>\d+)_(?P<rest>.+)")
AGAIN = re.compile(r"(.+?)(?:-(\d+)| ?\((\d+)\))(\.[^.]+)")  # a second upload of a name


@dataclass(frozen=True)
class NamedUpload:
    """A file that someone uploaded.

    path: in the submission. new_id: for a person who is no student yet. copy, packed: higher for later files
    of this path in the same archive, and in a ZIP in it. The other fields: as in CollectedUpload.
    """

    person: PlatformUser
    path: str
    new_id: str
    late: bool | None = None
    attempt: int = 0
    copy: int = 0
    packed: int = 0
    lasting: bool = False
    feedback: str = ""

    @property
    def order(self) -> tuple[int, int, int]:
        """Higher for later uploads of this path."""
        return self.attempt, self.copy, self.packed


def read_name(path: str, notebooks: Collection[str]) -> NamedUpload | None:
    """Read the path of a file; None if it names no student. notebooks: of the release, with .ipynb."""
    return _moodle(path, notebooks) or _canvas(path, notebooks) or _plain(path, notebooks)


def _moodle(path: str, notebooks: Collection[str]) -> NamedUpload | None:
    *folders, last = PurePosixPath(path).parts
    for at, part in enumerate([*folders, last]):
        match = MOODLE.fullmatch(part)
        if match and match["kind"] == "file":
            inner = [*folders, last][at + 1 :] or [match["rest"] or ""]
            person = PlatformUser(match["name"], match["number"])
            folder = moodle_folder(person.name, person.number)
            file, copy = first_name("/".join(inner), notebooks)
            found = NamedUpload(person, file, person.name, copy=copy, feedback=f"{folder}/{{page}}")
            return found if inner[0] else None
    return None


def moodle_folder(name: str, number: str) -> str:
    """The folder of a student's feedback; Moodle takes what is behind the first `_` for the number."""
    plain = re.sub(r"[_/\\\0-\x1f{}]+", " ", name).strip(" .~") or "student"
    return f"{plain}_{number}_assignsubmission_file"


def _canvas(path: str, notebooks: Collection[str]) -> NamedUpload | None:
    name = PurePosixPath(path).name
    match = ANONYMOUS.fullmatch(name) or CANVAS.fullmatch(name)
    if not match:
        return None
    rest, copy = first_name(match["rest"], notebooks)
    begin = name.removesuffix(match["rest"]).replace("{", "").replace("}", "")
    name = match.groupdict().get("name", "")
    person = PlatformUser(name, match["number"])
    late, attempt = bool(match["late"]), int(match["file"])
    feedback = f"{begin}{{page}}"
    return NamedUpload(person, rest, person.number, late, attempt, copy, 0, bool(name), feedback)


def _plain(path: str, notebooks: Collection[str]) -> NamedUpload | None:
    """A file such as anna-lena_nodes.ipynb, of the student anna-lena."""
    rest, copy = first_name(PurePosixPath(path).name, notebooks)
    for notebook in notebooks:
        who = rest.removesuffix(f"_{notebook}")
        if who not in ("", rest):
            student = who.removesuffix("_LATE")
            person = PlatformUser(student, ids=(student,))
            return NamedUpload(person, notebook, student, student != who or None, copy=copy)
    return None


def first_name(name: str, notebooks: Collection[str]) -> tuple[str, int]:
    """The name that a second upload had first, and which upload it is.

    The platform, or the student's browser, adds -1 or (1) to a name that exists. Only that tells which is
    newer: the times in an archive are those of packing it, or a student's.
    """
    match = AGAIN.fullmatch(name)
    if match and any((match[1] + match[4]).endswith(each) for each in (*notebooks, ".zip")):
        return match[1] + match[4], int(match[2] or match[3])
    return name, 0
