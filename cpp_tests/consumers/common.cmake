# Included by each consumer's test.cmake: build a project as its user would, run it, and hold what it
# prints and writes against what the installed command line makes of the same points.
include("${SETTINGS}")
include("${CMAKE_CURRENT_LIST_DIR}/../require_equal.cmake")

function(run)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE text ERROR_VARIABLE text RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    string(REPLACE ";" " " command "${ARGN}")
    message(FATAL_ERROR "${command}\n${text}\n=> ${result}")
  endif()
  set(run_output "${text}" PARENT_SCOPE)
endfunction()

# Configures and builds cpp_tests/consumers/<name>; leaves what the build said in run_output.
function(build_with_cmake name)
  file(REMOVE_RECURSE "${scratch}/${name}")
  run("${CMAKE_COMMAND}" -G "${generator}" -S "${source_dir}/cpp_tests/consumers/${name}"
      -B "${scratch}/${name}" "-DCMAKE_BUILD_TYPE=${build_type}"
      "-DCMAKE_C_COMPILER=${c_compiler}" "-DCMAKE_CXX_COMPILER=${cxx_compiler}" ${ARGN})
  run("${CMAKE_COMMAND}" --build "${scratch}/${name}")
  set(run_output "${run_output}" PARENT_SCOPE)
endfunction()

# Builds like build_with_cmake, with this checkout in place of a copy in the project's own tree, and with cargo's
# directory of this build, in which everything is built already.
function(build_with_checkout name)
  set(cache "${scratch}/${name}_cache.cmake")
  file(WRITE "${cache}" "
    set(NETMESH_CHECKOUT \"${source_dir}\" CACHE PATH \"\")
    set(NETMESH_CARGO \"${cargo}\" CACHE FILEPATH \"\")
    set(NETMESH_CARGO_TARGET_DIR \"${cargo_target_dir}\" CACHE PATH \"\")
    set(NETMESH_CARGO_TARGET \"${cargo_target}\" CACHE STRING \"\")
    set(NETMESH_CARGO_PROFILE \"${cargo_profile}\" CACHE STRING \"\")
    set(NETMESH_CARGO_ENVIRONMENT \"${cargo_environment}\" CACHE STRING \"\")
")
  build_with_cmake("${name}" -C "${cache}")
  if(run_output MATCHES "Compiling netmesh")
    message(FATAL_ERROR "the library was compiled again:\n${run_output}")
  endif()
endfunction()

# Builds cpp_tests/consumers/<name> by its Makefile, against the installed package.
function(build_with_make name)
  file(REMOVE_RECURSE "${scratch}/${name}")
  file(COPY "${source_dir}/cpp_tests/consumers/${name}" DESTINATION "${scratch}")
  set(ENV{PKG_CONFIG_PATH} "${prefix}/${library_dir}/pkgconfig")
  run("${make}" -C "${scratch}/${name}" "CC=${c_compiler}" "PKG_CONFIG=${pkg_config}" ${ARGN})
endfunction()

# Runs programs of a consumer: each prints and writes what the command line did.
function(expect_the_mesh name)
  file(READ "${scratch}/expected.txt" expected_line)
  file(SHA256 "${scratch}/expected.off" expected_mesh)
  foreach(program IN LISTS ARGN)
    set(mesh "${scratch}/${name}/${program}.off")
    run("${scratch}/${name}/${program}" "${points}" "${mesh}")
    require_equal("${name}: ${program} prints" "${run_output}" "${expected_line}")
    file(SHA256 "${mesh}" written)
    require_equal("${name}: ${program} writes" "${written}" "${expected_mesh}")
    message(STATUS "${program}: ${run_output}")
  endforeach()
endfunction()
