#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs a recipe of cmake/packaging without its package system, and uses what it has made.

recipes.py vcpkg|conan|spack SOURCE WORK PREFIX VERSION COMPILER FLAGS

What the recipe calls is stood in for by the few lines below and by vcpkg_functions.cmake, which do what the
documentation of the three systems says that their functions do. So this finds a path, a name, an option or a version
that is wrong, and a file that is missing; it does not find what only the real systems check. PREFIX is an install of
the same checkout.
"""
import fnmatch
import importlib.util
import json
import pathlib
import re
import shutil
import subprocess
import sys
import types

PROGRAM = """#include <tsubu/core/vec.hpp>
#include <tsubu/version.hpp>
static_assert(TSUBU_VERSION == {});
int main() {{ return tsubu::vec<3, double>{{}}[0] == 0 ? 0 : 1; }}
"""


def expect(holds, sentence):
    if not holds:
        sys.exit(f"recipes.py: {sentence}")


def run(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    said = done.stdout + done.stderr
    expect(done.returncode == 0, f"{' '.join(map(str, command))}\n{said}")
    expect("not used by the project" not in said, f"an option that CMakeLists.txt does not have:\n{said}")
    return said


class Package:
    """What a recipe is to make: the same headers as the install, and a package that a consumer can use."""

    def __init__(self, source, work, prefix, version, compiler, flags):
        self.source, self.work, self.prefix = pathlib.Path(source), pathlib.Path(work), pathlib.Path(prefix)
        self.version, self.compiler, self.flags = version, compiler, flags
        shutil.rmtree(self.work, ignore_errors=True)
        self.made = self.work / "made"
        self.work.mkdir(parents=True)
        parts = {p.stem.removeprefix("tsubu-") for p in (self.prefix / "share/cmake/tsubu").glob("tsubu-*.cmake")}
        self.components = parts - {"core", "config", "config-version"}
        expect(self.components == {"mpi", "hdf5"}, f"the install has the components {self.components}")
        major, minor, patch = map(int, version.split("."))
        self.program = self.work / "main.cpp"
        self.program.write_text(PROGRAM.format(major * 10000 + minor * 100 + patch))

    def check_headers(self):
        def tree(root):
            return {p.relative_to(root): p.read_bytes() for p in root.rglob("*") if p.is_file()}
        expect(tree(self.made / "include") == tree(self.prefix / "include"),
               "the headers are not those that cmake --install installs")

    def use_by_cmake(self):
        mine = self.work / "mine"
        shutil.copytree(self.source / "tests/package/find_package", mine)
        shutil.copy(self.program, mine)
        run("cmake", "-S", mine, "-B", mine / "build", f"-DCMAKE_CXX_COMPILER={self.compiler}",
            f"-DCMAKE_CXX_FLAGS={self.flags}", f"-DCMAKE_PREFIX_PATH={self.made}")
        run("cmake", "--build", mine / "build")
        run(mine / "build/mine")

    def use_by_compiler(self, folders):
        run(self.compiler, "-std=c++20", *self.flags.split(), *(f"-I{f}" for f in folders), self.program, "-o",
            self.work / "mine")
        run(self.work / "mine")


def stand_in(name, **contents):
    module = sys.modules.setdefault(name, types.ModuleType(name))
    vars(module).update(contents)


def load_recipe(path):
    spec = importlib.util.spec_from_file_location("recipe", path)
    module = importlib.util.module_from_spec(spec)
    sys.dont_write_bytecode = True
    spec.loader.exec_module(module)
    return module


def vcpkg(package):
    port = package.source / "cmake/packaging/vcpkg"
    manifest = json.loads((port / "vcpkg.json").read_text())
    expect(manifest["version-semver"] == package.version,
           f"vcpkg.json is of version {manifest['version-semver']}, version.hpp of {package.version}")
    expect(set(manifest["features"]) == package.components, f"features {set(manifest['features'])}")
    run("cmake", f"-DPORT={manifest['name']}", f"-DCURRENT_PACKAGES_DIR={package.made}",
        f"-DCURRENT_BUILDTREES_DIR={package.work}", f"-DPORTFILE={port / 'portfile.cmake'}",
        f"-DCOMPILER={package.compiler}", "-P", pathlib.Path(__file__).with_name("vcpkg_functions.cmake"))
    package.check_headers()
    package.use_by_cmake()


class Settings(dict):
    get_safe = dict.get
    __getattr__ = dict.__getitem__


class CppInfo:
    """cpp_info, and each of its components."""

    def __init__(self):
        self.properties, self.components, self.requires = {}, Components(), []
        self.includedirs, self.libdirs, self.bindirs = ["include"], ["lib"], ["bin"]

    def set_property(self, name, value):
        self.properties[name] = value


class Components(dict):
    def __missing__(self, name):
        return self.setdefault(name, CppInfo())


def conan(package):
    def copy(_, pattern, src, dst):
        # As Conan's: * stands for any characters, slashes too.
        found = [p for p in pathlib.Path(src).rglob("*")
                 if p.is_file() and fnmatch.fnmatch(str(p.relative_to(src)), pattern)]
        expect(found, f"{pattern} matches nothing in {src}")
        for p in found:
            to = pathlib.Path(dst) / p.relative_to(src)
            to.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(p, to)

    asked = {}
    stand_in("conan", ConanFile=type("ConanFile", (), {
        "requires": lambda self, what, **traits: asked.setdefault(what.split("/")[0], traits)}))
    stand_in("conan.tools")
    stand_in("conan.tools.files", copy=copy, load=lambda _, path: pathlib.Path(path).read_text())
    stand_in("conan.tools.build", check_min_cppstd=lambda _, standard: expect(standard == 20, "C++20 is needed"))
    folder = package.source / "cmake/packaging/conan"
    recipe = load_recipe(folder / "conanfile.py").TsubuConan()
    expect(set(recipe.options) == package.components, f"options {set(recipe.options)}")

    recipe.recipe_folder, recipe.export_sources_folder = str(folder), str(package.work / "exported")
    recipe.source_folder, recipe.package_folder = recipe.export_sources_folder, str(package.made)
    recipe.options = Settings(dict.fromkeys(recipe.options, True))
    recipe.info = types.SimpleNamespace(clear=lambda: None)
    recipe.cpp_info = CppInfo()
    for step in ("set_version", "export_sources", "requirements", "validate", "package_id", "package", "package_info"):
        getattr(recipe, step)()
    expect(recipe.version == package.version, f"the recipe is of version {recipe.version}")
    package.check_headers()
    expect((package.made / "licenses/LICENSE").is_file(), "no licence in the package")
    made = recipe.cpp_info.components
    targets = {part.properties["cmake_target_name"] for part in made.values()}
    expect(targets == {"tsubu::tsubu", "tsubu::mpi", "tsubu::hdf5"}, f"targets {targets}")
    expect(recipe.cpp_info.properties["cmake_target_name"] not in targets, "the whole is called as a part of it")
    needed = {word.split("::")[0] for part in made.values() for word in part.requires if "::" in word}
    expect(needed == set(asked), f"the targets need {needed}, the package requires {set(asked)}")
    expect(all(traits.get("transitive_headers") for traits in asked.values()), "users would miss headers")
    expect(not any(part.libdirs or part.bindirs for part in made.values()), "headers only")
    package.use_by_compiler([package.made / d for d in made["core"].includedirs])


def spack(package):
    said = {}

    def directive(name):
        return lambda *words, **options: said.setdefault(name, []).append((words, options))

    class CMakePackage:
        def define(self, name, value):
            return f"-D{name}:BOOL={'ON' if value else 'OFF'}"

    directives = {n: directive(n) for n in ("license", "version", "variant", "depends_on", "conflicts")}
    stand_in("spack")
    stand_in("spack.package", __all__=list(directives), **directives)
    for parent in ("spack_repo", "spack_repo.builtin", "spack_repo.builtin.build_systems"):
        stand_in(parent)
    stand_in("spack_repo.builtin.build_systems.cmake", CMakePackage=CMakePackage)
    repository = package.source / "cmake/packaging/spack/spack_repo/tsubu"
    settings = (repository / "repo.yaml").read_text()
    expect(re.search(rf"^  namespace: {repository.name}$", settings, re.M), "the namespace is not the folder's name")
    recipe = load_recipe(repository / "packages/tsubu/package.py").Tsubu
    expect(pathlib.Path(recipe.git.removeprefix("file://")) == package.source.resolve(),
           f"the recipe takes {recipe.git}, not the checkout that it lies in")
    variants = {words[0] for words, _ in said["variant"]}
    expect(variants == package.components, f"variants {variants}")
    brought = {options["when"][1:]: words[0].split("@")[0]
               for words, options in said["depends_on"] if "when" in options}
    expect(brought == {name: name for name in variants}, f"what the variants bring: {brought}")
    wanted = [words[0] for words, _ in said["depends_on"] if words[0].startswith("cmake@")]
    least = re.search(r"cmake_minimum_required\(VERSION ([0-9.]+)\.\.\.",
                      (package.source / "CMakeLists.txt").read_text())
    expect(wanted == [f"cmake@{least[1]}:"], f"wants {wanted}, CMakeLists.txt {least[1]}")
    build = package.work / "build"
    run("cmake", "-S", package.source, "-B", build, f"-DCMAKE_CXX_COMPILER={package.compiler}",
        f"-DCMAKE_INSTALL_PREFIX={package.made}", *recipe().cmake_args())
    run("cmake", "--install", build)
    package.check_headers()
    package.use_by_cmake()


if __name__ == "__main__":
    if len(sys.argv) != 8 or sys.argv[1] not in ("vcpkg", "conan", "spack"):
        sys.exit(__doc__)
    {"vcpkg": vcpkg, "conan": conan, "spack": spack}[sys.argv[1]](Package(*sys.argv[2:]))
    print(f"{sys.argv[1]}: a package of tsubu {sys.argv[5]} was made and used")
