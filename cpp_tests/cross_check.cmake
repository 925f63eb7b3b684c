# The cross-check with CGAL: a test for each input, dimension and kind of output, so that ctest -j
# runs them side by side.

if(NOT TARGET netmesh_peer_cgal)
  netmesh_skipped_test(cgal_cross_check "CGAL >= 5.5 or Eigen3 is not installed")
  return()
endif()

# A library of its own: CGAL takes long to compile, and only once. It also runs for long.
add_library(netmesh_cgal_reference STATIC
  cgal/certify.cpp cgal/reference.cpp cgal/reference_2.cpp cgal/reference_3.cpp cgal/reference_4.cpp)
target_compile_options(netmesh_cgal_reference PRIVATE $<$<CONFIG:Release>:-O3>)
target_include_directories(netmesh_cgal_reference PUBLIC cgal support "${netmesh_include_dir}")
target_link_libraries(netmesh_cgal_reference PRIVATE netmesh_peer_cgal)

foreach(program cgal_cross_check certifier_self_test)
  add_executable(${program} ${program}.cpp)
  target_link_libraries(${program} PRIVATE
    netmesh_test_support netmesh_cgal_reference netmesh::netmesh)
endforeach()
netmesh_test(certifier_self_test certifier_self_test)

function(netmesh_cross_check input dim)
  foreach(output ${ARGN})
    netmesh_test(cgal.${input}.${dim}d.${output} cgal_cross_check ${input} ${dim} ${output})
    set_tests_properties(cgal.${input}.${dim}d.${output} PROPERTIES LABELS cgal COST ${dim})
    # Lines in space fill up with Steiner points: first in, or they are what all others wait for.
    if(dim GREATER 2 AND input MATCHES "collinear|skew")
      set_tests_properties(cgal.${input}.${dim}d.${output} PROPERTIES COST 100)
    endif()
  endforeach()
endfunction()

foreach(dim 2 3 4)
  foreach(input uniform gaussian)
    netmesh_cross_check(${input} ${dim} hierarchical well_spaced delaunay)
  endforeach()
  foreach(input sphere grid collinear coplanar duplicates two_skew_lines)
    # In the plane every input is coplanar.
    if(NOT (input STREQUAL "coplanar" AND dim EQUAL 2))
      netmesh_cross_check(${input} ${dim} hierarchical well_spaced)
    endif()
  endforeach()
endforeach()

# Public data; skipped where the files are not at hand.
foreach(file airports_us_lonlat.xy exoplanets_2d.xy gudhi_spiral2d.xy)
  netmesh_cross_check(${file} 2 hierarchical well_spaced)
endforeach()
foreach(file dso_unit_sphere.xyz isprs_samp11_utm.xyz pdb_4hhb_protein.xyz usgs_quakes_week.xyz)
  netmesh_cross_check(${file} 3 hierarchical well_spaced)
endforeach()
foreach(file iris_4d.csv penguins_4d.csv)
  netmesh_cross_check(${file} 4 hierarchical well_spaced)
endforeach()
