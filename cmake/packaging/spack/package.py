# SPDX-License-Identifier: MIT
"""In a repository of one's own: spack repo add, packages/tsubu/package.py; spack dev-build tsubu@main in this checkout."""
from spack.package import *


class Tsubu(CMakePackage):
    """Header-only C++20 data layer of particle codes: ids, ownership, fields, migration and halo."""

    license("MIT")

    version("main", branch="main")

    variant("mpi", default=True, description="The target tsubu::mpi")
    variant("hdf5", default=False, description="The target tsubu::hdf5")

    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("mpi@3:", when="+mpi")
    depends_on("hdf5@1.10.2:", when="+hdf5")

    conflicts("%gcc@:11")
    conflicts("%clang@:13")

    def cmake_args(self):
        return [
            self.define_from_variant("TSUBU_WITH_MPI", "mpi"),
            self.define_from_variant("TSUBU_WITH_HDF5", "hdf5"),
            self.define("TSUBU_BUILD_TESTS", False),
            self.define("TSUBU_BUILD_BENCH", False),
        ]
