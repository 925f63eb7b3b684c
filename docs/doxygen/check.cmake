# Makes the pages in SCRATCH: of all headers without a warning, and of netmesh.h alone, in which
# everything must be documented too. Doxygen answers nonzero where it has warned.
file(READ "${SOURCE}/docs/doxygen/Doxyfile" settings)

function(make_pages name)
  file(REMOVE_RECURSE "${SCRATCH}/${name}")
  file(MAKE_DIRECTORY "${SCRATCH}/${name}")
  string(JOIN "\n" more "OUTPUT_DIRECTORY = ${SCRATCH}/${name}" ${ARGN})
  file(WRITE "${SCRATCH}/${name}/Doxyfile" "${settings}\n${more}\n")
  execute_process(COMMAND "${DOXYGEN}" "${SCRATCH}/${name}/Doxyfile" WORKING_DIRECTORY "${SOURCE}"
                  RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "doxygen answered ${failed}")
  endif()
endfunction()

make_pages(all)
foreach(page netmesh_8h structnm__options classnetmesh_1_1mesh)
  if(NOT EXISTS "${SCRATCH}/all/html/${page}.html")
    message(FATAL_ERROR "there is no page ${page}.html")
  endif()
endforeach()
make_pages(strict "INPUT = include/netmesh.h" "EXTRACT_ALL = NO")
