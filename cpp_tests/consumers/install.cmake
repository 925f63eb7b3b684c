# Sets the other tests up: installs, looks whether everything is there, moves it elsewhere, and lets the
# installed command line mesh the points.
include("${CMAKE_CURRENT_LIST_DIR}/common.cmake")

file(REMOVE_RECURSE "${scratch}")
run("${CMAKE_COMMAND}" --install "${build_dir}" --prefix "${scratch}/prefix")
file(RENAME "${scratch}/prefix" "${prefix}")

file(GLOB_RECURSE headers RELATIVE "${source_dir}/include" "${source_dir}/include/*.h" "${source_dir}/include/*.hpp")
list(TRANSFORM headers PREPEND "${include_dir}/")
file(GLOB_RECURSE pages RELATIVE "${source_dir}/docs" "${source_dir}/docs/*.md" "${source_dir}/docs/*.svg"
     "${source_dir}/docs/*.png")
list(TRANSFORM pages PREPEND "${data_dir}/doc/netmesh/")
set(expected ${headers} ${pages}
    "${program_dir}/netmesh"
    "${manual_dir}/man1/netmesh.1"
    "${data_dir}/licenses/netmesh/LICENSE-APACHE"
    "${data_dir}/licenses/netmesh/LICENSE-MIT"
    "${library_dir}/${shared_name}"
    "${library_dir}/${static_name}"
    "${library_dir}/cmake/netmesh/netmesh-config-version.cmake"
    "${library_dir}/cmake/netmesh/netmesh-config.cmake"
    "${library_dir}/pkgconfig/netmesh.pc")
if(soname)
  list(APPEND expected "${library_dir}/${soname}" "${library_dir}/libnetmesh.so")
endif()
if(has_mpi)
  list(APPEND expected
      "${library_dir}/libnetmesh_mpi.a"
      "${include_dir}/netmesh_mpi.h"
      "${library_dir}/pkgconfig/netmesh_mpi.pc"
      "${program_dir}/netmesh-mpi"
      "${manual_dir}/man1/netmesh-mpi.1"
      "${data_dir}/doc/netmesh/mpi/README.md")
endif()
list(SORT expected)
file(GLOB_RECURSE installed RELATIVE "${prefix}" "${prefix}/*")
list(SORT installed)
require_equal("installed" "${installed}" "${expected}")
list(LENGTH installed count)
message(STATUS "${count} files installed")

# The links are links.
foreach(name IN ITEMS "${soname}" libnetmesh.so)
  if(soname AND NOT IS_SYMLINK "${prefix}/${library_dir}/${name}")
    message(FATAL_ERROR "${name} is a copy")
  endif()
endforeach()

# Libraries and programs have no line tables, unless these are asked for.
set(size 0)
foreach(name "${library_dir}/${shared_name}" "${library_dir}/${static_name}" "${program_dir}/netmesh")
  if(readelf AND soname)
    run("${readelf}" --section-headers --wide "${prefix}/${name}")
    # A program keeps .debug_gdb_scripts, which is loaded with it.
    string(FIND "${run_output}" ".debug_line" place)
    if(NOT has_symbols AND NOT place EQUAL -1)
      message(FATAL_ERROR "${name} is not stripped")
    endif()
  endif()
  file(SIZE "${prefix}/${name}" bytes)
  math(EXPR size "${size} + ${bytes}")
endforeach()
math(EXPR size "${size} / 1000000")
message(STATUS "libraries and program have ${size} MB")

# Every page that a header cites is there.
set(cited "")
foreach(header IN LISTS headers)
  file(STRINGS "${prefix}/${header}" lines REGEX "docs/[a-z_]+\\.md")
  foreach(line IN LISTS lines)
    string(REGEX MATCH "docs/([a-z_]+\\.md)" unused "${line}")
    list(APPEND cited "${CMAKE_MATCH_1}")
  endforeach()
endforeach()
foreach(page IN LISTS cited)
  if(NOT EXISTS "${prefix}/${data_dir}/doc/netmesh/${page}")
    message(FATAL_ERROR "a header cites docs/${page}, which is not installed")
  endif()
endforeach()
list(LENGTH cited count)
if(count EQUAL 0)
  message(FATAL_ERROR "no header cites a page: this test sees nothing")
endif()

# Nobody's machine is in what others read.
file(GLOB_RECURSE texts "${prefix}/${library_dir}/*.cmake" "${prefix}/${library_dir}/*.pc" "${prefix}/${manual_dir}/*")
foreach(text IN LISTS texts)
  file(READ "${text}" content)
  string(FIND "${content}" "${scratch}" place)
  string(FIND "${content}" "${source_dir}" source_place)
  if(NOT place EQUAL -1 OR NOT source_place EQUAL -1)
    message(FATAL_ERROR "${text} names a directory of the build")
  endif()
endforeach()

run("${prefix}/${program_dir}/netmesh" "${points}" --output "${scratch}/expected.off" --json -)
set(line "netmesh ")
string(JSON found GET "${run_output}" version)
string(APPEND line "${found}: ")
foreach(count inputs vertices simplices domains)
  string(JSON ${count} GET "${run_output}" counts ${count})
endforeach()
if(NOT (vertices GREATER inputs AND simplices GREATER vertices AND domains GREATER 1))
  message(FATAL_ERROR "this is no mesh to compare others with:\n${run_output}")
endif()
file(WRITE "${scratch}/expected.txt"
     "netmesh ${found}: ${inputs} points, ${vertices} vertices, ${simplices} simplices, ${domains} domains\n")
