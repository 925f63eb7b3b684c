# The Rust library as CMake targets. cargo decides what is out of date, so it runs at every build
# and answers at once when nothing changed.

find_program(NETMESH_CARGO cargo HINTS "$ENV{CARGO_HOME}/bin" "$ENV{HOME}/.cargo/bin"
             DOC "The cargo that builds netmesh")
if(NOT NETMESH_CARGO)
  message(FATAL_ERROR "netmesh needs cargo (https://rustup.rs); set NETMESH_CARGO to its path")
endif()

# Inside the binary directory: an out-of-source build writes nothing to the source tree, and two
# build directories never wait for each other's lock. Point it at target/ to share cargo's own.
set(NETMESH_CARGO_TARGET_DIR "${CMAKE_CURRENT_BINARY_DIR}/cargo" CACHE PATH
    "Where cargo puts what it builds")

set(NETMESH_CARGO_PROFILE "release" CACHE STRING
    "Cargo's profile; dev checks assertions and integer overflow in the library")
set(NETMESH_CARGO_TARGET "" CACHE STRING "The triple to build for; empty: this machine's")
set(NETMESH_CARGO_ENVIRONMENT "" CACHE STRING "Variables for cargo, as NAME=value;NAME=value")
# Not --locked: after a change of the version, cargo writes it into Cargo.lock.
set(netmesh_cargo_build
  "${CMAKE_COMMAND}" -E env ${NETMESH_CARGO_ENVIRONMENT} "${NETMESH_CARGO}" build
  --manifest-path "${CMAKE_CURRENT_SOURCE_DIR}/Cargo.toml" --target-dir "${NETMESH_CARGO_TARGET_DIR}"
  --profile "${NETMESH_CARGO_PROFILE}")
if(NETMESH_CARGO_TARGET)
  list(APPEND netmesh_cargo_build --target "${NETMESH_CARGO_TARGET}")
endif()

set(netmesh_profile_dir "${NETMESH_CARGO_PROFILE}")
if(NETMESH_CARGO_PROFILE STREQUAL "dev")
  set(netmesh_profile_dir debug)
endif()
set(netmesh_cargo_dir "${NETMESH_CARGO_TARGET_DIR}/${NETMESH_CARGO_TARGET}/${netmesh_profile_dir}")
cmake_path(NORMAL_PATH netmesh_cargo_dir)
set(netmesh_include_dir "${CMAKE_CURRENT_SOURCE_DIR}/include")

# What programs link with: on systems with ELF libraries made by NetmeshGather.cmake out of what cargo
# builds, elsewhere that itself.
set(netmesh_soname "")
set(netmesh_import_file "")
set(netmesh_gather "")
if(WIN32)
  set(netmesh_shared_file "${netmesh_cargo_dir}/netmesh.dll")
  set(netmesh_import_file "${netmesh_cargo_dir}/netmesh.dll.lib")
  set(netmesh_static_file "${netmesh_cargo_dir}/netmesh.lib")
elseif(APPLE)
  set(netmesh_shared_file "${netmesh_cargo_dir}/libnetmesh${CMAKE_SHARED_LIBRARY_SUFFIX}")
  set(netmesh_static_file "${netmesh_cargo_dir}/libnetmesh.a")
