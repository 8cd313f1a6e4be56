# SPDX-License-Identifier: MIT
"""Compiles the shared libraries with CMake and puts them into the package. All else stands in pyproject.toml.

In the repository the C++ sources are two folders up; a source distribution has them in cpp/. TSPACE_CMAKE_FOLDER names the
folder that CMake builds in, so that a second build compiles what changed.
"""

import os
import re
import shutil
import subprocess
from pathlib import Path

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py
from setuptools.command.sdist import sdist

try:
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:
    from wheel.bdist_wheel import bdist_wheel

HERE = Path(__file__).resolve().parent
IN_REPOSITORY = not (HERE / "cpp").exists()
SOURCES = HERE.parent.parent if IN_REPOSITORY else HERE / "cpp"
WORK = SOURCES / "build" / "python" if IN_REPOSITORY else HERE / "build"
# What CMake needs for the libraries alone.
SOURCE_NAMES = ["CMakeLists.txt", "LICENSE", "cmake", "include", "src"]
LIBRARIES = {"tspace_shared": "libtspace.so.0"}


def version():
    text = (SOURCES / "CMakeLists.txt").read_text()
    return re.search(r"project\(tspace VERSION ([0-9.]+)", text).group(1)


def compile_libraries(folder):
    """Returns the files of the shared libraries."""
    generator = ["-G", "Ninja"] if shutil.which("ninja") else []
    parts = [f"-DTSPACE_BUILD_{part}=OFF" for part in ("ASSET", "TOOL", "TESTS", "EXAMPLES")]
    configure = ["cmake", "-S", SOURCES, "-B", folder, *generator, *parts]
    configure += ["-DCMAKE_BUILD_TYPE=Release", "-DTSPACE_BUILD_SHARED=ON", "-DTSPACE_BATCHES=ON"]
    # The C++ library goes inside: the wheel then needs the C library alone.
    configure += ["-DCMAKE_SHARED_LINKER_FLAGS=-static-libstdc++ -static-libgcc -Wl,--strip-debug"]
    jobs = str(os.cpu_count() or 1)
    subprocess.run(configure, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", folder, "-j", jobs, "--target", *LIBRARIES], check=True)
    return [folder / name for name in LIBRARIES.values()]


class BuildWithLibraries(build_py):
    def run(self):
        super().run()
        package = Path(self.build_lib) / "tspace"
        (package / "_lib").mkdir(parents=True, exist_ok=True)
        folder = Path(os.environ.get("TSPACE_CMAKE_FOLDER") or WORK / "cmake").resolve()
        for library in compile_libraries(folder):
            shutil.copyfile(library, package / "_lib" / library.name)
        shutil.copyfile(SOURCES / "LICENSE", package / "LICENSE")


class WheelForAllPythons(bdist_wheel):
    """No Python API is used: one wheel for all versions of Python 3."""

    def get_tag(self):
        return "py3", "none", super().get_tag()[2]


class SourcesWithCpp(sdist):
    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, files)
        for name in SOURCE_NAMES:
            source, target = SOURCES / name, Path(base_dir) / "cpp" / name
            if source.is_dir():
                shutil.copytree(source, target)
            else:
                target.parent.mkdir(exist_ok=True)
                shutil.copyfile(source, target)


class Compiled(Distribution):
    def has_ext_modules(self):
        return True


WORK.mkdir(parents=True, exist_ok=True)
setup(
    version=version(),
    package_dir={"": "src"},
    packages=["tspace"],
    package_data={"tspace": ["py.typed"]},
    distclass=Compiled,
    cmdclass={"build_py": BuildWithLibraries, "bdist_wheel": WheelForAllPythons, "sdist": SourcesWithCpp},
    options={"build": {"build_base": str(WORK / "setuptools")}, "egg_info": {"egg_base": str(WORK)}},
)
