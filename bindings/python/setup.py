# SPDX-License-Identifier: MIT
"""Compiles the shared libraries with CMake and adds them to the package. Other settings are in pyproject.toml.

In the repository the C++ sources are two folders up; a source distribution has them in cpp/. TSPACE_CMAKE_FOLDER is the
build folder of CMake, for incremental builds; TSPACE_LIBRARIES is a folder with built libraries, so that nothing is
compiled.
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
# Sources that CMake needs for the libraries.
SOURCE_NAMES = ["CMakeLists.txt", "LICENSE", "cmake", "include", "src"]
LIBRARIES = {"tspace_shared": "libtspace.so.0", "tspace_files_shared": "libtspace-files.so.0"}
# Packages linked into the libraries: headers and static libraries.
LINKED_PACKAGES = ["libdraco-dev", "nlohmann-json3-dev", "libtinyobjloader-dev", "libxxhash-dev"]
# Libraries of every system with Python; all others are added to the wheel.
SYSTEM = re.compile(r"(ld-linux.*|lib(c|m|dl|rt|pthread|gcc_s|stdc\+\+))\.so\.[0-9]+$")


def version():
    text = (SOURCES / "CMakeLists.txt").read_text()
    return re.search(r"project\(tspace VERSION ([0-9.]+)", text).group(1)


def project_urls():
    """Returns the URLs of the repository that TSPACE_URL names: https://github.com/OWNER/tspace."""
    url = os.environ.get("TSPACE_URL")
    pages = {"Homepage": "", "Documentation": "/tree/main/docs", "Changes": "/blob/main/CHANGELOG.md", "Issues": "/issues"}
    return {name: url + path for name, path in pages.items()} if url else {}


def compile_libraries(folder):
    """Returns the paths of the shared libraries."""
    generator = ["-G", "Ninja"] if shutil.which("ninja") else []
    parts = [f"-DTSPACE_BUILD_{part}=OFF" for part in ("TOOL", "TESTS", "EXAMPLES")]
    configure = ["cmake", "-S", SOURCES, "-B", folder, *generator, *parts]
    configure += ["-DCMAKE_BUILD_TYPE=Release", "-DTSPACE_BUILD_SHARED=ON", "-DTSPACE_BATCHES=ON"]
    # RPATH instead of RUNPATH, because it also applies to indirect dependencies.
    flags = "-static-libstdc++ -static-libgcc -Wl,--strip-debug -Wl,--disable-new-dtags"
    configure += [f"-DCMAKE_SHARED_LINKER_FLAGS={flags}", "-DCMAKE_INSTALL_RPATH=$ORIGIN"]
    configure += ["-DCMAKE_BUILD_WITH_INSTALL_RPATH=ON"]
    jobs = str(os.cpu_count() or 1)
    subprocess.run(configure, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", folder, "-j", jobs, "--target", *LIBRARIES], check=True)
    return [folder / name for name in LIBRARIES.values()]


def bundled(library):
    """Returns the non-system libraries that this library needs, including indirect ones."""
    printed = subprocess.run(["ldd", library], check=True, capture_output=True, text=True).stdout
    found = re.findall(r"^\s*(\S+) => (/\S+)", printed, re.M)
    return [Path(path) for name, path in found if not SYSTEM.match(name) and name not in LIBRARIES.values()]


def copy_notices(libraries, folder):
    """Copies the licenses of the linked libraries from Debian's packages. On other systems nothing is copied."""
    if not shutil.which("dpkg-query"):
        return
    # Old packages list their files under /lib, although these are in /usr/lib.
    names = [str(library) for library in libraries] + [str(library).replace("/usr", "", 1) for library in libraries]
    owners = subprocess.run(["dpkg-query", "-S", *names], capture_output=True, text=True).stdout
    packages = set(re.findall(r"^([^:\s]+):", owners, re.M)) | set(LINKED_PACKAGES)
    folder.mkdir(exist_ok=True)
    for package in packages:
        notice = Path("/usr/share/doc") / package / "copyright"
        if notice.exists():
            shutil.copyfile(notice, folder / f"{package}.txt")


class BuildWithLibraries(build_py):
    def run(self):
        super().run()
        package = Path(self.build_lib) / "tspace"
        target = package / "_lib"
        shutil.rmtree(target, ignore_errors=True)
        target.mkdir(parents=True)
        folder = Path(os.environ.get("TSPACE_CMAKE_FOLDER") or WORK / "cmake").resolve()
        built = os.environ.get("TSPACE_LIBRARIES")
        libraries = [Path(built) / name for name in LIBRARIES.values()] if built else compile_libraries(folder)
        others = {path.name: path.resolve() for library in libraries for path in bundled(library)}
        for name, path in {**{library.name: library for library in libraries}, **others}.items():
            shutil.copyfile(path, target / name)
        copy_notices(list(others.values()), target / "notices")
        shutil.copyfile(SOURCES / "LICENSE", package / "LICENSE")
        # The wheel stores file permissions, which in the sources depend on the developer's umask.
        for path in [package, *package.rglob("*")]:
            path.chmod(0o755 if path.is_dir() else 0o644)


class WheelForAllPythons(bdist_wheel):
    """Tags the wheel for all versions of Python 3, because it does not use the Python C API."""

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
shutil.rmtree(WORK / "setuptools", ignore_errors=True)  # setuptools would keep deleted files
setup(
    version=version(),
    project_urls=project_urls(),
    package_dir={"": "src"},
    packages=["tspace"],
    package_data={"tspace": ["py.typed", "*.pyi"]},
    distclass=Compiled,
    cmdclass={"build_py": BuildWithLibraries, "bdist_wheel": WheelForAllPythons, "sdist": SourcesWithCpp},
    options={"build": {"build_base": str(WORK / "setuptools")}, "egg_info": {"egg_base": str(WORK)}},
)
