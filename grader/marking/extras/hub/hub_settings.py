"""The settings of a hub: class/hub.toml."""
import re
import shutil
import tomllib
from collections.abc import Mapping
from dataclasses import MISSING, dataclass, fields
from pathlib import Path
from typing import Annotated, Any, TypeVar

from grader.marking.errors import CourseError
from grader.marking.extras.hub.become_user import TEMPORARY
from sim.world.validated_model import Model, ModelError, within

FILE = Path("class", "hub.toml")
TEMPLATE = Path(__file__).with_name("hub.toml")
NAME = re.compile(r"[a-z][a-z0-9_-]{1,23}")
NAME_PHRASE = "2 to 24 of a-z, 0-9, - and _, the first one a letter"
MAX_DOMAIN = 101  # of ROS; the ports of larger ones may be used by other programs
_M = TypeVar("_M", bound=Model)


@dataclass(frozen=True)
class ServerSettings(Model):
    """The hub's location, and when it stops a server that is not used."""

    folder: str = "/srv/ros2-hub"
    address: str = "127.0.0.1"
    port: Annotated[int, within(1, 65535)] = 8000
    certificate: str = ""
    key: str = ""
    idle_minutes: Annotated[int, within(1, 10_000, "minutes")] = 60
    idle_kernel_minutes: Annotated[int, within(1, 10_000, "minutes")] = 20


@dataclass(frozen=True)
class UserLimits(Model):
    """Limits on what one user can use."""

    memory_gb: Annotated[float, within(0.5, 1000, "GB")] = 2.0
    processes: Annotated[int, within(50, 100_000)] = 300
    cpus: Annotated[float, within(0.1, 1000, "cores")] = 1.0


@dataclass(frozen=True)
class HubCourse(Model):
    """The names of a course's people."""

    teachers: tuple[str, ...]
    students: tuple[str, ...] = ()


@dataclass(frozen=True)
class HubSettings:
    """The settings of a hub, and where its files are."""

    server: ServerSettings
    limits: UserLimits
    courses: Mapping[str, HubCourse]

    @property
    def folder(self) -> Path:
        """The folder of everything that is not in a home."""
        return Path(self.server.folder)

    @property
    def installation(self) -> Path:
        """The students' course and its .venv: everyone reads it, and only root writes it."""
        return self.folder / "installation"

    @property
    def students(self) -> dict[str, str]:
        """Each student's course."""
        return {name: course for course, people in self.courses.items() for name in people.students}

    @property
    def teachers(self) -> list[str]:
        """All teachers, sorted."""
        return sorted({name for people in self.courses.values() for name in people.teachers})

    def home(self, course: str) -> Path:
        """The home of the Unix user who marks a course."""
        return self.folder / "courses" / course

    def course_folder(self, course: str) -> Path:
        """The course with its solutions, gradebook and secret."""
        return self.home(course) / "course"

    def exchange(self, course: str) -> Path:
        """Nbgrader's exchange of a course, as its teachers use it."""
        return self.folder / "exchange" / "courses" / course

    def inboxes(self, course: str) -> Path:
        """The folder of the inboxes of a course's students."""
        return self.folder / "exchange" / "students" / course

    def inbox(self, student: str) -> Path:
        """Nbgrader's exchange, as one student uses it."""
        return self.inboxes(self.students[student]) / student

    def runtime(self, user: str) -> Path:
        """The folder of a user's sockets; paths of sockets are short, and those of homes may not be."""
        return self.folder / "run" / user

    def certificates(self, user: str) -> Path:
        """The certificates with which a user's server and the hub know each other."""
        return self.folder / "certificates" / user

    def domain(self, user: str) -> int:
        """The ROS domain of a user: with up to 101 students and teachers, no other user has it."""
        users = sorted({*self.students, *self.teachers})
        return 1 + users.index(user) % MAX_DOMAIN if user in users else 0


def grader_of(course: str) -> str:
    """The Unix user who owns a course's folder and marks it; its teachers act as this user."""
    return f"grader-{course}"


def write_template(folder: Path) -> Path:
    """Write settings to fill in, unless there are any; returns the file."""
    file = folder / FILE
    if not file.exists():
        file.parent.mkdir(exist_ok=True)
        shutil.copyfile(TEMPLATE, file)
    return file


def read_settings(file: Path) -> HubSettings:
    """Read the settings. Raises CourseError, with one sentence."""
    try:
        with file.open("rb") as stream:
            data = tomllib.load(stream)
        return _settings(data)
    except OSError as error:
        raise CourseError(f"{file} can't be read ({error.strerror}): `make hub` writes one") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise CourseError(f"{file} is not a TOML file: {error}") from None
    except (ValueError, ModelError) as error:
        raise CourseError(f"{file}: {getattr(error, 'reason', error)}") from None


def _settings(data: dict[str, Any]) -> HubSettings:
    _check_keys("", data, ("server", "limits", "courses"))
    courses = data.get("courses")
    if not isinstance(courses, dict) or not courses:
        raise ValueError("there is no course: write a table such as [courses.ros2].")
    settings = HubSettings(
        _model("server", data.get("server", {}), ServerSettings),
        _model("limits", data.get("limits", {}), UserLimits),
        {name: _model(f"courses.{name}", table, HubCourse) for name, table in courses.items()},
    )
    _check_names(settings)
    if bool(settings.server.certificate) != bool(settings.server.key):
        raise ValueError("server.certificate and server.key belong together: write both or none.")
    if not settings.folder.is_absolute():
        raise ValueError(f"server.folder is {settings.server.folder!r}; write an absolute path.")
    for folder in TEMPORARY:
        if settings.folder.is_relative_to(folder):
            raise ValueError(f"server.folder is in {folder}, and each user has another {folder}: change it.")
    return settings


def _model(name: str, table: Any, model: type[_M]) -> _M:
    if not isinstance(table, dict):
        raise ValueError(f"{name} is {table!r}; write a table [{name}].")
    known = [field.name for field in fields(model)]
    _check_keys(f"{name}.", table, known)
    for field in fields(model):
        if field.default is field.default_factory is MISSING and field.name not in table:
            raise ValueError(f"{name}.{field.name} is missing.")
    try:
        return model(**table)
    except ModelError as error:
        raise ValueError(f"{name}.{error.reason}") from None


def _check_keys(prefix: str, table: dict[str, Any], known: tuple[str, ...] | list[str]) -> None:
    for key in table:
        if key not in known:
            raise ValueError(f"{prefix}{key} is not a known key; the keys are {', '.join(known)}.")


def _check_names(settings: HubSettings) -> None:
    course_of: dict[str, str] = {}
    for course, people in settings.courses.items():
        for name in (course, *people.teachers, *people.students):
            if not NAME.fullmatch(name):
                raise ValueError(f"the name {name!r} can't be used; write {NAME_PHRASE}.")
        for name in people.students:
            if name in course_of:
                raise ValueError(f"{name} is a student of {course_of[name]} and {course}: one course each.")
            course_of[name] = course
    for name in {grader_of(course) for course in settings.courses} & {*course_of, *settings.teachers}:
        raise ValueError(f"{name} is the user who marks the course, and can't be a teacher or student.")
    for name in settings.teachers:
        if name in course_of:
            raise ValueError(f"{name} is a teacher, and a student of {course_of[name]}: use two names.")
