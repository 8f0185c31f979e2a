"""Notebooks for services such as Colab and Kaggle: a first cell installs the course where it is missing.

A service opens a notebook without the files beside it, so pictures become part of the notebook and links lead
to Colab or GitHub. Without an address of a release there are neither such notebooks nor links to them.
"""
import argparse
import base64
import json
import mimetypes
import re
import sys
import tomllib
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from grader.course_files.notebook_format import normalized
from grader.course_files.work_folder import student_files

COLAB = "https://colab.research.google.com/github"
GITHUB_ADDRESS = "https://github.com/"
GITHUB = re.compile(re.escape(GITHUB_ADDRESS) + r"[\w.-]+/[\w.-]+")
BRANCH = "notebooks"  # of the repository: what the release's workflow pushes
START = Path("course", "start.ipynb")  # needs JupyterLab
LINK = re.compile(r"(!?)\[([^\]]*)\]\(([^)\s:#]+)(#[^)\s]*)?\)")
README_LINK = re.compile(r"(?<=<!-- service -->).*?(?=<!-- /service -->)")
NOTICE = """\
**In a notebook service** such as Colab or Kaggle, run the next cell first: it installs the course, which
takes about a minute. It has no terminals, no packages built by colcon and no Validate button: for these, run
the course with `ros2-course lab` on your own computer. Its files are deleted when the session ends, so
download the notebook to save your work."""
INSTALL = """# Installs the course where it is missing. Elsewhere this cell does nothing.
from importlib.util import find_spec

if not find_spec("sim"):
    %pip install --quiet {wheels}
if find_spec("ros2_course"):
    from ros2_course.command import enter

    enter("{folder}")"""


@dataclass(frozen=True)
class PublishedRelease:
    """The place where a version of the course is published.

    Attributes:
        address: the repository on GitHub, such as https://github.com/OWNER/NAME. ValueError for another one.
        wheels: the addresses of the course's wheels, with spaces between them.
    """

    address: str
    wheels: str = ""

    def __post_init__(self) -> None:
        if not GITHUB.fullmatch(self.address):
            problem = "`release` in pyproject.toml is not a repository on GitHub"
            raise ValueError(f"{problem}, such as {GITHUB_ADDRESS}OWNER/NAME: {self.address}")

    def page(self, name: PurePosixPath) -> str:
        """The address of a file of the course; of a notebook the one that opens it in Colab."""
        file = f"blob/{BRANCH}/{name}"
        repository = self.address.removeprefix(GITHUB_ADDRESS)
        return f"{COLAB}/{repository}/{file}" if name.suffix == ".ipynb" else f"{self.address}/{file}"


def published(course: Path) -> PublishedRelease | None:
    """The release that pyproject.toml names under [tool.ros2-course]; None if it names none.

    Raises ValueError for an address that Colab can't open.
    """
    settings = tomllib.loads((course / "pyproject.toml").read_text(encoding="utf-8"))
    address = settings.get("tool", {}).get("ros2-course", {}).get("release", "")
    return PublishedRelease(address.rstrip("/")) if address else None


def service_notebooks(course: Path, release: PublishedRelease) -> dict[str, bytes]:
    """The notebooks by their paths, and every other file of lessons and exercises as it is."""
    found = {}
    for path in student_files(course):
        name = PurePosixPath(path.relative_to(course).as_posix())
        if Path(name) != START:
            notebook = name.suffix == ".ipynb"
            found[str(name)] = service_notebook(path, name, release) if notebook else path.read_bytes()
    return found


def service_notebook(path: Path, name: PurePosixPath, release: PublishedRelease) -> bytes:
    """A notebook with the two first cells; `name` is its path in the course."""
    notebook = json.loads(normalized(path.read_text(encoding="utf-8"), str(name)))
    install = INSTALL.format(wheels=release.wheels, folder=name.parent)
    for cell in notebook["cells"]:
        if cell["cell_type"] == "markdown":
            cell["source"] = _lines(_with_addresses("".join(cell["source"]), path, name, release))
    notebook["cells"][:0] = [
        {"cell_type": "markdown", "id": "service", "metadata": {}, "source": NOTICE},
        {"cell_type": "code", "id": "service-install", "metadata": {}, "source": install},
    ]
    return normalized(json.dumps(notebook), str(name)).encode()


def _lines(text: str) -> list[str]:
    return text.splitlines(keepends=True)


def _with_addresses(text: str, path: Path, name: PurePosixPath, release: PublishedRelease) -> str:
    """Markdown with pictures in it, and links that work without the files beside it."""

    def replacement(found: re.Match[str]) -> str:
        picture, label, target, section = found.groups()
        file = path.parent / target
        if not file.exists():
            return found[0]
        if picture:
            content = base64.b64encode(file.read_bytes()).decode()
            return f"![{label}](data:{mimetypes.guess_type(file.name)[0]};base64,{content})"
        parts = [*name.parent.parts]
        for part in PurePosixPath(target).parts:
            parts = parts[:-1] if part == ".." else [*parts, part]
        return f"[{label}]({release.page(PurePosixPath(*parts))}{section or ''})"

    return LINK.sub(replacement, text)


def add_service_link(notebook: Path, name: PurePosixPath, release: PublishedRelease | None) -> None:
    """Add to the title of a page of the site the link that opens its notebook; without a release nothing."""
    if release:
        content = json.loads(notebook.read_text(encoding="utf-8"))
        title = content["cells"][0]
        title["source"] = "".join(title["source"]) + f"\n\n[Open in Colab]({release.page(name)})"
        notebook.write_text(json.dumps(content), encoding="utf-8")


def readme_with_link(text: str, release: PublishedRelease | None) -> str:
    """The README with the link that opens the first lesson; without a release with none."""
    page = release and release.page(PurePosixPath("course/00_robot/lesson.ipynb"))
    link = f" [Open lesson 0 in Colab]({page}): that needs no installation." if page else ""
    return README_LINK.sub(link, text)


def main(arguments: list[str] | None = None) -> int:
    """Write the link into README.md, as pyproject.toml says; returns the exit status."""
    parser = argparse.ArgumentParser(
        "python -m grader.marking.release.service_notebooks", description="Write the link into README.md."
    )
    parser.parse_args(arguments)
    readme = Path("README.md")
    text = readme.read_text(encoding="utf-8")
    try:
        readme.write_text(readme_with_link(text, published(Path.cwd())), encoding="utf-8")
    except ValueError as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
