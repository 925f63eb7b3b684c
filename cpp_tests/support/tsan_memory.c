/* What rustc's code under the thread sanitizer calls for memory operations, and runtimes before GCC 13
 * and Clang 15 do not have: the C library's functions, which those runtimes intercept. Weak, so that
 * a runtime's own come first; compiled without the sanitizer, whose code would call these here. */
#include <string.h>

__attribute__((weak)) void *__tsan_memcpy(void *to, const void *from, size_t size) {
    return memcpy(to, from, size);
}

__attribute__((weak)) void *__tsan_memmove(void *to, const void *from, size_t size) {
    return memmove(to, from, size);
}

__attribute__((weak)) void *__tsan_memset(void *to, int value, size_t size) {
    return memset(to, value, size);
}
