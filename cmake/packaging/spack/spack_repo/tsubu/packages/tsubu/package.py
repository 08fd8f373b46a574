# SPDX-License-Identifier: MIT
from pathlib import Path

from spack_repo.builtin.build_systems.cmake import CMakePackage

from spack.package import *


class Tsubu(CMakePackage):
    """Header-only C++20 data layer of particle codes: ids, ownership, fields, files, migration and halo."""

    git = f"file://{Path(__file__).resolve().parents[7]}"  # the checkout that this file lies in
    license("MIT")
    version("main", branch="main")

    # The headers are the same for all; a variant brings the library that find_package(tsubu COMPONENTS ...) looks for.
    variant("mpi", default=True, description="MPI, for the target tsubu::mpi")
    variant("hdf5", default=False, description="HDF5, for the target tsubu::hdf5")

    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("mpi@3:", when="+mpi")
    depends_on("hdf5@1.10.2:", when="+hdf5")

    conflicts("%gcc@:11", msg="C++20 as of g++ 12 is needed")
    conflicts("%clang@:13", msg="C++20 as of clang 14 is needed")

    def cmake_args(self):
        return [self.define("TSUBU_BUILD_TESTS", False)]
