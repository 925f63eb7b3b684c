# Install rules of the library on MPI: the archive, its header, `netmesh_mpi.pc`, the program with its man
# page, and the page that tells of both. find_package(netmesh COMPONENTS mpi) looks for the archive. All
# of it is the component `mpi`, which needs the component `headers`.
install(FILES "${netmesh_mpi_archive}" DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT mpi)
install(FILES "${netmesh_mpi_include_dir}/netmesh_mpi.h" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
        COMPONENT mpi)
install(PROGRAMS "${netmesh_mpi_program}" DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT mpi)
netmesh_strip_installed(mpi --strip-unneeded "${CMAKE_INSTALL_LIBDIR}" "${netmesh_mpi_archive}")
netmesh_strip_installed(mpi --strip-all "${CMAKE_INSTALL_BINDIR}" "${netmesh_mpi_program}")

configure_file("${PROJECT_SOURCE_DIR}/mpi/netmesh-mpi.1.in" "${CMAKE_CURRENT_BINARY_DIR}/netmesh-mpi.1" @ONLY)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/netmesh-mpi.1" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1"
        COMPONENT mpi)

# Links of the page lead to where the pages and the header are installed.
set(netmesh_mpi_doc_dir "${CMAKE_INSTALL_DATAROOTDIR}/doc/netmesh/mpi")
get_filename_component(netmesh_mpi_full_doc_dir "${netmesh_mpi_doc_dir}" ABSOLUTE BASE_DIR "${CMAKE_INSTALL_PREFIX}")
file(RELATIVE_PATH netmesh_include_from_doc "${netmesh_mpi_full_doc_dir}" "${CMAKE_INSTALL_FULL_INCLUDEDIR}")
file(READ "${PROJECT_SOURCE_DIR}/mpi/README.md" netmesh_mpi_page)
string(REPLACE "](../docs/" "](../" netmesh_mpi_page "${netmesh_mpi_page}")
string(REPLACE "](include/" "](${netmesh_include_from_doc}/" netmesh_mpi_page "${netmesh_mpi_page}")
file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/mpi/README.md" "${netmesh_mpi_page}")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/mpi/README.md")
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/mpi/README.md" DESTINATION "${netmesh_mpi_doc_dir}" COMPONENT mpi)

if(NOT WIN32)
  configure_file("${CMAKE_CURRENT_LIST_DIR}/netmesh_mpi.pc.in" "${CMAKE_CURRENT_BINARY_DIR}/netmesh_mpi.pc" @ONLY)
  install(FILES "${CMAKE_CURRENT_BINARY_DIR}/netmesh_mpi.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig"
          COMPONENT mpi)
endif()
