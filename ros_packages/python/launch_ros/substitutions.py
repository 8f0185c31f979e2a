"""Where packages are, as texts that are known only when a launch file runs."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import NoReturn

from ament_index_python.packages import get_package_prefix, get_package_share_directory
from launch import LaunchContext, SomeSubstitutionsType, Substitution
from launch.substitutions import SubstitutionFailure
from launch.unsupported import refuse
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

__all__ = [
    "ExecutableInPackage",
    "FindPackage",
    "FindPackagePrefix",
    "FindPackageShare",
]


class FindPackage(Substitution):
    """Where a package is."""

    def __init__(self, package: SomeSubstitutionsType) -> None:
        self.__package = normalize_to_list_of_substitutions(package)

    @property
    def package(self) -> list[Substitution]:
        """Its name."""
        return self.__package

    def find(self, package_name: str) -> str:
        """The folder of the package of this name."""
        raise NotImplementedError

    def describe(self) -> str:
        """As `Substitution`."""
        return f"{type(self).__name__}(pkg={' + '.join(sub.describe() for sub in self.package)})"

    def perform(self, context: LaunchContext) -> str:
        """As `Substitution`. Raises PackageNotFoundError."""
        return self.find(perform_substitutions(context, self.package))


class FindPackagePrefix(FindPackage):
    """The folder into which a package was installed."""

    def find(self, package_name: str) -> str:
        """As `FindPackage`."""
        return get_package_prefix(package_name)


class FindPackageShare(FindPackage):
    """The folder with a package's own files, such as its launch files."""

    def find(self, package_name: str) -> str:
        """As `FindPackage`."""
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
        """As `Substitution`."""
        package, executable = (
            " + ".join(sub.describe() for sub in part) for part in (self.package, self.executable)
        )
        return f"ExecInPkg(pkg={package}, exec={executable})"

    def perform(self, context: LaunchContext) -> str:
        """As `Substitution`. Raises SubstitutionFailure for an executable that isn't there."""
        executable = perform_substitutions(context, self.executable)
        package = perform_substitutions(context, self.package)
        elsewhere = context.processes.find(package, executable)
        if elsewhere is not None:
            return elsewhere
        prefix = super().perform(context)
        folder = Path(prefix, "lib", package)
        if not folder.exists():
            raise SubstitutionFailure(
                f"package '{package}' found at '{prefix}', but libexec directory '{folder}' does not exist"
            )
        found = shutil.which(executable, path=str(folder))
        if found is None:
            raise SubstitutionFailure(
                f"executable '{executable}' not found on the libexec directory '{folder}' "
            )
        return found


def __getattr__(name: str) -> NoReturn:
    refuse(__name__, name, __all__)
