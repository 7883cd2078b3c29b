# SPDX-License-Identifier: MIT
"""The library for Conan 2, from the tree that this recipe lies in: conan create packaging/conan"""

import os
import re

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain
from conan.tools.files import copy, load


class TalusConan(ConanFile):
    name = "talus"
    license = "MIT"
    description = "Collision and navigation geometry: rays, convex shapes and navmeshes over a level's triangles"
    topics = ("collision", "raycast", "navmesh", "pathfinding", "geometry")
    package_type = "library"
    settings = "os", "compiler", "build_type", "arch"
    options = {"shared": [True, False], "fPIC": [True, False]}
    default_options = {"shared": False, "fPIC": True}
    implements = ["auto_shared_fpic"]
    languages = "C"

    @property
    def tree(self):
        return os.path.join(self.recipe_folder, "..", "..")

    def set_version(self):
        text = load(self, os.path.join(self.tree, "include/talus/base.h"))
        self.version = ".".join(re.findall(r"#define TL_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", text))

    def export_sources(self):
        for pattern in ("CMakeLists.txt", "LICENSE", "cmake/*", "include/*", "src/*"):
            copy(self, pattern, self.tree, self.export_sources_folder)

    def generate(self):
        toolchain = CMakeToolchain(self)
        for name in ("TOOLS", "TESTS", "EXAMPLES"):
            toolchain.cache_variables[f"TALUS_{name}"] = False
        toolchain.generate()
        CMakeDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))

    def package_info(self):
        self.cpp_info.libs = ["talus"]
        self.cpp_info.set_property("cmake_file_name", "talus")
        self.cpp_info.set_property("cmake_target_name", "talus::talus")
        self.cpp_info.set_property("pkg_config_name", "talus")
        if self.options.shared:
            self.cpp_info.defines = ["TALUS_SHARED"]
        if self.settings.os in ("Linux", "FreeBSD"):
            self.cpp_info.system_libs = ["m"]
