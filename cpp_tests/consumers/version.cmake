# One version: whatever tells one tells Cargo.toml's, and one ABI.
include("${CMAKE_CURRENT_LIST_DIR}/common.cmake")

function(require_version what found)
  require_equal("the version of ${what}" "${found}" "${version}")
  message(STATUS "${what}: ${found}")
endfunction()

# Sets the result to the text that `regex` catches in a file.
function(read_match path regex result)
  file(READ "${path}" text)
  if(NOT text MATCHES "${regex}")
    message(FATAL_ERROR "${path}: nothing like ${regex}")
  endif()
  set(${result} "${CMAKE_MATCH_1}" PARENT_SCOPE)
endfunction()

# Every package of the workspace.
run("${cargo}" metadata --manifest-path "${source_dir}/Cargo.toml" --no-deps --offline --format-version 1)
string(JSON count LENGTH "${run_output}" packages)
math(EXPR last "${count} - 1")
foreach(i RANGE ${last})
  string(JSON package GET "${run_output}" packages ${i} name)
  string(JSON found GET "${run_output}" packages ${i} version)
  require_version("package ${package}" "${found}")
endforeach()

# The headers: the installed one and the one that cargo's users have.
foreach(header "${prefix}/${include_dir}/netmesh.h" "${source_dir}/include/netmesh.h")
  foreach(part MAJOR MINOR PATCH)
    read_match("${header}" "\n#define NM_VERSION_${part} ([0-9]+)\n" ${part})
  endforeach()
  require_version("${header}" "${MAJOR}.${MINOR}.${PATCH}")
endforeach()
read_match("${prefix}/${include_dir}/netmesh.h" "\n#define NM_ABI_VERSION ([0-9]+)\n" abi)

# The library that runs, by the programs of the other tests: nm_version.
read_match("${scratch}/expected.txt" "^netmesh ([^:]+): " found)
require_version("the library in the command line" "${found}")
foreach(program mesher_shared mesher_static)
  run("${scratch}/find_package/${program}" "${points}" "${scratch}/version.off")
  string(REGEX REPLACE ":.*" "" found "${run_output}")
  require_equal("${program}" "${found}" "netmesh ${version}")
endforeach()

run("${prefix}/${program_dir}/netmesh" --version)
require_equal("netmesh --version" "${run_output}" "netmesh ${version}\n")
read_match("${prefix}/${manual_dir}/man1/netmesh.1" "\n\\.TH netmesh 1 [^\n]*\"netmesh ([^\"]+)\"" found)
require_version("the man page" "${found}")

read_match("${prefix}/${library_dir}/pkgconfig/netmesh.pc" "\nVersion: ([^\n]+)\n" found)
require_version("netmesh.pc" "${found}")
read_match("${prefix}/${library_dir}/cmake/netmesh/netmesh-config-version.cmake"
           "set\\(PACKAGE_VERSION \"([^\"]+)\"\\)" found)
require_version("netmesh-config-version.cmake" "${found}")

# The ABI: the header's, the library's name, and what cargo-c makes it of.
if(soname)
  set(shared "${prefix}/${library_dir}/libnetmesh.so.${version}")
  run("${readelf}" --dynamic "${shared}")
  if(NOT run_output MATCHES "soname: \\[([^]\n]+)\\]")
    message(FATAL_ERROR "${shared} has no name")
  endif()
  require_equal("the name of the library" "${CMAKE_MATCH_1}" "libnetmesh.so.${abi}")
endif()
read_match("${source_dir}/Cargo.toml" "\n\\[package\\.metadata\\.capi\\.library\\]\nversion = \"([0-9]+)\\." found)
require_equal("the ABI for cargo-c" "${found}" "${abi}")
