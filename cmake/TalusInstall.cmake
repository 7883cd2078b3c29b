# Install rules: headers, library, CMake package, pkg-config file, command.
include(CMakePackageConfigHelpers)

install(TARGETS talus EXPORT talus-targets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY include/talus DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
if(TARGET talus_command)
    install(TARGETS talus_command RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

set(talus_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/talus)
install(EXPORT talus-targets NAMESPACE talus:: FILE talus-config.cmake DESTINATION ${talus_package_dir})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/talus-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/talus-config-version.cmake DESTINATION ${talus_package_dir})

configure_file(cmake/talus.pc.in ${CMAKE_CURRENT_BINARY_DIR}/talus.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/talus.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
