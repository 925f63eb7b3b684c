/* For the tests in C: ends the program with the place, the expression and the library's last message. */
#ifndef NETMESH_TESTS_REQUIRE_H
#define NETMESH_TESTS_REQUIRE_H

#include <netmesh.h>
#include <stdio.h>
#include <stdlib.h>

#define REQUIRE(expression)                                                                   \
    do {                                                                                      \
        if (!(expression)) {                                                                  \
            char message[512];                                                                \
            nm_last_error(message, sizeof message);                                           \
            fprintf(stderr, "%s:%d: FAILED: %s  [%s]\n", __FILE__, __LINE__, #expression, message); \
            exit(1);                                                                          \
        }                                                                                     \
    } while (0)

#endif
