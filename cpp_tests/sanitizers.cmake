# A build directory under a sanitizer:
#
#   cmake -S . -B build/address -DCMAKE_BUILD_TYPE=RelWithDebInfo -DNETMESH_SANITIZERS=address,undefined
#
# builds the tests of the ABI only, linked with the static library, so that C, C++ and Rust share one
# allocator, the sanitizer's: it sees leaks and double frees of the library's memory too, and what the
# library reads and writes through memcpy and its like. The Rust code itself is not instrumented.
add_compile_options("-fsanitize=${NETMESH_SANITIZERS}" -fno-sanitize-recover=all -fno-omit-frame-pointer)
add_link_options("-fsanitize=${NETMESH_SANITIZERS}")

# api_misuse asks for more memory than there is: here a limit of the allocator says so, and a limit of
# the address space would be below what the sanitizer's own tables take.
set(netmesh_sanitizer_environment
    "ASAN_OPTIONS=allocator_may_return_null=1:max_allocation_size_mb=700:detect_stack_use_after_return=1"
    "UBSAN_OPTIONS=print_stacktrace=1"
    "TSAN_OPTIONS=halt_on_error=1")
