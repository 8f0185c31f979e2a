"""The files of a new package, with the names and structure of the official `ros2 pkg create`."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from xml.sax.saxutils import escape, quoteattr

TESTS = {
    "ament_cmake": ("ament_lint_auto", "ament_lint_common"),
    "ament_python": ("ament_copyright", "ament_flake8", "ament_pep257", "python3-pytest"),
}
LINTERS = {  # what a test of a new package calls, and the message if it fails
    "copyright": ("main(argv=['.', 'test'])", "a file has no copyright and license at its top"),
    "flake8": ("main(argv=[])", "the code's style is not the one that flake8 asks for"),
    "pep257": ("main(argv=['.', 'test'])", "a docstring is not as PEP 257 asks for"),
}


@dataclass(frozen=True)
class NewPackage:
    """The description of a package to be created. The names are those of package.xml."""

    name: str
    build_type: str  # ament_python or ament_cmake
    description: str
    license: str
    maintainer: str
    email: str
    depends: tuple[str, ...] = ()
    format: int = 3
    node: str | None = None
    library: str | None = None

    @property
    def test_depends(self) -> tuple[str, ...]:
        """The dependencies of its tests."""
        return TESTS[self.build_type]

    def files(self) -> Iterator[tuple[str, str]]:
        """Yield path and text of each file in the package's folder. A path that ends with / is a folder."""
        yield "package.xml", _package_xml(self)
        yield from _python(self) if self.build_type == "ament_python" else _cmake(self)


def _package_xml(package: NewPackage) -> str:
    schema = f"http://download.ros.org/schema/package_format{package.format}.xsd"
    tool = ["ament_cmake"] if package.build_type == "ament_cmake" else []
    groups = [
        [f"  <{tag}>{escape(name)}</{tag}>\n" for name in names]
        for tag, names in (
            ("buildtool_depend", tool),
            ("depend", package.depends),
            ("test_depend", package.test_depends),
        )
    ]
    return (
        '<?xml version="1.0"?>\n'
        f'<?xml-model href="{schema}" schematypens="http://www.w3.org/2001/XMLSchema"?>\n'
        f'<package format="{package.format}">\n'
        f"  <name>{escape(package.name)}</name>\n"
        "  <version>0.0.0</version>\n"
        f"  <description>{escape(package.description)}</description>\n"
        f"  <maintainer email={quoteattr(package.email)}>{escape(package.maintainer)}</maintainer>\n"
        f"  <license>{escape(package.license)}</license>\n\n"
        + "\n".join("".join(lines) for lines in groups if lines)
        + f"\n  <export>\n    <build_type>{package.build_type}</build_type>\n  </export>\n</package>\n"
    )


def _python(package: NewPackage) -> Iterator[tuple[str, str]]:
    yield f"{package.name}/", ""
    yield "setup.py", _setup_py(package)
    folder = f"$base/lib/{package.name}"
    yield "setup.cfg", f"[develop]\nscript_dir={folder}\n[install]\ninstall_scripts={folder}\n"
    yield "resource/", ""
    yield f"resource/{package.name}", ""
    yield f"{package.name}/__init__.py", ""
    yield "test/", ""
    for linter, (call, what) in LINTERS.items():
        yield f"test/test_{linter}.py", _linter_test(linter, call, what)
    if package.node:
        yield f"{package.name}/{package.node}.py", _node(package.name)
    if package.library:
        yield f"{package.name}/{package.library}/", ""
        yield f"{package.name}/{package.library}/__init__.py", ""


