# The library on MPI and its program, where MPI is found. cargo decides what is out of date, as for the core.
#
#   netmesh::mpi     netmesh_mpi.h, in a static library; it has the functions of netmesh.h as well, in
#                    place of netmesh::netmesh or netmesh::static
#   netmesh_mpi      what builds it and the program netmesh-mpi

find_package(MPI QUIET COMPONENTS C)
if(NOT MPI_C_FOUND)
  if(NETMESH_BUILD_MPI STREQUAL "ON")
    message(FATAL_ERROR "NETMESH_BUILD_MPI is ON, and MPI is not found")
  endif()
  message(STATUS "MPI not found: netmesh::mpi and netmesh-mpi will not be built")
  return()
endif()

set(netmesh_mpi_archive "${netmesh_cargo_dir}/libnetmesh_mpi.a")
set(netmesh_mpi_gather "")
if(netmesh_soname)
  # As the core's archive, it leaves the names of Rust's runtime to others.
  set(netmesh_mpi_archive "${netmesh_library_dir}/libnetmesh_mpi.a")
  set(netmesh_mpi_gather COMMAND "${CMAKE_COMMAND}" -DNAME=netmesh_mpi "-DFROM=${netmesh_cargo_dir}"
      "-DHEADERS=${netmesh_include_dir}/netmesh.h$<SEMICOLON>${PROJECT_SOURCE_DIR}/mpi/include/netmesh_mpi.h"
      ${netmesh_gather_tools} -P "${CMAKE_CURRENT_LIST_DIR}/NetmeshGather.cmake")
endif()
set(netmesh_mpi_program "${netmesh_cargo_dir}/netmesh-mpi")
set(netmesh_mpi_include_dir "${PROJECT_SOURCE_DIR}/mpi/include")

# With the library as it is for the other targets: it compiles once.
set(netmesh_mpi_cargo_build
  "${CMAKE_COMMAND}" -E env "MPICC=${MPI_C_COMPILER}" ${netmesh_cargo_build} --package netmesh-mpi)
add_custom_target(netmesh_mpi ALL
  COMMAND ${netmesh_mpi_cargo_build} --lib --bins
  ${netmesh_mpi_gather}
  WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}"
  BYPRODUCTS "${netmesh_mpi_archive}" "${netmesh_mpi_program}"
  COMMENT "Building the library on MPI with cargo"
  USES_TERMINAL
  VERBATIM)
# One cargo at a time: the other would wait for its lock.
add_dependencies(netmesh_mpi netmesh_cargo)

add_library(netmesh::mpi STATIC IMPORTED GLOBAL)
set_target_properties(netmesh::mpi PROPERTIES
  IMPORTED_LOCATION "${netmesh_mpi_archive}"
  INTERFACE_LINK_LIBRARIES "MPI::MPI_C;${netmesh_system_libraries}")
target_include_directories(netmesh::mpi INTERFACE "${netmesh_mpi_include_dir}" "${netmesh_include_dir}")
add_dependencies(netmesh::mpi netmesh_mpi)

if(NETMESH_INSTALL)
  include("${CMAKE_CURRENT_LIST_DIR}/NetmeshInstallMpi.cmake")
endif()
