// Checks that a call throws netmesh::error with a status, and a message with a word in it.
#ifndef NETMESH_TESTS_EXPECT_ERROR_HPP
#define NETMESH_TESTS_EXPECT_ERROR_HPP

#include <netmesh.hpp>

#include <string>

#include "check.hpp"

template <class Call>
void expect_error(int line, nm_status expected, const std::string& word, Call call) {
    try {
        call();
        check::that(false, __FILE__, line, "it throws", word);
    } catch (const netmesh::error& error) {
        check::that(error.status() == expected, __FILE__, line, "status", error.status_name());
        check::that(std::string(error.what()).find(word) != std::string::npos, __FILE__, line, "message",
                    error.what());
    }
}

#endif
