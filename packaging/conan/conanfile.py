import os

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeToolchain, cmake_layout
from conan.tools.files import copy


class Planish(ConanFile):
    name = "planish"
    version = "0.2.0"
    license = "MIT OR Apache-2.0"
    description = "Smooth spline surfaces from triangle meshes, rows of points and fields, within a stated tolerance"
    topics = ("spline", "nurbs", "mesh", "fitting", "cad")
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "fPIC": [True, False]}
    default_options = {"shared": True, "fPIC": True}

    def export_sources(self):
        root = os.path.join(self.recipe_folder, os.pardir, os.pardir)
        for pattern in ("Cargo.*", "build.rs", "CMakeLists.txt", "LICENSE*", "README.md", "src/*", "include/*", "bindings/*",
                        "cmake/*", "tools/header/*", "benches/*"):
            copy(self, pattern, root, self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        toolchain = CMakeToolchain(self)
        for option in ("PLANISH_BUILD_TESTS", "PLANISH_BUILD_EXAMPLES", "PLANISH_FORTRAN"):
            toolchain.cache_variables[option] = False
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE*", self.source_folder, os.path.join(self.package_folder, "licenses"))

    def package_info(self):
        self.cpp_info.set_property("cmake_file_name", "Planish")
        self.cpp_info.set_property("cmake_target_name", "Planish::planish")
        self.cpp_info.set_property("pkg_config_name", "planish")
        self.cpp_info.libs = ["planish"]
        if self.settings.os == "Linux" and not self.options.shared:
            self.cpp_info.system_libs = ["gcc_s", "util", "rt", "pthread", "m", "dl"]
