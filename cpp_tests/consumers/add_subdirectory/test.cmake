include("${CMAKE_CURRENT_LIST_DIR}/../common.cmake")
build_with_checkout(add_subdirectory)
expect_the_mesh(add_subdirectory mesher_shared mesher_static)
