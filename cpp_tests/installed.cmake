# The installed package: a program that finds it with find_package starts with the library under the
# name of its ABI, from wherever it was put.
#
#   cmake -DBUILD=... -DSCRATCH=... -DSOURCE=... -DSONAME=... -P installed.cmake

file(REMOVE_RECURSE "${SCRATCH}")
file(MAKE_DIRECTORY "${SCRATCH}/consumer")
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${SCRATCH}/prefix"
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
# Somewhere else than where it was installed.
file(RENAME "${SCRATCH}/prefix" "${SCRATCH}/moved")

file(GLOB_RECURSE libraries RELATIVE "${SCRATCH}/moved" "${SCRATCH}/moved/*libnetmesh.so*")
message(STATUS "${libraries}")
if(SONAME AND NOT libraries MATCHES "${SONAME}")
  message(FATAL_ERROR "${SONAME} was not installed")
endif()

file(WRITE "${SCRATCH}/consumer/CMakeLists.txt" "
cmake_minimum_required(VERSION 3.22)
project(consumer LANGUAGES C CXX)
find_package(netmesh REQUIRED)
foreach(library netmesh static)
  add_executable(consumer_\${library} \"${SOURCE}/cpp_tests/c_api_smoke.c\")
  target_link_libraries(consumer_\${library} PRIVATE netmesh::\${library})
endforeach()
")
execute_process(
  COMMAND "${CMAKE_COMMAND}" -S "${SCRATCH}/consumer" -B "${SCRATCH}/build"
          "-DCMAKE_PREFIX_PATH=${SCRATCH}/moved"
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${CMAKE_COMMAND}" --build "${SCRATCH}/build"
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
foreach(library netmesh static)
  execute_process(COMMAND "${SCRATCH}/build/consumer_${library}" "${SCRATCH}"
                  COMMAND_ERROR_IS_FATAL ANY)
endforeach()
