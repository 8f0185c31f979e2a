"""Build all packages of a folder, in the alphabet's order: python -m build_tools DEFINITIONS OUTPUT"""

import gc
import sys
import traceback
from pathlib import Path

from build_tools.compile import compile_package
from build_tools.generate import Package, generate
from build_tools.toolchain import BuildError, require_compilers


def main(definitions: str, output: str) -> None:
    """Generate and compile each package of the folder DEFINITIONS into OUTPUT, or stop with the reason."""
    # What is read is kept to the end: looking through it for garbage takes a tenth of the time.
    gc.disable()
    for source in sorted(Path(definitions).resolve().iterdir()):
        package = Package(source.name, source, Path(output).resolve())
        try:
            require_compilers()
            compile_package(package, generate(package))
        except Exception as error:
            # The generators tell of a definition's mistakes by errors of many types.
            reason = error if isinstance(error, BuildError) else traceback.format_exc()
            sys.exit(
                f"{reason}\nThe interface package {source.name} could not be built; the reason is above."
            )


main(*sys.argv[1:])
