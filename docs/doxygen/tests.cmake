# The target `docs`, and the test that the headers make pages without a warning.
find_program(NETMESH_DOXYGEN doxygen)
find_program(NETMESH_SED sed)
if(NETMESH_DOXYGEN AND NETMESH_SED)
  add_custom_target(docs
    COMMAND "${CMAKE_COMMAND}" -E make_directory target
    COMMAND "${NETMESH_DOXYGEN}" docs/doxygen/Doxyfile
    WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}"
    COMMENT "target/doxygen/html/index.html"
    VERBATIM)
  netmesh_test(doxygen "${CMAKE_COMMAND}" "-DDOXYGEN=${NETMESH_DOXYGEN}" "-DSOURCE=${PROJECT_SOURCE_DIR}"
               "-DSCRATCH=${scratch_dir}/doxygen" -P "${CMAKE_CURRENT_LIST_DIR}/check.cmake")
else()
  netmesh_skipped_test(doxygen "doxygen or sed is not installed")
endif()
