# cargo must be on the PATH: vcpkg has no Rust of its own
vcpkg_from_github(OUT_SOURCE_PATH SOURCE_PATH REPO @REPOSITORY@ REF "v${VERSION}" SHA512 @SHA512@)
vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS -DPLANISH_BUILD_TESTS=OFF -DPLANISH_BUILD_EXAMPLES=OFF -DPLANISH_FORTRAN=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME Planish CONFIG_PATH lib/cmake/Planish)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE-MIT" "${SOURCE_PATH}/LICENSE-APACHE")
