# SPDX-License-Identifier: MIT
"""The package of the checkout that this file lies in: conan create cmake/packaging/conan -s compiler.cppstd=20"""
import os
import re

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.files import copy, load


class TsubuConan(ConanFile):
    name = "tsubu"
    description = "Header-only C++20 data layer of particle codes"
    license = "MIT"
    package_type = "header-library"
    settings = "os", "arch", "compiler", "build_type"
    # The headers are the same for all; an option brings the library that the target of its name needs.
    options = {"mpi": [True, False], "hdf5": [True, False]}
    default_options = {"mpi": False, "hdf5": False}
    no_copy_source = True

    @property
    def _checkout(self):
        return os.path.normpath(os.path.join(self.recipe_folder, "..", "..", ".."))

    def set_version(self):
        text = load(self, os.path.join(self._checkout, "include", "tsubu", "version.hpp"))
        number = int(re.search(r"define TSUBU_VERSION (\d+)", text)[1])
        self.version = f"{number // 10000}.{number // 100 % 100}.{number % 100}"

    def export_sources(self):
        copy(self, "LICENSE", self._checkout, self.export_sources_folder)
        copy(self, "include/*", self._checkout, self.export_sources_folder)

    def requirements(self):
        if self.options.mpi:
            self.requires("openmpi/[>=4.1 <6]", transitive_headers=True, transitive_libs=True)
        if self.options.hdf5:
            self.requires("hdf5/[>=1.10.2 <2]", transitive_headers=True, transitive_libs=True)

    def validate(self):
        check_min_cppstd(self, 20)

    def package_id(self):
        self.info.clear()

    def package(self):
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        copy(self, "include/*", self.source_folder, self.package_folder)

    def package_info(self):
        # Conan's target for all components at once: by default it would be called tsubu::tsubu, which is the core.
        self.cpp_info.set_property("cmake_target_name", "tsubu::all")
        self.cpp_info.set_property("pkg_config_name", "tsubu-all")
        core = self.cpp_info.components["core"]
        core.set_property("cmake_target_name", "tsubu::tsubu")
        core.set_property("pkg_config_name", "tsubu")
        parts = [core]
        for name, library in (("mpi", "openmpi"), ("hdf5", "hdf5")):
            if self.options.get_safe(name):
                part = self.cpp_info.components[name]
                part.set_property("cmake_target_name", f"tsubu::{name}")
                part.set_property("pkg_config_name", f"tsubu-{name}")
                part.requires = ["core", f"{library}::{library}"]
                parts.append(part)
        for part in parts:
            part.bindirs = []
            part.libdirs = []
