# The programs of docs/tutorial.md and docs/recipes.md, each a test: they check what they made, and
# answer 0 if all was right. tests/pages.rs compares the pages with these files.

# netmesh_page_example(<language> <name> [<argument>...])
function(netmesh_page_example language name)
  if(language STREQUAL "c")
    set(libraries "$<$<NOT:$<BOOL:${WIN32}>>:m>")
  endif()
  add_executable(page_${language}_${name} "${PROJECT_SOURCE_DIR}/examples/${language}/${name}.${language}")
  target_link_libraries(page_${language}_${name} PRIVATE netmesh::netmesh ${libraries})
  netmesh_test(page.${language}.${name} page_${language}_${name} ${ARGN})
endfunction()

foreach(name first_mesh options arrays queries quality domains recipes)
  netmesh_page_example(c ${name})
endforeach()
netmesh_page_example(c exports "${scratch_dir}")
file(WRITE "${scratch_dir}/draw.xy" "0 0\n1 0\n0 1\n1 1\n0.5 0.50001\n0.5 0.50002\n")
netmesh_page_example(c draw "${scratch_dir}/draw.xy" "${scratch_dir}/draw.svg")

add_test(NAME page.python.mesh_array COMMAND "${CMAKE_COMMAND}"
         "-DSCRIPT=${PROJECT_SOURCE_DIR}/examples/python/mesh_array.py" "-DLIBRARY=${netmesh_shared_file}"
         -P "${CMAKE_CURRENT_LIST_DIR}/python.cmake")
set_tests_properties(page.python.mesh_array PROPERTIES SKIP_REGULAR_EXPRESSION "SKIP: " TIMEOUT 300)

foreach(name first_mesh control queries facets)
  netmesh_page_example(cpp ${name})
endforeach()
netmesh_page_example(cpp results "${scratch_dir}")
