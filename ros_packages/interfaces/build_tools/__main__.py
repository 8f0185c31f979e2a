"""Build all packages of a folder, in the alphabet's order: python -m build_tools DEFINITIONS OUTPUT"""

import gc
import os
import sys
import traceback
from collections.abc import Iterable, Iterator
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path

from build_tools.compile import compiling, link
from build_tools.generate import Package, generate
from build_tools.toolchain import BuildError, require_compilers


def main(definitions: str, output: str) -> None:
    """Build each package of the folder DEFINITIONS into OUTPUT, or stop with the reason."""
    # What is read is kept to the end: looking through it for garbage takes a tenth of the time.
    gc.disable()
    sources = sorted(Path(definitions).resolve().iterdir())
    try:
        require_compilers()
        build(Package(source.name, source, Path(output).resolve()) for source in sources)
    except BuildError as error:
        sys.exit(str(error))
    except KeyboardInterrupt:
        sys.exit(130)


def build(packages: Iterable[Package]) -> None:
    """Build packages, each of which may use those before it: while one is written, those are compiled.

    Raises:
        BuildError: see generate() and link(); the message ends with the package's name.
    """
    started: list[tuple[Package, list[str], list[Future[Path]]]] = []
    with _compilers() as pool:
        for package in packages:
            for earlier, _, compiled in started:
                with _named(earlier):
                    [unit.result() for unit in compiled if unit.done()]  # one that failed is told of at once
            with _named(package):
                started.append((package, generate(package), compiling(package, pool)))
        for package, dependencies, compiled in started:
            with _named(package):
                link(package, dependencies, compiled)


@contextmanager
def _compilers() -> Iterator[Executor]:
    """As many as there are cores. After an error or Ctrl-C they end what they do, and begin nothing more."""
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        try:
            yield pool
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise


@contextmanager
def _named(package: Package) -> Iterator[None]:
    try:
        yield
    except (Exception, SystemExit) as error:
        # The generators tell of a definition's mistakes by errors of many types, or say it and exit.
        reason = error if isinstance(error, (BuildError, SystemExit)) else traceback.format_exc()
        said = f"The interface package {package.name} could not be built; the reason is above."
        raise BuildError(f"{reason}\n{said}") from None


main(*sys.argv[1:])
