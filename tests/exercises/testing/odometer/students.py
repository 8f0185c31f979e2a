"""Packages for testing.odometer: right ones in four layouts, then wrong ones, each named by its defect."""

from grader.exercises.testing.odometer.odometer_package import CFG, FILES, HELPER, PROGRAM, SETUP
from tests.students.workspaces import Workspace, changed

PARTS = (
    "CFG", "FILES", "HELPER", "PROGRAM", "SETUP", "NODE", "RIGHT", "S", "C", "N", "H", "HACK", "POINT",
    "SCRIPT", "NEW_OPTION", "OLD_OPTION", "laid_out", "several",
)  # fmt: skip
S, C = "odometer/setup.py", "odometer/setup.cfg"
N, H = "odometer/odometer/node.py", "odometer/odometer/encoder.py"
NEW_OPTION, OLD_OPTION = "extras_require={'test': ['pytest']}", "tests_require=['pytest']"
HACK = 'sys.path.insert(0, "../helpers")\n'
POINT = "'odometer = odometer.node:main'"
NODE = (
    PROGRAM.replace(HACK, "").replace("import sys\n\n", "")
    .replace("from encoder", "from odometer.encoder")
    .replace('if __name__ == "__main__":', "def main():")
)  # fmt: skip
SCRIPT = NODE.replace("def main():", 'if __name__ == "__main__":')


def laid_out(modules: dict[str, str], points: str = POINT) -> dict[str, str]:
    """The package without warnings, with these modules in place of scripts/ and helpers/."""
    kept = {path: text for path, text in FILES.items() if "/scripts/" not in path and "/helpers/" not in path}
    setup = SETUP.replace(OLD_OPTION, NEW_OPTION)
    return {
        **kept,
        S: setup.replace("'console_scripts': [", f"'console_scripts': [{points}"),
        C: CFG.replace("script-dir", "script_dir"),
        **{f"odometer/{path}": text for path, text in modules.items()},
    }


def several(files: dict[str, str], *changes: tuple[str, str, str]) -> Workspace:
    """A workspace with the files, after several changes of the form (path, old, new)."""
    for path, old, new in changes:
        files = changed(files, path, old, new)
    return Workspace(__name__, files)


RIGHT = laid_out({"odometer/node.py": NODE, "odometer/encoder.py": HELPER})

