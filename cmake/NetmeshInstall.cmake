# Install rules: both libraries, the headers, find_package(netmesh) and pkg-config.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

if(WIN32)
  install(FILES "${netmesh_shared_file}" DESTINATION "${CMAKE_INSTALL_BINDIR}")
  install(FILES "${netmesh_import_file}" "${netmesh_static_file}"
          DESTINATION "${CMAKE_INSTALL_LIBDIR}")
else()
  if(netmesh_soname)
    # The library under its full version, the name that programs ask for, and the one to link with.
    set(netmesh_versioned_name "libnetmesh.so.${PROJECT_VERSION}")
    install(PROGRAMS "${netmesh_shared_file}" DESTINATION "${CMAKE_INSTALL_LIBDIR}"
            RENAME "${netmesh_versioned_name}")
    set(netmesh_links_dir "${CMAKE_CURRENT_BINARY_DIR}/install_links")
    file(MAKE_DIRECTORY "${netmesh_links_dir}")
    file(CREATE_LINK "${netmesh_versioned_name}" "${netmesh_links_dir}/${netmesh_soname}" SYMBOLIC)
    file(CREATE_LINK "${netmesh_soname}" "${netmesh_links_dir}/libnetmesh.so" SYMBOLIC)
    install(FILES "${netmesh_links_dir}/${netmesh_soname}" "${netmesh_links_dir}/libnetmesh.so"
            DESTINATION "${CMAKE_INSTALL_LIBDIR}")
  else()
    install(PROGRAMS "${netmesh_shared_file}" DESTINATION "${CMAKE_INSTALL_LIBDIR}")
  endif()
  install(FILES "${netmesh_static_file}" DESTINATION "${CMAKE_INSTALL_LIBDIR}")
endif()
install(DIRECTORY "${netmesh_include_dir}/" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
        FILES_MATCHING PATTERN "netmesh.h" PATTERN "netmesh.hpp")

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
        DESTINATION "${netmesh_package_dir}")

if(NOT WIN32)
  list(TRANSFORM netmesh_system_libraries PREPEND "-l" OUTPUT_VARIABLE netmesh_private_flags)
  string(JOIN " " netmesh_private_flags ${netmesh_private_flags})
  # Relative, so that the installed tree can be moved.
  file(RELATIVE_PATH netmesh_prefix_from_pc
       "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" "${CMAKE_INSTALL_PREFIX}")
  configure_file("${CMAKE_CURRENT_LIST_DIR}/netmesh.pc.in"
                 "${CMAKE_CURRENT_BINARY_DIR}/netmesh.pc" @ONLY)
  install(FILES "${CMAKE_CURRENT_BINARY_DIR}/netmesh.pc"
          DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
endif()
