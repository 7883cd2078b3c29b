# Install rules, in components: runtime (the shared library), development (headers, CMake package, pkg-config), io (the
# readers and writers of files), tools (the command).
include(CMakePackageConfigHelpers)

install(TARGETS talus EXPORT talus-targets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT development
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT runtime)
install(DIRECTORY include/talus DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development FILES_MATCHING PATTERN "*.h")
if(TARGET talus_io)
    # The readers and writers of files, where they were built: talus::io. Their headers have a folder of their own.
    install(TARGETS talus_io EXPORT talus-io-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT io)
    foreach(header files/atomic_write files/file_map files/io_error mesh/imported_mesh mesh/mesh_import mesh/obj_reader
            mesh/obj_write mesh/point_cloud text/name_table)
        get_filename_component(room ${header} DIRECTORY)
        install(FILES io/${header}.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/talus-io/io/${room} COMPONENT io)
    endforeach()
endif()
if(TARGET talus_command)
    # The command finds the shared library beside it, wherever both were installed.
    file(RELATIVE_PATH talus_library_dir /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBDIR})
    if(APPLE)
        set_target_properties(talus_command PROPERTIES INSTALL_RPATH "@loader_path/${talus_library_dir}")
    else()
        set_target_properties(talus_command PROPERTIES INSTALL_RPATH "$ORIGIN/${talus_library_dir}")
    endif()
    install(TARGETS talus_command RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT tools)
    if(TARGET talus_mpi)
        install(TARGETS talus_mpi LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/talus COMPONENT tools)
    endif()
    if(TALUS_MANUAL_PAGES)
        install(FILES ${TALUS_MANUAL_PAGES} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tools)
        install(FILES ${TALUS_MANUAL_DIR}/talus.bash DESTINATION share/bash-completion/completions RENAME talus COMPONENT tools)
        install(FILES ${TALUS_MANUAL_DIR}/talus.zsh DESTINATION share/zsh/site-functions RENAME _talus COMPONENT tools)
        install(FILES ${TALUS_MANUAL_DIR}/talus.fish DESTINATION share/fish/vendor_completions.d COMPONENT tools)
    endif()
    # The page that `talus view` fills, where `make viewer-page` built it. The command finds it at ../share/talus.
    install(FILES ${CMAKE_CURRENT_SOURCE_DIR}/build/viewer/viewer.html DESTINATION share/talus COMPONENT tools OPTIONAL)
endif()

set(talus_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/talus)
install(EXPORT talus-targets NAMESPACE talus:: DESTINATION ${talus_package_dir} COMPONENT development)
if(TARGET talus_io)
    install(EXPORT talus-io-targets NAMESPACE talus:: DESTINATION ${talus_package_dir} COMPONENT io)
endif()
configure_package_config_file(cmake/talus-config.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/talus-config.cmake
    INSTALL_DESTINATION ${talus_package_dir} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/talus-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/talus-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/talus-config-version.cmake
    DESTINATION ${talus_package_dir} COMPONENT development)

# The prefix is told from where the file lies, so that an installation can be moved. Whoever links a static library needs
# its libraries too, with and without pkg-config --static.
file(RELATIVE_PATH talus_pc_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
if(BUILD_SHARED_LIBS)
    set(talus_pc_libs_private " -lm")
else()
    set(talus_pc_libs " -lm")
endif()
configure_file(cmake/talus.pc.in ${CMAKE_CURRENT_BINARY_DIR}/talus.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/talus.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
if(TARGET talus_io)
    if(MESHOPTIMIZER_LIBRARY AND MESHOPTIMIZER_INCLUDE_DIR)
        set(talus_io_pc_libs " -lmeshoptimizer")
    endif()
    if(TALUS_ASSIMP)
        string(APPEND talus_io_pc_requires " assimp")
    endif()
    if(TALUS_GLTF)
        string(APPEND talus_io_pc_requires " jansson")
    endif()
    configure_file(cmake/talus-io.pc.in ${CMAKE_CURRENT_BINARY_DIR}/talus-io.pc @ONLY)
    install(FILES ${CMAKE_CURRENT_BINARY_DIR}/talus-io.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT io)
endif()
