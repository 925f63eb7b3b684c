# Install rules: both libraries, the headers and the pages that they cite, find_package(netmesh), pkg-config,
# the command line with its man page, and the licences. Components, for who does not want all:
# `headers` (with package files and pages), `library`, `program`, `mpi` (NetmeshInstallMpi.cmake).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

option(NETMESH_INSTALL_SYMBOLS "Install libraries and programs with their symbols and line tables" OFF)

# netmesh_strip_installed(COMPONENT HOW DIRECTORY FILE): strips FILE where it has been installed to DIRECTORY.
# The time of the file stays, by which the next installation knows that it is up to date.
function(netmesh_strip_installed component how directory file)
  if(NETMESH_INSTALL_SYMBOLS OR NOT netmesh_soname OR NOT CMAKE_STRIP)
    return()
  endif()
  get_filename_component(name "${file}" NAME)
  if(NOT IS_ABSOLUTE "${directory}")
    string(PREPEND directory "\${CMAKE_INSTALL_PREFIX}/")
  endif()
  install(CODE "
    execute_process(COMMAND \"${CMAKE_STRIP}\" -p ${how} \"\$ENV{DESTDIR}${directory}/${name}\"
                    COMMAND_ERROR_IS_FATAL ANY)" COMPONENT ${component})
endfunction()

if(WIN32)
  install(FILES "${netmesh_shared_file}" DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT library)
  install(FILES "${netmesh_import_file}" "${netmesh_static_file}"
          DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT library)
else()
  # The names of the ABI and of the link are links beside it.
  install(PROGRAMS "${netmesh_shared_file}" DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT library)
  if(netmesh_soname)
    install(FILES "${netmesh_library_dir}/${netmesh_soname}" "${netmesh_library_dir}/libnetmesh.so"
            DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT library)
  endif()
  install(FILES "${netmesh_static_file}" DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT library)
  netmesh_strip_installed(library --strip-unneeded "${CMAKE_INSTALL_LIBDIR}" "${netmesh_shared_file}")
  netmesh_strip_installed(library --strip-unneeded "${CMAKE_INSTALL_LIBDIR}" "${netmesh_static_file}")
endif()
install(DIRECTORY "${netmesh_include_dir}/" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
        COMPONENT headers FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs/" DESTINATION "${CMAKE_INSTALL_DATAROOTDIR}/doc/netmesh"
        COMPONENT headers FILES_MATCHING PATTERN "*.md" PATTERN "*.svg" PATTERN "*.png"
        PATTERN doxygen EXCLUDE)
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE-MIT" "${PROJECT_SOURCE_DIR}/LICENSE-APACHE"
        DESTINATION "${CMAKE_INSTALL_DATAROOTDIR}/licenses/netmesh" COMPONENT headers)

if(NETMESH_BUILD_CLI)
  install(PROGRAMS "${netmesh_cli_file}" DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT program)
  netmesh_strip_installed(program --strip-all "${CMAKE_INSTALL_BINDIR}" "${netmesh_cli_file}")
  configure_file("${PROJECT_SOURCE_DIR}/cli/netmesh.1.in" "${CMAKE_CURRENT_BINARY_DIR}/netmesh.1" @ONLY)
  install(FILES "${CMAKE_CURRENT_BINARY_DIR}/netmesh.1" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1"
          COMPONENT program)
endif()

set(netmesh_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/netmesh")
get_filename_component(netmesh_shared_name "${netmesh_shared_file}" NAME)
get_filename_component(netmesh_static_name "${netmesh_static_file}" NAME)
if(netmesh_import_file)
  get_filename_component(netmesh_import_name "${netmesh_import_file}" NAME)
endif()
configure_package_config_file(
  "${CMAKE_CURRENT_LIST_DIR}/netmesh-config.cmake.in"
  "${CMAKE_CURRENT_BINARY_DIR}/netmesh-config.cmake"
  INSTALL_DESTINATION "${netmesh_package_dir}"
  PATH_VARS CMAKE_INSTALL_INCLUDEDIR CMAKE_INSTALL_LIBDIR CMAKE_INSTALL_BINDIR)
# Before 1.0 a minor version may break.
write_basic_package_version_file(
  "${CMAKE_CURRENT_BINARY_DIR}/netmesh-config-version.cmake"
  VERSION ${PROJECT_VERSION} COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/netmesh-config.cmake"
              "${CMAKE_CURRENT_BINARY_DIR}/netmesh-config-version.cmake"
        DESTINATION "${netmesh_package_dir}" COMPONENT headers)

if(NOT WIN32)
  list(TRANSFORM netmesh_system_libraries PREPEND "-l" OUTPUT_VARIABLE netmesh_private_flags)
  string(JOIN " " netmesh_private_flags ${netmesh_private_flags})
  # Relative, so that the installed tree can be moved.
  set(netmesh_pc_dir "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig")
  file(RELATIVE_PATH netmesh_prefix_from_pc "${netmesh_pc_dir}" "${CMAKE_INSTALL_PREFIX}")
  file(RELATIVE_PATH netmesh_include_from_pc "${netmesh_pc_dir}" "${CMAKE_INSTALL_FULL_INCLUDEDIR}")
  configure_file("${CMAKE_CURRENT_LIST_DIR}/netmesh.pc.in"
                 "${CMAKE_CURRENT_BINARY_DIR}/netmesh.pc" @ONLY)
  install(FILES "${CMAKE_CURRENT_BINARY_DIR}/netmesh.pc"
          DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT headers)
endif()
