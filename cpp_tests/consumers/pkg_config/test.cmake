include("${CMAKE_CURRENT_LIST_DIR}/../common.cmake")
build_with_make(pkg_config)
expect_the_mesh(pkg_config mesher_shared mesher_archive mesher_static)
