# SPDX-License-Identifier: MIT
"""conan create cmake/packaging/conan"""
import os
import re

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load


class TsubuConan(ConanFile):
    name = "tsubu"
    license = "MIT"
    description = "Header-only C++20 data layer of particle codes"
    package_type = "header-library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"mpi": [True, False], "hdf5": [True, False]}
    default_options = {"mpi": False, "hdf5": False}
    no_copy_source = True

    @property
    def _root(self):
        return os.path.normpath(os.path.join(self.recipe_folder, "..", "..", ".."))

    def set_version(self):
        number = int(re.search(r"define TSUBU_VERSION (\d+)",
                               load(self, os.path.join(self._root, "include", "tsubu", "version.hpp")))[1])
        self.version = f"{number // 10000}.{number // 100 % 100}.{number % 100}"

    def export_sources(self):
        for what in ("CMakeLists.txt", "LICENSE", "cmake/*", "include/*"):
            copy(self, what, self._root, self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def requirements(self):
        if self.options.mpi:
            self.requires("openmpi/[>=4.1 <6]")
        if self.options.hdf5:
            self.requires("hdf5/[>=1.10.2 <2]")

    def validate(self):
        check_min_cppstd(self, 20)

    def package_id(self):
        self.info.clear()

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables.update(TSUBU_BUILD_TESTS=False, TSUBU_BUILD_BENCH=False, TSUBU_INSTALL=True)
        toolchain.generate()

    def build(self):
        CMake(self).configure()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))

    def package_info(self):
        self.cpp_info.bindirs = []
        self.cpp_info.libdirs = []
        self.cpp_info.set_property("cmake_file_name", "tsubu")
        core = self.cpp_info.components["core"]
        core.set_property("cmake_target_name", "tsubu::tsubu")
        core.set_property("pkg_config_name", "tsubu")
        for name, package in (("mpi", "openmpi"), ("hdf5", "hdf5")):
            if self.options.get_safe(name):
                part = self.cpp_info.components[name]
                part.set_property("cmake_target_name", f"tsubu::{name}")
                part.requires = ["core", f"{package}::{package}"]
