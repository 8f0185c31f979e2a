"""ros2 pkg create: the files of a new package."""

from __future__ import annotations

import getpass
import os
import shutil
import subprocess
from argparse import Namespace
from pathlib import Path

from sim.ros2.group import argument
from sim.ros2.new_package import NewPackage
from sim.ros2.system import Voice, Wrong
from sim.ros2.verbs.pkg import pkg

APACHE = Path(__file__).parents[3] / "LICENSE"  # the course's own
LICENSE_FILES = {"Apache-2.0": APACHE}
BUILD_TYPES = ("ament_cmake", "ament_python")


@pkg.verb(
    "create",
    argument("package_name", help="The package name"),
    argument(
        "--package-format",
        "--package_format",
        type=int,
        default=3,
        choices=[2, 3],
        help="The package.xml format.",
    ),
    argument(
        "--description",
        default="TODO: Package description",
        help="The description given in the package.xml",
    ),
    argument(
        "--license",
        default="TODO: License declaration",
        help="The license attached to this package; a LICENSE file is written for Apache-2.0",
    ),
    argument(
        "--destination-directory",
        default=os.curdir,
        help="Directory where to create the package directory",
    ),
    argument(
        "--build-type",
        default="ament_cmake",
        choices=BUILD_TYPES,
        help="The build type to process the package with",
    ),
    argument("--dependencies", nargs="+", default=[], help="list of dependencies"),
    argument("--maintainer-email", help="email address of the maintainer of this package"),
    argument("--maintainer-name", help="name of the maintainer of this package"),
    argument("--node-name", help="name of the empty executable"),
    argument("--library-name", help="name of the empty library; of ament_python alone"),
    alone=True,
)
def create(voice: Voice, asked: Namespace) -> None:
    """Create a new ROS 2 package."""
    package = _described(voice, asked)
    folder = os.path.join(asked.destination_directory, package.name)
    if os.path.exists(folder):
        raise Wrong(
            f"\nAborted!\nThe directory already exists: {folder}\nEither remove the directory or choose a "
            "different destination directory or package name"
        )
    _announce(voice, package, asked.destination_directory)
    try:
        _write(voice, package, folder)
    except OSError as error:
        raise Wrong(f"unable to create folder: {error.filename}: {error.strerror}") from None


def _described(voice: Voice, asked: Namespace) -> NewPackage:
    if asked.build_type == "ament_python" and asked.package_name == "test":
        raise Wrong(
            "Aborted since 'ament_python' packages can't be named 'test'. "
            "Please choose a different package name."
        )
    if asked.build_type == "ament_cmake" and asked.library_name:
        raise Wrong("--library-name makes a library in C++, which is not supported here: leave it out.")
    node = asked.node_name
    if node and node == asked.library_name:
        node = f"{node}_node"
        voice.say("[WARNING] node name can not be equal to the library name")
        voice.say(f"[WARNING] renaming node to {node}")
    maintainer = asked.maintainer_name or getpass.getuser()
    return NewPackage(
        name=asked.package_name,
        build_type=asked.build_type,
        description=asked.description,
        license=asked.license,
        maintainer=maintainer,
        email=asked.maintainer_email or _email() or f"{maintainer}@todo.todo",
        depends=tuple(asked.dependencies),
        format=asked.package_format,
        node=node,
        library=asked.library_name,
    )


def _email() -> str:
    """The user's address as git knows it, or nothing."""
    git = shutil.which("git")
    if git is None:
        return ""
    asked = subprocess.run([git, "config", "user.email"], stdout=subprocess.PIPE, text=True)
    return asked.stdout.strip()


def _announce(voice: Voice, package: NewPackage, destination: str) -> None:
    facts = {
        "package name": package.name,
        "destination directory": os.path.abspath(destination),
        "package format": package.format,
        "version": "0.0.0",
        "description": package.description,
        "maintainer": [f"{package.maintainer} <{package.email}>"],
        "licenses": [package.license],
        "build type": package.build_type,
        "dependencies": list(package.depends),
        "node_name": package.node,
        "library_name": package.library,
    }
    voice.say("going to create a new package")
    for name, value in facts.items():
        if value is not None:
            voice.say(f"{name}: {value}")


def _write(voice: Voice, package: NewPackage, folder: str) -> None:
    voice.say(f"creating folder {folder}")
    os.makedirs(folder)
    for path, text in package.files():
        place = os.path.join(folder, path)
        if path in (f"{package.name}/", "src/"):
            both = " and include" * (path == "src/")
            voice.say(f"creating source{both} folder")
        if path.endswith("/"):
            voice.say(f"creating folder {place.rstrip('/')}")
            os.makedirs(place)
        else:
            voice.say(f"creating {place}")
            Path(place).write_text(text, encoding="utf-8")
    _write_license(voice, package, Path(folder, "LICENSE"))


def _write_license(voice: Voice, package: NewPackage, file: Path) -> None:
    text = LICENSE_FILES.get(package.license)
    if text is not None:
        shutil.copyfile(text, file)
        return
    voice.say(
        f"\n[WARNING]: Unknown license '{package.license}'.  This has been set in the package.xml, but no "
        "LICENSE file has been created.\nIt is recommended to use one of the ament license identifiers:\n"
        + "\n".join(LICENSE_FILES)
    )
