include("${CMAKE_CURRENT_LIST_DIR}/../common.cmake")
build_with_checkout(fetch_content)
expect_the_mesh(fetch_content mesher)
