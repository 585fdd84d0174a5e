# What `cmake --install` puts where: the program, the libraries, their headers, and the package that
# find_package(Weft) finds.
include(CMakePackageConfigHelpers)

get_property(modules GLOBAL PROPERTY WEFT_MODULES)
install(TARGETS ${modules} weft weft_flags EXPORT WeftTargets
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/weft" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
  FILES_MATCHING PATTERN "*.h")
install(TARGETS weft_program RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")

set(package "${CMAKE_INSTALL_LIBDIR}/cmake/Weft")
install(EXPORT WeftTargets NAMESPACE weft:: DESTINATION "${package}")
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/WeftConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/WeftConfig.cmake" INSTALL_DESTINATION "${package}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/WeftConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/WeftConfig.cmake" "${PROJECT_BINARY_DIR}/WeftConfigVersion.cmake"
  DESTINATION "${package}")
