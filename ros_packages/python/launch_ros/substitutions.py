"""The substitutions for packages."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import NoReturn

from ament_index_python.packages import get_package_prefix, get_package_share_directory
from launch.launch_context import LaunchContext
from launch.substitution import SomeSubstitutionsType, Substitution, SubstitutionFailure
from launch.unsupported import refuse
from launch.utilities import (
    describe_substitutions,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)
from launch.yaml_frontend.substitutions import SUBSTITUTIONS

__all__ = [
    "ExecutableInPackage",
    "FindPackage",
    "FindPackagePrefix",
    "FindPackageShare",
]


class FindPackage(Substitution):
    """The folder of a package."""

    def __init__(self, package: SomeSubstitutionsType) -> None:
        self.__package = normalize_to_list_of_substitutions(package)

    @property
    def package(self) -> list[Substitution]:
        """The name of the package."""
        return self.__package

    def find(self, package_name: str) -> str:
        """The folder of the package with this name."""
        raise NotImplementedError

    def describe(self) -> str:
        """Work like `Substitution`."""
        return f"{type(self).__name__}(pkg={describe_substitutions(self.package)})"

    def perform(self, context: LaunchContext) -> str:
        """Work like `Substitution`. Raises PackageNotFoundError."""
        return self.find(perform_substitutions(context, self.package))


class FindPackagePrefix(FindPackage):
    """The folder that a package is installed in."""

    def find(self, package_name: str) -> str:
        """Work like `FindPackage`."""
        return get_package_prefix(package_name)


class FindPackageShare(FindPackage):
    """The folder with a package's data, such as its launch files."""

    def find(self, package_name: str) -> str:
        """Work like `FindPackage`."""
        return get_package_share_directory(package_name)


class ExecutableInPackage(FindPackagePrefix):
    """The path of a package's executable."""

    def __init__(self, executable: SomeSubstitutionsType, package: SomeSubstitutionsType) -> None:
        super().__init__(package)
        self.__executable = normalize_to_list_of_substitutions(executable)

    @property
    def executable(self) -> list[Substitution]:
        """The name of the executable."""
        return self.__executable

    def describe(self) -> str:
        """Work like `Substitution`."""
        package, executable = map(describe_substitutions, (self.package, self.executable))
        return f"ExecInPkg(pkg={package}, exec={executable})"

    def perform(self, context: LaunchContext) -> str:
        """Work like `Substitution`. Raises SubstitutionFailure if there is no such executable."""
        executable = perform_substitutions(context, self.executable)
        package = perform_substitutions(context, self.package)
        bundled = context.process_starter.find_bundled(package, executable)
        if bundled is not None:
            return bundled
        prefix = super().perform(context)
        folder = Path(prefix, "lib", package)
        if not folder.exists():
            raise SubstitutionFailure(
                f"package '{package}' found at '{prefix}', but libexec directory '{folder}' does not exist"
            )
        path = shutil.which(executable, path=str(folder))
        if path is None:
            raise SubstitutionFailure(
                f"executable '{executable}' not found on the libexec directory '{folder}' "
            )
        return path


SUBSTITUTIONS["find-pkg-share"] = (1, 1, FindPackageShare)
SUBSTITUTIONS["find-pkg-prefix"] = (1, 1, FindPackagePrefix)
SUBSTITUTIONS["exec-in-pkg"] = (2, 2, ExecutableInPackage)


def __getattr__(name: str) -> NoReturn:
    refuse(__name__, name, __all__)
