"""Builds the course as a web site: executed lessons with replays, tasks, the map, the glossary, a search.

    python -m grader.marking.release.make_site --sphinx .venv-site/bin/sphinx-build

Open dist/site/index.html, or publish the folder: it needs no server of its own. `make site` does it all.
"""
import argparse
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path, PurePosixPath

import nbformat
from nbformat import NotebookNode

from grader.course_files.course_notebooks import BRIDGE, course_order
from grader.course_files.work_folder import student_files
from grader.marking.errors import CommandFailed
from grader.marking.release.service_notebooks import add_service_link, published
from grader.marking.release.site_home import home_page
from grader.marking.release.site_pages import executed_pages
from grader.marking.release.site_search import search_script

SETTINGS = Path(__file__).with_name("sphinx_settings.py")
STYLE = Path(__file__).with_name("site.css")
PAGES = ("glossary.md", "real_robot.md", "TUTOR.md")  # of course/, in this order
NOTEBOOK_LINK = re.compile(r'(href="[^":]+)\.ipynb(?=[#"])')
OUTCOME = '<div class="ros2-outcome"'  # of a prediction
START = Path("course", "start.ipynb")  # a student's own progress: the site has a home page in its place
INDEX = """# ROS 2 in notebooks

```{{raw}} html
:file: home.html
```

```{{toctree}}
:hidden:
:caption: Overview
{overview}
```

```{{toctree}}
:hidden:
:caption: Lessons
{lessons}
```

```{{toctree}}
:hidden:
:caption: Other systems
{bridge}
```

```{{toctree}}
:hidden:
:caption: Tasks
{tasks}
```
"""


def write_pages(
    course: Path, folder: Path, kept: Path, chosen: Sequence[str], report: Callable[[str], None]
) -> None:
    """Write everything that the site is built from; only the chosen lessons, if any, have outputs.

    kept: the folder with the outputs of earlier builds. report: called with the name of each notebook that is
    executed. Raises CommandFailed.
    """
    notebooks: dict[str, list[Path]] = {"course": [], "exercises": []}
    for source in sorted(student_files(course), key=course_order):
        name = source.relative_to(course)
        if name == START:
            continue
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, target)
        if name.suffix == ".ipynb":
            notebooks[name.parts[0]].append(name)
    names = [name for name in notebooks["course"] if not chosen or name.parent.name in chosen]
    for name, notebook in zip(names, executed_pages(course, names, kept, report), strict=True):
        nbformat.write(_without_kernel(notebook), folder / name)
    for name in (*notebooks["course"], *notebooks["exercises"]):
        add_service_link(folder / name, PurePosixPath(name), published(course))
    overview = [f"course/{page.removesuffix('.md')}" for page in PAGES]
    lessons = [name.with_suffix("").as_posix() for name in notebooks["course"] if len(name.parts) > 2]
    bridge = [name for name in lessons if name.startswith(f"course/{BRIDGE}/")]
    tasks = [name.with_suffix("").as_posix() for name in notebooks["exercises"]]
    lessons = [name for name in lessons if name not in bridge]
    lists = {"overview": overview, "lessons": lessons, "bridge": bridge, "tasks": tasks}
    text = INDEX.format(**{name: "\n".join(entries) for name, entries in lists.items()})
    (folder / "index.md").write_text(text, encoding="utf-8")
    pages = [*overview, *lessons, *bridge, *tasks]
    (folder / "search.js").write_text(search_script(folder, pages), encoding="utf-8")
    (folder / "home.html").write_text(home_page(course), encoding="utf-8")
    shutil.copyfile(SETTINGS, folder / "conf.py")
    (folder / "static").mkdir(exist_ok=True)
    shutil.copyfile(STYLE, folder / "static" / STYLE.name)


def _without_kernel(notebook: NotebookNode) -> NotebookNode:
    """An executed notebook as a page: links lead to pages, and predictions can be made."""
    notebook.metadata.pop("widgets", None)
    for cell in notebook.cells:
        if cell.metadata.get("jupyter", {}).get("source_hidden"):
            cell.metadata.tags = [*cell.metadata.get("tags", ()), "remove-input"]
        for output in cell.get("outputs", ()):
            data = output.get("data", {})
            if "text/html" in data:  # such as the map, which links to notebooks
                page = NOTEBOOK_LINK.sub(r"\1.html", data["text/html"])
                data["text/html"] = page.replace(OUTCOME, f"{OUTCOME} data-recorded")
    return notebook


def build(sphinx: Path, source: Path, target: Path) -> None:
    """Build the site. Raises CommandFailed with what Sphinx printed."""
    command = [str(sphinx), "-q", "-E", "-b", "html", str(source), str(target)]
    try:
        done = subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    except OSError as error:
        raise CommandFailed(f"{sphinx} can't be run ({error.strerror}): `make site` installs it") from None
    if done.returncode:
        raise CommandFailed(f"{sphinx.name} failed:\n{done.stdout.strip()}")


def main(arguments: list[str] | None = None) -> int:
    """Run the command line in the course's folder; returns the exit status."""
    parser = argparse.ArgumentParser(
        "python -m grader.marking.release.make_site", description="Build the course as a web site."
    )
    parser.add_argument("--sphinx", type=Path, required=True, metavar="PROGRAM", help="sphinx-build")
    parser.add_argument("--to", type=Path, default=Path("dist", "site"), help="default: dist/site")
    parser.add_argument("--lesson", action="append", default=[], help="a folder: only this one has outputs")
    options = parser.parse_args(arguments)
    try:
        with tempfile.TemporaryDirectory() as place:
            kept = options.to.with_name(f"{options.to.name}-outputs")
            pages, site = Path(place, "pages"), Path(place, "site")
            write_pages(Path.cwd(), pages, kept, options.lesson, lambda line: print(line, flush=True))
            build(options.sphinx, pages, site)
            shutil.rmtree(options.to, ignore_errors=True)
            shutil.move(site, options.to)
    except CommandFailed as error:
        print(error, file=sys.stderr)
        return 1
    print(f"Open {options.to / 'index.html'}.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
