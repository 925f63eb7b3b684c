# Projects as users write them, built and run from outside: each test is consumers/<name>/test.cmake.
# `installed` puts the package where they find it, and makes the mesh that all of them shall make.
# On Windows a program would have to be told where its library is.
find_program(NETMESH_MAKE NAMES gmake make)
find_program(NETMESH_PKG_CONFIG pkg-config)
get_filename_component(netmesh_rust_dir "${NETMESH_CARGO}" DIRECTORY)
find_program(NETMESH_RUSTC rustc HINTS "${netmesh_rust_dir}")

set(netmesh_has_mpi OFF)
if(TARGET netmesh::mpi)
  set(netmesh_has_mpi ON)
endif()
set(consumer_settings "${CMAKE_CURRENT_BINARY_DIR}/consumer_settings.cmake")
configure_file(consumers/settings.cmake.in "${consumer_settings}" @ONLY)

function(netmesh_consumer_test name script)
  netmesh_test(${name} "${CMAKE_COMMAND}" "-DSETTINGS=${consumer_settings}"
               -P "${CMAKE_CURRENT_SOURCE_DIR}/consumers/${script}")
  set_tests_properties(${name} PROPERTIES FIXTURES_REQUIRED installed_package)
endfunction()

# netmesh_consumer(<directory> [<what it needs>...]): variables that are false where that is missing.
function(netmesh_consumer directory)
  foreach(need IN LISTS ARGN)
    if(NOT ${need})
      netmesh_skipped_test(consumer.${directory} "no ${need} here")
      return()
    endif()
  endforeach()
  netmesh_consumer_test(consumer.${directory} ${directory}/test.cmake)
endfunction()

if(NOT NETMESH_INSTALL OR NOT NETMESH_BUILD_CLI OR NOT UNIX)
  netmesh_skipped_test(installed "this build does not install the package and the command line")
  return()
endif()

netmesh_consumer_test(installed install.cmake)
set_tests_properties(installed PROPERTIES FIXTURES_REQUIRED "" FIXTURES_SETUP installed_package)

netmesh_consumer(find_package)
netmesh_consumer(add_subdirectory)
netmesh_consumer(fetch_content)
netmesh_consumer(pkg_config NETMESH_MAKE NETMESH_PKG_CONFIG)
netmesh_consumer(two_rust_libraries NETMESH_MAKE NETMESH_PKG_CONFIG NETMESH_RUSTC netmesh_soname CMAKE_NM)

# Asks find_package's programs too.
netmesh_consumer_test(version version.cmake)
set_tests_properties(version PROPERTIES FIXTURES_REQUIRED "installed_package;found_package")
set_tests_properties(consumer.find_package PROPERTIES FIXTURES_SETUP found_package)
