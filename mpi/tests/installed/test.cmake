# Installs the library on MPI, moves it elsewhere, and builds a program on it as its users would: by
# find_package, and by pkg-config with MPI's compiler wrapper. Both make the mesh that the installed
# program makes.
#
#   cmake -DBUILD_DIR=... -DSCRATCH=... -DPOINTS=... -DMPIEXEC=... -DMPICC=... -DREADELF=... -DGENERATOR=...
#         -DC_COMPILER=... -DSYMBOLS=... -DLIBRARY_DIR=... -P test.cmake
set(prefix "${SCRATCH}/moved")
set(OMPI_ENVIRONMENT OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
    OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_mpi_yield_when_idle=1
    PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe)

function(run)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE text ERROR_VARIABLE text RESULT_VARIABLE result TIMEOUT 300)
  if(NOT result EQUAL 0)
    string(REPLACE ";" " " command "${ARGN}")
    message(FATAL_ERROR "${command}\n${text}\n=> ${result}")
  endif()
  set(run_output "${text}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE "${SCRATCH}")
foreach(component headers mpi)
  run("${CMAKE_COMMAND}" --install "${BUILD_DIR}" --prefix "${SCRATCH}/prefix" --component ${component})
endforeach()
file(RENAME "${SCRATCH}/prefix" "${prefix}")
set(archive "${prefix}/${LIBRARY_DIR}/libnetmesh_mpi.a")
set(program "${prefix}/bin/netmesh-mpi")
foreach(file "${archive}" "${program}" "${prefix}/include/netmesh_mpi.h" "${prefix}/include/netmesh.h"
        "${prefix}/${LIBRARY_DIR}/pkgconfig/netmesh_mpi.pc" "${prefix}/share/man/man1/netmesh-mpi.1"
        "${prefix}/share/doc/netmesh/mpi/README.md")
  if(NOT EXISTS "${file}")
    message(FATAL_ERROR "${file} is not installed")
  endif()
endforeach()

# Every page that the README has a link to is where the link says.
file(STRINGS "${prefix}/share/doc/netmesh/mpi/README.md" lines)
set(pages 0)
foreach(line IN LISTS lines)
  string(REGEX MATCHALL "\\(\\.\\./[^)#]*" links "${line}")
  foreach(link IN LISTS links)
    string(SUBSTRING "${link}" 1 -1 link)
    math(EXPR pages "${pages} + 1")
    if(NOT EXISTS "${prefix}/share/doc/netmesh/mpi/${link}")
      message(FATAL_ERROR "the installed README has a link to ${link}, which is not there")
    endif()
  endforeach()
endforeach()
if(pages LESS 4)
  message(FATAL_ERROR "the README has ${pages} links only: this test sees nothing")
endif()

if(READELF AND NOT SYMBOLS)
  foreach(file "${archive}" "${program}")
    run("${READELF}" --section-headers --wide "${file}")
    if(run_output MATCHES "\\.debug_")
      message(FATAL_ERROR "${file} is not stripped")
    endif()
  endforeach()
endif()

run("${CMAKE_COMMAND}" -G "${GENERATOR}" -S "${CMAKE_CURRENT_LIST_DIR}" -B "${SCRATCH}/build"
    "-DCMAKE_BUILD_TYPE=Release" "-DCMAKE_C_COMPILER=${C_COMPILER}" "-DCMAKE_PREFIX_PATH=${prefix}")
run("${CMAKE_COMMAND}" --build "${SCRATCH}/build")
set(programs "${SCRATCH}/build/ranks")
find_program(make NAMES gmake make)
find_program(pkg_config pkg-config)
if(make AND pkg_config)
  file(COPY "${CMAKE_CURRENT_LIST_DIR}/Makefile" "${CMAKE_CURRENT_LIST_DIR}/main.c" DESTINATION "${SCRATCH}/make")
  run("${CMAKE_COMMAND}" -E env "PKG_CONFIG_PATH=${prefix}/${LIBRARY_DIR}/pkgconfig"
      "${make}" -C "${SCRATCH}/make" "MPICC=${MPICC}" "PKG_CONFIG=${pkg_config}")
  list(APPEND programs "${SCRATCH}/make/ranks")
else()
  message(STATUS "skipped: pkg-config, which is not here")
endif()

run("${CMAKE_COMMAND}" -E env ${OMPI_ENVIRONMENT} "${MPIEXEC}" -np 3 "${program}" "${POINTS}" -q -o "${SCRATCH}/expected.npy")
file(SHA256 "${SCRATCH}/expected.points.npy" expected)
foreach(consumer IN LISTS programs)
  run("${CMAKE_COMMAND}" -E env ${OMPI_ENVIRONMENT} "${MPIEXEC}" -np 2 "${consumer}" "${POINTS}" "${consumer}.npy")
  file(SHA256 "${consumer}.points.npy" found)
  if(NOT found STREQUAL expected)
    message(FATAL_ERROR "${consumer} makes another mesh than the installed program: ${run_output}")
  endif()
  message(STATUS "${consumer}: ${run_output}")
endforeach()