else()
  # The name that programs ask for at run time is that of the ABI (build.rs gives it to the library).
  file(STRINGS "${netmesh_include_dir}/netmesh.h" netmesh_abi_line
       REGEX "^#define NM_ABI_VERSION [0-9]+" LIMIT_COUNT 1)
  string(REGEX MATCH "[0-9]+$" netmesh_abi_version "${netmesh_abi_line}")
  set(netmesh_soname "libnetmesh.so.${netmesh_abi_version}")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${netmesh_include_dir}/netmesh.h")

  set(netmesh_library_dir "${CMAKE_CURRENT_BINARY_DIR}/lib")
  set(netmesh_shared_file "${netmesh_library_dir}/libnetmesh.so.${PROJECT_VERSION}")
  set(netmesh_static_file "${netmesh_library_dir}/libnetmesh.a")
  set(netmesh_target_option "")
  if(CMAKE_C_COMPILER_TARGET)
    set(netmesh_target_option "${CMAKE_C_COMPILE_OPTIONS_TARGET}${CMAKE_C_COMPILER_TARGET}")
  endif()
  set(netmesh_gather_tools
      "-DTO=${netmesh_library_dir}" "-DCOMPILER=${CMAKE_C_COMPILER}" "-DTARGET_OPTION=${netmesh_target_option}"
      "-DOBJCOPY=${CMAKE_OBJCOPY}" "-DAR=${CMAKE_AR}")
  set(netmesh_gather COMMAND "${CMAKE_COMMAND}" -DNAME=netmesh
      "-DFROM=${netmesh_cargo_dir}" "-DVERSION=${PROJECT_VERSION}" "-DSONAME=${netmesh_soname}"
      "-DHEADERS=${netmesh_include_dir}/netmesh.h" ${netmesh_gather_tools}
      -P "${CMAKE_CURRENT_LIST_DIR}/NetmeshGather.cmake")
endif()

add_custom_target(netmesh_cargo
  COMMAND ${netmesh_cargo_build} --package netmesh --lib
  ${netmesh_gather}
  WORKING_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}"
  BYPRODUCTS "${netmesh_shared_file}" "${netmesh_static_file}" ${netmesh_import_file}
  COMMENT "Building the Rust library with cargo"
  USES_TERMINAL
  VERBATIM)

if(NETMESH_BUILD_CLI)
  set(netmesh_cli_file "${netmesh_cargo_dir}/netmesh${CMAKE_EXECUTABLE_SUFFIX}")
  add_custom_target(netmesh_cli ALL
    COMMAND ${netmesh_cargo_build} --package netmesh-cli --bin netmesh
    WORKING_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}"
    BYPRODUCTS "${netmesh_cli_file}"
    COMMENT "Building the command line with cargo"
    USES_TERMINAL
    VERBATIM)
  # One cargo at a time: the other would wait for its lock.
  add_dependencies(netmesh_cli netmesh_cargo)
endif()

# What `cargo rustc --release --crate-type staticlib -- --print native-static-libs` names, without
# gcc_s: C and C++ compilers link their unwinder themselves, the static one in a static program.
if(WIN32)
  set(netmesh_system_libraries kernel32 ntdll userenv ws2_32 dbghelp)
elseif(APPLE)
  set(netmesh_system_libraries iconv m)
else()
  set(netmesh_system_libraries util rt pthread m dl)
endif()

add_library(netmesh::netmesh SHARED IMPORTED GLOBAL)
set_target_properties(netmesh::netmesh PROPERTIES IMPORTED_LOCATION "${netmesh_shared_file}")
if(netmesh_soname)
  set_target_properties(netmesh::netmesh PROPERTIES IMPORTED_SONAME "${netmesh_soname}")
else()
  set_target_properties(netmesh::netmesh PROPERTIES IMPORTED_NO_SONAME TRUE)
endif()
if(netmesh_import_file)
  set_target_properties(netmesh::netmesh PROPERTIES IMPORTED_IMPLIB "${netmesh_import_file}")
endif()

add_library(netmesh::static STATIC IMPORTED GLOBAL)
set_target_properties(netmesh::static PROPERTIES
  IMPORTED_LOCATION "${netmesh_static_file}"
  INTERFACE_LINK_LIBRARIES "${netmesh_system_libraries}")

foreach(target netmesh::netmesh netmesh::static)
  target_include_directories(${target} INTERFACE "${netmesh_include_dir}")
  add_dependencies(${target} netmesh_cargo)
endforeach()

# The top-level project builds the library even where nothing links it.
if(netmesh_is_top_level)
  add_custom_target(netmesh_library ALL)
  add_dependencies(netmesh_library netmesh_cargo)
endif()