def _setup_py(package: NewPackage) -> str:
    entry = f"{package.node} = {package.name}.{package.node}:main"
    return (
        "from setuptools import find_packages, setup\n\n"
        f"package_name = {package.name!r}\n\n"
        "setup(\n"
        "    name=package_name,\n"
        "    version='0.0.0',\n"
        "    packages=find_packages(exclude=['test']),\n"
        "    data_files=[\n"
        "        ('share/ament_index/resource_index/packages',\n"
        "            ['resource/' + package_name]),\n"
        "        ('share/' + package_name, ['package.xml']),\n"
        "    ],\n"
        "    install_requires=['setuptools'],\n"
        "    zip_safe=True,\n"
        f"    maintainer={package.maintainer!r},\n"
        f"    maintainer_email={package.email!r},\n"
        f"    description={package.description!r},\n"
        f"    license={package.license!r},\n"
        "    extras_require={'test': ['pytest']},\n"
        "    entry_points={\n"
        "        'console_scripts': [\n"
        + (f"            {entry!r},\n" if package.node else "")
        + "        ],\n"
        "    },\n"
        ")\n"
    )


def _node(package: str) -> str:
    return f"def main():\n    print('Hi from {package}.')\n\n\nif __name__ == '__main__':\n    main()\n"


def _linter_test(linter: str, call: str, what: str) -> str:
    skip = "@pytest.mark.skip(reason='the files of a new package name no owner')\n" * (linter == "copyright")
    return (
        "import pytest\n\n\n"
        f"{skip}"
        f"@pytest.mark.{linter}\n"
        "@pytest.mark.linter\n"
        f"def test_{linter}():\n"
        f"    linter = pytest.importorskip('ament_{linter}.main')\n"
        f"    assert linter.{call} == 0, {what!r}\n"
    )


def _cmake(package: NewPackage) -> Iterator[tuple[str, str]]:
    yield "src/", ""
    yield f"include/{package.name}/", ""
    yield "CMakeLists.txt", _cmakelists(package)
    if package.node:
        yield f"src/{package.node}.cpp", _cpp_node(package.name)


def _cmakelists(package: NewPackage) -> str:
    found = [f"find_package({name} REQUIRED)\n" for name in package.depends]
    later = "# one such line for each package that this one needs:\n# find_package(<dependency> REQUIRED)\n"
    return (
        "cmake_minimum_required(VERSION 3.10)\n"
        f"project({package.name})\n\n"
        'if(CMAKE_COMPILER_IS_GNUCXX OR CMAKE_CXX_COMPILER_ID MATCHES "Clang")\n'
        "  add_compile_options(-Wall -Wextra -Wpedantic)\n"
        "endif()\n\n"
        "# find dependencies\n"
        "find_package(ament_cmake REQUIRED)\n"
        + ("".join(found) or later)
        + (_cpp_target(package) if package.node else "")
        + "\nif(BUILD_TESTING)\n"
        "  # the linters of a whole ROS installation, where there is one\n"
        "  find_package(ament_lint_auto QUIET)\n"
        "  if(ament_lint_auto_FOUND)\n"
        "    # until each file names its owner and its license\n"
        "    set(ament_cmake_copyright_FOUND TRUE)\n"
        "    # until the package is in a git repository\n"
        "    set(ament_cmake_cpplint_FOUND TRUE)\n"
        "    ament_lint_auto_find_test_dependencies()\n"
        "  endif()\n"
        "endif()\n\n"
        "ament_package()\n"
    )


def _cpp_target(package: NewPackage) -> str:
    used = "".join(f'\n  "{name}"' for name in package.depends)
    return (
        f"\nadd_executable({package.node} src/{package.node}.cpp)\n"
        f"target_include_directories({package.node} PUBLIC\n"
        "  $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>\n"
        "  $<INSTALL_INTERFACE:include/${PROJECT_NAME}>)\n"
        f"target_compile_features({package.node} PUBLIC c_std_99 cxx_std_17)\n"
        + (f"ament_target_dependencies(\n  {package.node}{used}\n)\n" if used else "")
        + f"\ninstall(TARGETS {package.node}\n  DESTINATION lib/${{PROJECT_NAME}})\n"
    )


def _cpp_node(package: str) -> str:
    return (
        "#include <cstdio>\n\n"
        "int main()\n{\n"
        f'  std::printf("hello world {package} package\\n");\n'
        "  return 0;\n}\n"
    )
