// Checks that fail loudly: the expression, the place and the values go to stderr, the process ends
// with 1. CHECK counts and goes on, REQUIRE stops at once. Never compiled out, thread-safe.
#ifndef NETMESH_TESTS_CHECK_HPP
#define NETMESH_TESTS_CHECK_HPP

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <mutex>
#include <sstream>
#include <string>

#include "netmesh.h"

#if defined(__has_feature)
#define NETMESH_TESTS_HAS_FEATURE(name) __has_feature(name)
#else
#define NETMESH_TESTS_HAS_FEATURE(name) 0
#endif

namespace check {

// Sanitizers that this program was built with, for a check that the sanitizer's runtime does not bear.
#if defined(__SANITIZE_ADDRESS__) || NETMESH_TESTS_HAS_FEATURE(address_sanitizer)
constexpr bool address_sanitizer = true;
#else
constexpr bool address_sanitizer = false;
#endif

inline std::atomic<unsigned long> performed{0};
inline std::atomic<unsigned long> failed{0};

// Place that the test is at; set by main between checks, part of every report.
inline std::string context;

// A broken loop must not bury the first failure under a million copies.
constexpr unsigned long most_printed = 40;

inline void report(const char* file, int line, const std::string& what) {
    static std::mutex printing;
    if (++failed <= most_printed) {
        const std::lock_guard<std::mutex> lock(printing);
        std::cerr << file << ":" << line << ": FAILED: " << what;
        if (!context.empty()) std::cerr << "  (" << context << ")";
        std::cerr << std::endl;
    }
}

inline bool that(bool holds, const char* file, int line, const char* expression,
                 const std::string& values = {}) {
    ++performed;
    if (!holds) {
        report(file, line, values.empty() ? expression : std::string(expression) + "  [" + values + "]");
    }
    return holds;
}

template <class A, class B>
std::string values(const A& a, const B& b) {
    std::ostringstream text;
    text.precision(17);
    text << a << " against " << b;
    return text.str();
}

inline std::string last_error() {
    std::string message(nm_last_error(nullptr, 0), '\0');
    nm_last_error(message.data(), message.size());
    while (!message.empty() && message.back() == '\0') message.pop_back();
    return message;
}

inline bool status(nm_status actual, nm_status expected, const char* file, int line,
                   const char* expression) {
    const bool holds = actual == expected;
    std::string text;
    if (!holds) {
        text = std::string(nm_status_name(actual)) + " instead of " + nm_status_name(expected)
               + ", message: " + last_error();
    }
    return that(holds, file, line, expression, text);
}

// The end of every main: prints the sum, returns the exit code.
inline int result(const std::string& test) {
    std::cout << test << ": " << performed << " checks, " << failed << " failed" << std::endl;
    if (performed == 0) std::cerr << test << ": FAILED: nothing was checked" << std::endl;
    return failed == 0 && performed > 0 ? 0 : 1;
}

// Exit code that ctest knows as SKIP_RETURN_CODE.
constexpr int skip_code = 77;

inline int skip(const std::string& reason) {
    std::cout << "SKIP: " << reason << std::endl;
    return skip_code;
}

}  // namespace check

#define CHECK(expression) check::that(static_cast<bool>(expression), __FILE__, __LINE__, #expression)

#define CHECK_SAYING(expression, text) \
    check::that(static_cast<bool>(expression), __FILE__, __LINE__, #expression, text)

#define CHECK_EQUAL(a, b) \
    check::that((a) == (b), __FILE__, __LINE__, #a " == " #b, check::values((a), (b)))

#define CHECK_AT_MOST(a, b) \
    check::that((a) <= (b), __FILE__, __LINE__, #a " <= " #b, check::values((a), (b)))

#define CHECK_STATUS(call, expected) \
    check::status((call), (expected), __FILE__, __LINE__, #call)

#define REQUIRE(expression)                                  \
    do {                                                     \
        if (!CHECK(expression)) std::exit(1);                \
    } while (false)

#define REQUIRE_OK(call)                                     \
    do {                                                     \
        if (!CHECK_STATUS(call, NM_OK)) std::exit(1);        \
    } while (false)

#endif
