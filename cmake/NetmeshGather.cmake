# Makes the ELF libraries that C and C++ programs link with out of those that cargo has built.
#
#   cmake -DNAME=... -DFROM=... -DTO=... -DHEADERS=... -DCOMPILER=... -DTARGET_OPTION=... -DOBJCOPY=...
#         -DAR=... [-DVERSION=... -DSONAME=...] -P NetmeshGather.cmake
#
# NAME is netmesh or netmesh_mpi, HEADERS those that declare its functions. The shared library, where there
# is one (VERSION), lies beside the names of its ABI and its link. The archive becomes one object in
# which every name but the header's functions is local: a Rust archive brings Rust's standard library
# along, and a program with two such archives would have its names twice (rust_eh_personality) or,
# where the linker lets it pass, one library's panics handled by the other's runtime. The copy of
# LLVM's bitcode goes too, which only Rust compilers can use.

include("${CMAKE_CURRENT_LIST_DIR}/NetmeshDeclared.cmake")

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# A link that is right stays: programs may be looking for it now.
function(link name target)
  set(found "")
  if(IS_SYMLINK "${TO}/${name}")
    file(READ_SYMLINK "${TO}/${name}" found)
  endif()
  if(NOT found STREQUAL target)
    file(CREATE_LINK "${target}" "${TO}/${name}" SYMBOLIC)
  endif()
endfunction()

function(gather_shared)
  set(versioned "libnetmesh.so.${VERSION}")
  run("${CMAKE_COMMAND}" -E copy_if_different "${FROM}/libnetmesh.so" "${TO}/${versioned}")
  link("${SONAME}" "${versioned}")
  link(libnetmesh.so "${SONAME}")
endfunction()

function(make_static functions)
  list(TRANSFORM functions PREPEND "-Wl,--undefined=" OUTPUT_VARIABLE roots)
  list(TRANSFORM functions PREPEND "--keep-global-symbol=" OUTPUT_VARIABLE kept)
  set(object "${TO}/${NAME}.o")
  set(archive "${TO}/lib${NAME}.a")
  # The compiler knows which linker to call, and how.
  run("${COMPILER}" ${TARGET_OPTION} -r -nostdlib -Wl,--build-id=none ${roots} -o "${object}" "${FROM}/lib${NAME}.a")
  # Linkers take one of several groups of the same name, local or not: this one's name becomes its own.
  run("${OBJCOPY}" --redefine-sym=DW.ref.rust_eh_personality=DW.ref.${NAME}_eh_personality ${kept}
      --remove-section=.llvmbc --remove-section=.llvmcmd "${object}")
  file(REMOVE "${archive}")
  run("${AR}" qcs "${archive}" "${object}")
  file(REMOVE "${object}")
endfunction()

# Made anew where cargo's archive, the functions or this file differ from what it was made of. Times
# would not tell: cargo may go back to an older file.
function(gather_static)
  set(functions "")
  foreach(header IN LISTS HEADERS)
    declared_functions("${header}" declared)
    list(APPEND functions ${declared})
  endforeach()
  file(MD5 "${FROM}/lib${NAME}.a" archive_hash)
  file(MD5 "${CMAKE_CURRENT_LIST_FILE}" script_hash)
  set(made_from "${archive_hash} ${script_hash} ${functions}")
  set(record "${TO}/lib${NAME}.a.made_from")
  set(recorded "")
  if(EXISTS "${record}" AND EXISTS "${TO}/lib${NAME}.a")
    file(READ "${record}" recorded)
  endif()
  if(NOT recorded STREQUAL made_from)
    file(REMOVE "${record}")
    make_static("${functions}")
    file(WRITE "${record}" "${made_from}")
  endif()
endfunction()

file(MAKE_DIRECTORY "${TO}")
if(VERSION)
  gather_shared()
endif()
gather_static()