Odometer = Workspace(__name__, RIGHT)
BesideIt = several(
    laid_out(
        {
            "odometer/odometer.py": NODE,
            "odometer/wheels/__init__.py": "",
            "odometer/wheels/encoder.py": HELPER,
        },
        "'odometer = odometer.odometer:main'",
    ),
    ("odometer/odometer/odometer.py", "from odometer.encoder", "from .wheels.encoder"),
    (S, f"    {NEW_OPTION},\n", ""),
)
AsAScript = several(  # a design of its own: a script that is installed as it is
    laid_out({"scripts/odometer": SCRIPT, "odometer/encoder.py": HELPER}, ""),
    (S, "zip_safe=True", "scripts=['scripts/odometer'], zip_safe=True"),
)
InSetupCfg = several(
    laid_out({"odometer/node.py": NODE, "odometer/encoder.py": HELPER}, ""),
    (S, "    entry_points={\n        'console_scripts': [\n        ],\n    },\n", ""),
    (
        C,
        "[develop]",
        "[options.entry_points]\nconsole_scripts =\n    odometer = odometer.node:main\n[develop]",
    ),
)
AsGiven = Workspace(__name__, FILES)
NoEntryPoint = Workspace(__name__, changed(RIGHT, S, POINT, ""))
NoMain = Workspace(__name__, changed(RIGHT, N, "def main():", 'if __name__ == "__main__":'))
MisspeltMain = Workspace(__name__, changed(RIGHT, S, "node:main", "node:mian"))
HelperLeftBehind = Workspace(__name__, laid_out({"odometer/node.py": NODE, "helpers/encoder.py": HELPER}))
FromItsFolder = Workspace(__name__, changed(RIGHT, N, "from odometer.encoder", "from encoder"))
PathFromScripts = Workspace(
    __name__,
    laid_out(
        {
            "odometer/node.py": PROGRAM.replace('if __name__ == "__main__":', "def main():"),
            "helpers/encoder.py": HELPER,
        }
    ),
)
HelperWithoutInit = Workspace(
    __name__,
    laid_out({
        "odometer/node.py": NODE.replace("odometer.encoder", "odometer.helpers.encoder"),
        "odometer/helpers/encoder.py": HELPER,
    }),
)
OtherTopic = Workspace(__name__, changed(RIGHT, N, '"distance"', '"meters"'))
Retyped = Workspace(__name__, changed(RIGHT, H, "AROUND * ticks / PER_TURN", "ticks / PER_TURN"))
ScriptsAtTheTop = several(
    laid_out(
        {"scripts/odometer.py": NODE, "helpers/encoder.py": HELPER}, "'odometer = scripts.odometer:main'"
    ),
    ("odometer/scripts/odometer.py", "from odometer.encoder", "from helpers.encoder"),
    (S, "find_packages(exclude=['test'])", "['odometer', 'scripts', 'helpers']"),
)
HelpersAtTheTop = several(
    laid_out({"odometer/node.py": NODE, "helpers/__init__.py": "", "helpers/encoder.py": HELPER}),
    (N, "from odometer.encoder", "from helpers.encoder"),
)
ModuleAtTheTop = several(
    laid_out({"odometer/node.py": NODE, "encoder.py": HELPER}),
    (N, "from odometer.encoder", "from encoder"),
    (S, "zip_safe=True", "py_modules=['encoder'], zip_safe=True"),
)
ChangesThePath = Workspace(
    __name__,
    changed(
        RIGHT,
        N,
        "from odometer.encoder",
        "import os, sys\nsys.path.insert(0, os.path.dirname(__file__))\nfrom encoder",
    ),
)
BesideTheProgram = several(
    laid_out(
        {"scripts/odometer": SCRIPT.replace("odometer.encoder", "encoder"), "helpers/encoder.py": HELPER}, ""
    ),
    (S, "zip_safe=True", "scripts=['scripts/odometer', 'helpers/encoder.py'], zip_safe=True"),
)
OldOption = Workspace(__name__, changed(RIGHT, S, NEW_OPTION, OLD_OPTION))
MisspeltOption = Workspace(__name__, changed(RIGHT, S, "extras_require", "extra_requires"))
DashInTheKey = Workspace(__name__, changed(RIGHT, C, "script_dir", "script-dir"))
NoLicenseFile = Workspace(
    __name__, changed(RIGHT, S, "zip_safe=True", "license_files=['LICENSE'], zip_safe=True")
)
HidesWarnings = several(
    changed(RIGHT, S, NEW_OPTION, OLD_OPTION),
    (S, "from setuptools", "import warnings\nwarnings.filterwarnings('ignore')\n\nfrom setuptools"),
)
HidesByAnotherName = several(
    changed(RIGHT, S, NEW_OPTION, OLD_OPTION),
    (
        S,
        "from setuptools",
        "import sys\nsys.modules['warn' + 'ings'].filterwarnings('ignore')\n\nfrom setuptools",
    ),
)
ClosesStderr = several(
    changed(RIGHT, S, NEW_OPTION, OLD_OPTION),
    (S, "from setuptools", "import os\nos.dup2(os.open(os.devnull, os.O_WRONLY), 2)\n\nfrom setuptools"),
)
PathOfAnotherName = Workspace(
    __name__,
    changed(
        RIGHT,
        N,
        "from odometer.encoder",
        "import os, sys\nvars(sys)['path'].insert(0, os.path.dirname(__file__))\nfrom encoder",
    ),
)
