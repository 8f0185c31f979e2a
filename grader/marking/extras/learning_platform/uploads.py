"""Sorts an archive into uploads by person: for each file the newest, and why others are not used."""
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import PurePosixPath

from grader.marking.extras.learning_platform.archive import ArchiveEntry, UnusableEntry, open_inner
from grader.marking.extras.learning_platform.platform_users import PlatformUser
from grader.marking.extras.learning_platform.upload_names import NamedUpload, first_name, read_name
from grader.marking.submission.submitted_files import IGNORED_FILES

ZIP = ".zip"
MAX_FILES, MAX_BYTES = 1000, 160_000_000  # of one person's upload
MAX_NAME_BYTES = 200
WORKSPACE = "ws"  # the only folder that assignments have


@dataclass
class PersonalUpload:
    """One person's upload: the files by path in the submission, and what is known of the newest."""

    person: PlatformUser
    files: dict[str, tuple[NamedUpload, ArchiveEntry]] = field(default_factory=dict)

    @property
    def newest(self) -> NamedUpload:
        """The newest of the files."""
        return max((named for named, _ in self.files.values()), key=lambda named: named.order)

    def read(self) -> dict[str, bytes]:
        """The contents by path. Raises UnusableEntry."""
        contents: dict[str, bytes] = {}
        if len(self.files) > MAX_FILES:
            raise UnusableEntry(f"has {len(self.files)} files, and at most {MAX_FILES} are taken")
        folders = {str(folder) for path in self.files for folder in PurePosixPath(path).parents}
        for path, (_, entry) in self.files.items():
            too_long = max(map(_length, path.split("/"))) > MAX_NAME_BYTES
            if path in folders or too_long or not path.isprintable():
                raise UnusableEntry(f"has a file that can't be written: {path[:60]!r}")
            contents[path] = entry.read()
            if sum(map(len, contents.values())) > MAX_BYTES:
                raise UnusableEntry(f"has more than {MAX_BYTES // 1_000_000} MB")
        return contents


def _length(name: str) -> int:
    return len(name.encode(errors="replace"))


def sort_uploads(
    entries: Iterable[ArchiveEntry], notebooks: Collection[str], unused: list[str]
) -> list[PersonalUpload]:
    """The uploads by person, in the order of the archive. unused: gets a sentence for each file left out."""
    found: dict[PlatformUser, PersonalUpload] = {}
    for entry in entries:
        named = read_name(entry.path, notebooks)
        if named is None:
            unused.append(f"{entry.path}: names no student")
            continue
        upload = found.setdefault(named.person, PersonalUpload(named.person))
        for each, content in _unpacked(named, entry, notebooks, unused):
            _add(upload, each, content, unused)
    return [upload for upload in found.values() if upload.files]


def _unpacked(
    named: NamedUpload, entry: ArchiveEntry, notebooks: Collection[str], unused: list[str]
) -> Iterator[tuple[NamedUpload, ArchiveEntry]]:
    """The file, or those in it if it is an archive."""
    if entry.problem:
        unused.append(f"{entry.path}: {entry.problem}")
    elif not named.path.lower().endswith(ZIP):
        yield named, entry
    else:
        try:
            inner = open_inner(entry)
        except UnusableEntry as error:
            unused.append(f"{entry.path}: {error}")
            return
        top = _common_folder([each.path for each in inner])
        for each in inner:
            where = f"{entry.path}: {each.path}"
            if each.problem or each.path.lower().endswith(ZIP):
                unused.append(f"{where}: {each.problem or 'is a ZIP in a ZIP in a ZIP'}")
            else:
                path, packed = first_name(str(PurePosixPath(each.path.removeprefix(top))), notebooks)
                yield replace(named, path=path, packed=packed), replace(each, path=where)


def _add(upload: PersonalUpload, named: NamedUpload, entry: ArchiveEntry, unused: list[str]) -> None:
    """Add a file, in place of an older one with its path."""
    if named.path.lower() in IGNORED_FILES:
        unused.append(f"{entry.path}: is never taken from a student")
        return
    if named.path in upload.files:
        before, old = upload.files[named.path]
        again = "was uploaded again" if before.order != named.order else "has the name of another file"
        if before.order >= named.order:
            entry, old = old, entry
            named = before
        unused.append(f"{old.path}: {again}, {entry.path} counts")
    upload.files[named.path] = named, entry


def _common_folder(paths: Sequence[str]) -> str:
    """The folder that all of an archive is in, with `/`, unless it is the workspace; "" if there is none."""
    tops = {PurePosixPath(path).parts[0] for path in paths if path}
    if len(tops) != 1 or WORKSPACE in tops or not all("/" in path for path in paths):
        return ""
    return f"{tops.pop()}/"
