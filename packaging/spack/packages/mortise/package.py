from spack.package import *


class Mortise(CMakePackage):
    """Contact between bodies that deform, slide and yield: dual mortar methods with friction on Trilinos."""

    # In the source tree: spack repo add packaging/spack; spack dev-build mortise@0.2.0
    license("BSD-3-Clause")

    version("0.2.0")

    variant("shared", default=True, description="Shared libraries")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("python", type="test")
    depends_on("googletest+gmock", type="test")

    depends_on("mpi")
    depends_on(
        "trilinos@13.2: +mpi+amesos2+belos+ifpack2+muelu+mumps+nox+sacado+stratimikos+teko+tpetra+zoltan2 gotype=long_long"
    )
    depends_on("mumps+mpi+double+float+complex")
    depends_on("metis")
    depends_on("seacas+mpi")
    depends_on("netcdf-c+mpi")
    depends_on("hdf5+mpi")
    depends_on("eigen@3.4:")
    depends_on("fmt@9:")
    depends_on("boost@1.74:")
    depends_on("libxml2")
    depends_on("muparser")
    depends_on("nlohmann-json")
    depends_on("cli11")
    depends_on("zlib-api")

    generator("ninja")

    def cmake_args(self):
        return [
            self.define_from_variant("BUILD_SHARED_LIBS", "shared"),
            self.define("BUILD_TESTING", self.run_tests),
            self.define("CMAKE_CXX_COMPILER", self.spec["mpi"].mpicxx),
            self.define("CMAKE_C_COMPILER", self.spec["mpi"].mpicc),
        ]
