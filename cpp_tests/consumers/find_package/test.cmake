include("${CMAKE_CURRENT_LIST_DIR}/../common.cmake")
build_with_cmake(find_package "-DCMAKE_PREFIX_PATH=${prefix}")
expect_the_mesh(find_package mesher_shared mesher_static)
