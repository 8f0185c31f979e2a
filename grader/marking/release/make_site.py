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
from pathlib import Path

import nbformat

from grader.course_notebooks import BRIDGE, course_order
from grader.marking.errors import CommandFailed
from grader.marking.release.run_notebooks import execute
from grader.marking.release.site_home import home_page
from grader.marking.release.site_search import search_script
from grader.work_folder import student_files

SETTINGS = Path(__file__).with_name("sphinx_settings.py")
PAGES = ("glossary.md", "real_robot.md", "TUTOR.md")  # of course/, in this order
NOTEBOOK_LINK = re.compile(r'(href="[^":]+)\.ipynb(?=[#"])')
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


def write_pages(course: Path, folder: Path, chosen: Sequence[str], report: Callable[[str], None]) -> None:
    """Write everything that the site is built from; only the chosen lessons, if any, are executed.

    report: called with a line for each notebook that is executed. Raises CommandFailed.
    """
    notebooks = {"course": [], "exercises": []}
    for source in sorted(student_files(course), key=course_order):
        name = source.relative_to(course)
        if name == START:
            continue
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, target)
        if name.suffix == ".ipynb":
            notebooks[name.parts[0]].append(name)
    for name in notebooks["course"]:
        if not chosen or name.parent.name in chosen:
            report(str(name))
            _write_executed(course / name, folder / name)
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


def _write_executed(source: Path, target: Path) -> None:
    notebook, stopped = execute(source)
    if stopped:
        raise CommandFailed(f"{source} could not be executed: {' '.join(stopped)}")
    for cell in notebook.cells:
        for output in cell.get("outputs", ()):
            data = output.get("data", {})
            if "text/html" in data:  # such as the map, which links to notebooks
                data["text/html"] = NOTEBOOK_LINK.sub(r"\1.html", data["text/html"])
    notebook.metadata.pop("widgets", None)
    nbformat.write(notebook, target)


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
    parser.add_argument("--lesson", action="append", default=[], help="a folder: execute this one only")
    options = parser.parse_args(arguments)
    try:
        with tempfile.TemporaryDirectory() as place:
            write_pages(Path.cwd(), Path(place), options.lesson, lambda line: print(line, flush=True))
            shutil.rmtree(options.to, ignore_errors=True)
            build(options.sphinx, Path(place), options.to)
    except CommandFailed as error:
        print(error, file=sys.stderr)
        return 1
    print(f"Open {options.to / 'index.html'}.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
