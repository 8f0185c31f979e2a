"""Build all packages of a folder in alphabetical order: python -m build_tools DEFINITIONS OUTPUT"""

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
    # Nearly everything is needed until the end, and garbage collection would take a tenth of the time.
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
    """Build packages, each of which may use earlier ones. Earlier ones are compiled while one is generated.

    Raises:
        BuildError: see generate() and link(); the message ends with the package's name.
    """
    started: list[tuple[Package, list[str], list[Future[Path]]]] = []
    with _compilers() as pool:
        for package in packages:
            for earlier, _, compiled in started:
                with _naming(earlier):
                    [unit.result() for unit in compiled if unit.done()]  # raises the error of one that failed
            with _naming(package):
                started.append((package, generate(package), compiling(package, pool)))
        for package, dependencies, compiled in started:
            with _naming(package):
                link(package, dependencies, compiled)


@contextmanager
def _compilers() -> Iterator[Executor]:
    """A thread per core. After an error or Ctrl-C, running compilations finish and no others begin."""
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        try:
            yield pool
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise


@contextmanager
def _naming(package: Package) -> Iterator[None]:
    try:
        yield
    except (Exception, SystemExit) as error:
        # The generators report mistakes in a definition by errors of many types, or print them and exit.
        reason = error if isinstance(error, (BuildError, SystemExit)) else traceback.format_exc()
        summary = f"The interface package {package.name} could not be built; the reason is above."
        raise BuildError(f"{reason}\n{summary}") from None


main(*sys.argv[1:])
