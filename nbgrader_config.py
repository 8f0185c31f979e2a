"""nbgrader for this course. Run it in this folder, as its manual says: `nbgrader export`, ...

solutions/ is the source and exercises/ the release. Everything about a class is in class/, which git ignores.
"""
import os
import sys
from pathlib import Path

c = get_config()  # noqa: F821  (nbgrader provides it)

# nbgrader runs `alembic`, which is installed beside this Python and need not be on PATH.
os.environ["PATH"] = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"

course = c.CourseDirectory
course.course_id = "ros2"
course.source_directory = "solutions"
course.release_directory = "exercises"
course.submitted_directory = "class/submitted"
course.autograded_directory = "class/autograded"
course.feedback_directory = "class/feedback"
course.solution_directory = "class/solution"
course.source_with_tests_directory = "class/source_with_tests"
course.db_url = f"sqlite:///{Path('class', 'gradebook.db').absolute()}"
Path("class").mkdir(exist_ok=True)  # sqlite makes the file but not the folder
# Without a folder for its exchange, the formgrader opens with a warning. Nothing of this course goes there.
c.Exchange.root = str(Path("class", "exchange").absolute())
Path("class", "exchange").mkdir(exist_ok=True)
# On a hub it is shared with the students.
if Path("class", "hub_config.py").exists():
    load_subconfig("hub_config.py", path=str(Path("class").absolute()))  # noqa: F821
# nbgrader copies the files beside a notebook, out of solutions/ and out of submissions, except these. A
# Python file may be an answer that a cell wrote, or stand in for a library: cells write what they need.
course.ignore = ["*.py", "*.pyc", "__pycache__", "*answer*", "*solution*", ".*", "feedback"]

# The release is under version control, so it has the one form of our notebooks.
c.GenerateAssignment.post_convert_hook = "grader.marking.release.make_exercises.tidy"

# An instructor may leave out exercises and change points: grader/YOUR_FIRST_EXERCISE.md.
if Path("class", "course.toml").exists():
    from nbgrader.converters import GenerateAssignment

    from grader.marking.release.own_choice import OwnChoice

    c.OwnChoice.file = str(Path("class", "course.toml").absolute())
    c.GenerateAssignment.preprocessors = [OwnChoice, *GenerateAssignment.preprocessors.default()]

# On a busy machine a kernel needs long to start, and a cell's output comes long after the cell, in seconds.
c.Execute.startup_timeout = 600
c.Execute.iopub_timeout = 60

# A test cell may take this long, in seconds. Validate blocks JupyterLab while it runs, so it waits less.
c.Execute.timeout = 60
c.Validator.Execute.timeout = 30


def name_slow_cells(hook):
    """A hook of Validate; `grader` takes a while to import, so other commands don't import it."""

    def call(**about):
        from grader.marking.release import slow_cells

        getattr(slow_cells, hook)(**about)

    return call


# It names an answer cell that it stopped also where only the tests below are shown.
c.Validator.Execute.on_cell_start = name_slow_cells("begin")
c.Validator.Execute.on_cell_error = name_slow_cells("explain")
# nbgrader gives no points for a test cell that writes to stderr, where log lines and warnings go. So in the
# kernels that mark or validate, what goes to stderr shows on stdout.
c.Execute.extra_arguments = ["--IPKernelApp.exec_lines=import sys; sys.stderr.name = 'stdout'"]

# autograde runs students' code without a sandbox. So it refuses, before it removes anything, by default.
if "autograde" in sys.argv[1:2]:
    from grader.marking.secret import require_acceptance

    require_acceptance()
# Marking uses private worlds and seeds; Validate never sees the secret they come from.
c.Autograde.pre_convert_hook = "grader.marking.secret.set_course_secret"
c.Autograde.post_convert_hook = "grader.marking.secret.remove_course_secret"
# c.LateDays.percent_per_day = 10 takes so many percent of the points for each day late that has begun.
c.AssignLatePenalties.plugin_class = "grader.marking.gradebook.late_days.LateDays"
# A submission's HTML must not run as script in the instructor's browser.
c.HTMLExporter.sanitize_html = True
SAFE = "grader.marking.gradebook.safe_html"
# The pages' templates hand outputs to the first of these filters, and Markdown cells to the other two.
c.HTMLExporter.filters = {
    "clean_html": f"{SAFE}.clean_output",
    "markdown2html": f"{SAFE}.markdown",
    "strip_files_prefix": f"{SAFE}.clean",
}
# Nor may its size keep the instructor waiting.
c.HTMLExporter.preprocessors = [f"{SAFE}.plain_outputs", "grader.marking.gradebook.short_pages.shorten"]
c.ExportApp.plugin_class = "grader.marking.gradebook.grades.Grades"

# A student's page, with the name, contents by exercise, and nothing from elsewhere.
c.GenerateFeedback.exporter_class = "grader.marking.gradebook.student_page.StudentPage"
