"""ros2 pkg create: the files of a new package."""

from __future__ import annotations

import getpass
import os
import shutil
import subprocess
from argparse import Namespace
from pathlib import Path

from sim.course_folders import FILES
from sim.ros2.group import argument
from sim.ros2.new_package import NewPackage
from sim.ros2.system import CliError, Output
from sim.ros2.verbs.pkg import pkg

APACHE = FILES / "LICENSE"  # the course's own
LICENSE_FILES = {"Apache-2.0": APACHE}
BUILD_TYPES = ("ament_cmake", "ament_python")


class Disk:
    """The place where a new package is written."""

    def absolute(self, folder: str) -> str:
        """Return the absolute path."""
        return os.path.abspath(folder)

    def exists(self, folder: str) -> bool:
        """Return whether there is already something of this name."""
        return os.path.exists(folder)

    def write(self, folder: str, path: str, text: str | None) -> None:
        """Write a file of the package in this folder; without a text make a folder."""
        target = Path(folder, path)
        if text is None:
            target.mkdir(parents=True)
        else:
            target.write_text(text, encoding="utf-8")

    def copy(self, source: Path, folder: str, path: str) -> None:
        """Copy a file of the course into the package in this folder."""
        shutil.copyfile(source, Path(folder, path))


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
    without_system=True,
)
def create(output: Output, options: Namespace) -> None:
    """Create a new ROS 2 package."""
    create_package(output, options, Disk())


def create_package(output: Output, options: Namespace, disk: Disk) -> None:
    """Create it there. Raises CliError."""
    package = _new_package(output, options)
    folder = os.path.join(options.destination_directory, package.name)
    if disk.exists(folder):
        raise CliError(
            f"\nAborted!\nThe directory already exists: {folder}\nEither remove the directory or choose a "
            "different destination directory or package name"
        )
    _announce(output, package, disk.absolute(options.destination_directory))
    try:
        _write(output, package, folder, disk)
    except OSError as error:
        raise CliError(f"unable to create folder: {error.filename}: {error.strerror}") from None


def _new_package(output: Output, options: Namespace) -> NewPackage:
    if options.build_type == "ament_python" and options.package_name == "test":
        raise CliError(
            "Aborted since 'ament_python' packages can't be named 'test'. "
            "Please choose a different package name."
        )
    if options.build_type == "ament_cmake" and options.library_name:
        raise CliError("--library-name makes a library in C++, which is not supported here: leave it out.")
    node = options.node_name
    if node and node == options.library_name:
        node = f"{node}_node"
        output.print_line("[WARNING] node name can not be equal to the library name")
        output.print_line(f"[WARNING] renaming node to {node}")
    maintainer = options.maintainer_name or getpass.getuser()
    return NewPackage(
        name=options.package_name,
        build_type=options.build_type,
        description=options.description,
        license=options.license,
        maintainer=maintainer,
        email=options.maintainer_email or _email() or f"{maintainer}@todo.todo",
        depends=tuple(options.dependencies),
        format=options.package_format,
        node=node,
        library=options.library_name,
    )


def _email() -> str:
    """The email address in git's configuration, or an empty text."""
    git = shutil.which("git")
    if git is None:
        return ""
    done = subprocess.run([git, "config", "user.email"], stdout=subprocess.PIPE, text=True)
    return done.stdout.strip()


def _announce(output: Output, package: NewPackage, destination: str) -> None:
    facts = {
        "package name": package.name,
        "destination directory": destination,
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
    output.print_line("going to create a new package")
    for name, value in facts.items():
        if value is not None:
            output.print_line(f"{name}: {value}")


def _write(output: Output, package: NewPackage, folder: str, disk: Disk) -> None:
    output.print_line(f"creating folder {folder}")
    disk.write(folder, "", None)
    for path, text in package.files():
        target = os.path.join(folder, path)
        if path in (f"{package.name}/", "src/"):
            both = " and include" * (path == "src/")
            output.print_line(f"creating source{both} folder")
        if path.endswith("/"):
            output.print_line(f"creating folder {target.rstrip('/')}")
            disk.write(folder, path, None)
        else:
            output.print_line(f"creating {target}")
            disk.write(folder, path, text)
    source = LICENSE_FILES.get(package.license)
    if source is not None:
        disk.copy(source, folder, "LICENSE")
        return
    output.print_line(
        f"\n[WARNING]: Unknown license '{package.license}'.  This has been set in the package.xml, but no "
        "LICENSE file has been created.\nIt is recommended to use one of the ament license identifiers:\n"
        + "\n".join(LICENSE_FILES)
    )
