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

set(NETMESH_CARGO_TARGET "" CACHE STRING "The triple to build for; empty: this machine's")
set(NETMESH_CARGO_ENVIRONMENT "" CACHE STRING "Variables for cargo, as NAME=value;NAME=value")
if(NETMESH_CARGO_TARGET)
  set(netmesh_target_arguments --target "${NETMESH_CARGO_TARGET}")
endif()

set(netmesh_library_dir "${NETMESH_CARGO_TARGET_DIR}/${NETMESH_CARGO_TARGET}/release")
cmake_path(NORMAL_PATH netmesh_library_dir)
set(netmesh_include_dir "${CMAKE_CURRENT_SOURCE_DIR}/include")
if(WIN32)
  set(netmesh_shared_file "${netmesh_library_dir}/netmesh.dll")
  set(netmesh_import_file "${netmesh_library_dir}/netmesh.dll.lib")
  set(netmesh_static_file "${netmesh_library_dir}/netmesh.lib")
else()
  set(netmesh_shared_file
      "${netmesh_library_dir}/libnetmesh${CMAKE_SHARED_LIBRARY_SUFFIX}")
  set(netmesh_import_file "")
  set(netmesh_static_file "${netmesh_library_dir}/libnetmesh.a")
endif()

# The name that programs ask for at run time is that of the ABI (build.rs gives it to the library):
# beside what cargo builds it is a link, so that programs of this build tree start.
set(netmesh_soname "")
if(UNIX AND NOT APPLE)
  file(STRINGS "${netmesh_include_dir}/netmesh.h" netmesh_abi_line
       REGEX "^#define NM_ABI_VERSION [0-9]+" LIMIT_COUNT 1)
  string(REGEX MATCH "[0-9]+$" netmesh_abi_version "${netmesh_abi_line}")
  set(netmesh_soname "libnetmesh.so.${netmesh_abi_version}")
  set(netmesh_link_soname COMMAND "${CMAKE_COMMAND}" -E create_symlink
      libnetmesh.so "${netmesh_library_dir}/${netmesh_soname}")
endif()

add_custom_target(netmesh_cargo
  COMMAND "${CMAKE_COMMAND}" -E env ${NETMESH_CARGO_ENVIRONMENT} "${NETMESH_CARGO}" build --release --locked --package netmesh --lib
          --manifest-path "${CMAKE_CURRENT_SOURCE_DIR}/Cargo.toml"
          --target-dir "${NETMESH_CARGO_TARGET_DIR}" ${netmesh_target_arguments}
  ${netmesh_link_soname}
  WORKING_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}"
  BYPRODUCTS "${netmesh_shared_file}" "${netmesh_static_file}" ${netmesh_import_file}
  COMMENT "Building the Rust library with cargo"
  USES_TERMINAL
  VERBATIM)

# What `cargo rustc --release --crate-type staticlib -- --print native-static-libs` names.
if(WIN32)
  set(netmesh_system_libraries kernel32 ntdll userenv ws2_32 dbghelp)
elseif(APPLE)
  set(netmesh_system_libraries iconv m)
else()
  set(netmesh_system_libraries gcc_s util rt pthread m dl)
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
