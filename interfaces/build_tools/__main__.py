"""Build one package in a process of its own: python -m build_tools NAME SOURCE OUTPUT."""

import sys
from pathlib import Path

from build_tools.compile import compile_package
from build_tools.generate import Package, generate
from build_tools.toolchain import BuildError, require_compilers


def main(name: str, source: str, output: str) -> None:
    """Generate and compile the package NAME from SOURCE into OUTPUT, or stop with the reason."""
    package = Package(name, Path(source).resolve(), Path(output).resolve())
    try:
        require_compilers()
        compile_package(package, generate(package))
    except BuildError as error:
        sys.exit(str(error))


main(*sys.argv[1:])
