# A build directory under a sanitizer, as scripts/sanitizers.sh makes it:
#
#   cmake -S . -B build/address -DCMAKE_BUILD_TYPE=RelWithDebInfo -DNETMESH_SANITIZERS=address,undefined
#
# builds the tests of the ABI only, linked with the static library, so that C, C++ and Rust share one
# allocator, the sanitizer's: it sees leaks and double frees of the library's memory too, and what the
# library reads and writes through memcpy and its like.
#
#   cmake ... -DNETMESH_SANITIZERS=thread -DNETMESH_INSTRUMENTED=ON -DNETMESH_CARGO_TARGET=... \
#         "-DNETMESH_CARGO_ENVIRONMENT=RUSTFLAGS=..."
#
# builds those that use threads, with the Rust code itself instrumented by those flags: without that
# the library's locks are out of sight, and whatever they guard is reported. No report is suppressed.
option(NETMESH_INSTRUMENTED "The Rust code is built for the same sanitizer")

add_compile_options("-fsanitize=${NETMESH_SANITIZERS}" -fno-sanitize-recover=all -fno-omit-frame-pointer)
add_link_options("-fsanitize=${NETMESH_SANITIZERS}")

# api_misuse asks for more memory than there is: here a limit of the allocator says so, and a limit of
# the address space would be below what the sanitizer's own tables take.
set(netmesh_sanitizer_environment
    "ASAN_OPTIONS=allocator_may_return_null=1:max_allocation_size_mb=700:detect_stack_use_after_return=1"
    "UBSAN_OPTIONS=print_stacktrace=1"
    "TSAN_OPTIONS=halt_on_error=1")

# Every access is watched: a quarter of the meshes will do.
set(netmesh_concurrency_arguments 16)

# The tests of threads under the thread sanitizer.
function(netmesh_thread_sanitizer_tests)
  netmesh_abi_test(concurrency ${netmesh_concurrency_arguments})
  if(NETMESH_INSTRUMENTED)
    set_source_files_properties(support/tsan_memory.c PROPERTIES
      COMPILE_OPTIONS "-fno-sanitize=all;-fno-builtin")
    target_sources(concurrency_static PRIVATE support/tsan_memory.c)
    add_executable(seen_race seen_race.cpp support/tsan_memory.c)
    target_link_libraries(seen_race PRIVATE netmesh_test_support netmesh::static Threads::Threads)
    netmesh_test(seen_race seen_race)
    set_tests_properties(seen_race PROPERTIES PASS_REGULAR_EXPRESSION "ThreadSanitizer: data race")
  endif()
endfunction()
