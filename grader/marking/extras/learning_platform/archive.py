"""Reads a ZIP that students' files are in: nothing outside it is touched, and no size is believed."""
import io
import re
import stat
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from zlib import error as CompressionError

from grader.marking.errors import CourseError, MarkingError

MAX_FILE_BYTES = 128_000_000
MAX_ENTRIES = 100_000
JUNK = re.compile(r"(.*/)?(__MACOSX|\.[^/]*|Thumbs\.db|desktop\.ini)(/.*)?", re.IGNORECASE)


class UnusableEntry(MarkingError):
    """A file in an archive that is not used; the text says why, as the end of a sentence."""


@dataclass(frozen=True)
class ArchiveEntry:
    """A file in an archive. path: with `/`. problem: why it is not used, or ""."""

    path: str
    problem: str
    info: zipfile.ZipInfo
    archive: zipfile.ZipFile

    def read(self) -> bytes:
        """Its bytes. Raises UnusableEntry."""
        if self.problem:
            raise UnusableEntry(self.problem)
        try:
            with self.archive.open(self.info) as file:
                data = file.read(MAX_FILE_BYTES + 1)
        except (zipfile.BadZipFile, CompressionError, EOFError, OSError, NotImplementedError) as error:
            raise UnusableEntry(f"is damaged ({error})") from None
        if len(data) > MAX_FILE_BYTES:
            raise UnusableEntry(_too_large(len(data)))
        return data


def open_archive(path: Path) -> list[ArchiveEntry]:
    """The files in an archive. Raises CourseError if it is none, OSError."""
    try:
        return list(entries(zipfile.ZipFile(path)))
    except (zipfile.BadZipFile, UnusableEntry, ValueError) as error:
        raise CourseError(f"expected a ZIP from the platform, saw {path} ({error})") from None


def open_inner(entry: ArchiveEntry) -> list[ArchiveEntry]:
    """The files in an archive that is in an archive. Raises UnusableEntry."""
    try:
        return list(entries(zipfile.ZipFile(io.BytesIO(entry.read()))))
    except (zipfile.BadZipFile, ValueError) as error:
        raise UnusableEntry(f"is not a ZIP ({error})") from None


def entries(archive: zipfile.ZipFile) -> Iterator[ArchiveEntry]:
    """The files of an open archive, without folders and what systems add. Raises UnusableEntry."""
    infos = archive.infolist()
    if len(infos) > MAX_ENTRIES:
        raise UnusableEntry(f"has {len(infos)} entries, and at most {MAX_ENTRIES} are read")
    for info in infos:
        path = info.filename.replace("\\", "/")
        if not info.is_dir() and not (JUNK.fullmatch(path) and ".." not in path.split("/")):
            yield ArchiveEntry(path, _problem(info, path), info, archive)


def _problem(info: zipfile.ZipInfo, path: str) -> str:
    if path.startswith("/") or ".." in path.split("/") or re.match(r"[A-Za-z]:", path):
        return "has a path that leads out of the archive"
    if stat.S_ISLNK(info.external_attr >> 16):
        return "is a link"
    if info.flag_bits & 1:
        return "is encrypted"
    return _too_large(info.file_size) if info.file_size > MAX_FILE_BYTES else ""


def _too_large(size: int) -> str:
    return f"has more than {MAX_FILE_BYTES // 1_000_000} MB"
