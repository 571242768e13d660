from spack_repo.builtin.build_systems.cmake import CMakePackage

from spack.package import *


class Planish(CMakePackage):
    """Smooth spline surfaces from triangle meshes, rows of points and fields, within a stated
    tolerance."""

    homepage = "@HOMEPAGE@"
    url = "@ARCHIVE@"

    license("MIT OR Apache-2.0")

    version("0.2.0", sha256="@SHA256@")

    variant("fortran", default=True, description="Install the Fortran module")
    variant("tool", default=True, description="Install the command line tool")

    depends_on("c", type="build")
    depends_on("fortran", type="build", when="+fortran")
    depends_on("rust@1.88:", type="build")
    depends_on("cmake@3.22:", type="build")

    def cmake_args(self):
        return [
            self.define("PLANISH_BUILD_TESTS", False),
            self.define("PLANISH_BUILD_EXAMPLES", False),
            self.define_from_variant("PLANISH_FORTRAN", "fortran"),
            self.define_from_variant("PLANISH_TOOL", "tool"),
        ]
