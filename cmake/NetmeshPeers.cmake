# The peers that tests and benchmarks hold netmesh against. Each may be missing: what needs it is
# then reported as skipped, never dropped in silence.

find_package(CGAL 5.5 QUIET)
# For CGAL's kernels of dimension 4 and up; by its own config file, CGAL's module has no target.
find_package(Eigen3 3.3 QUIET NO_MODULE)
if(CGAL_FOUND AND Eigen3_FOUND)
  add_library(netmesh_peer_cgal INTERFACE)
  target_link_libraries(netmesh_peer_cgal INTERFACE CGAL::CGAL Eigen3::Eigen)
else()
  message(STATUS "CGAL >= 5.5 or Eigen3 not found: the cross-checks will be skipped")
endif()

find_path(NETMESH_TETGEN_INCLUDE_DIR tetgen.h)
find_library(NETMESH_TETGEN_LIBRARY NAMES tet)
if(NETMESH_TETGEN_INCLUDE_DIR AND NETMESH_TETGEN_LIBRARY)
  add_library(netmesh_peer_tetgen INTERFACE)
  target_include_directories(netmesh_peer_tetgen SYSTEM INTERFACE "${NETMESH_TETGEN_INCLUDE_DIR}")
  target_compile_definitions(netmesh_peer_tetgen INTERFACE TETLIBRARY)
  target_link_libraries(netmesh_peer_tetgen INTERFACE "${NETMESH_TETGEN_LIBRARY}")
else()
  message(STATUS "TetGen (libtet) not found: the table of mesh sizes will be skipped")
endif()
