// One case with one output, tried in a process of its own.
#ifndef NETMESH_BREAKERS_TRIAL_HPP
#define NETMESH_BREAKERS_TRIAL_HPP

#include <cstdint>
#include <string>

#include "cases.hpp"
#include "netmesh.h"

// Stages that a trial came to; the last one means that it came to its end.
enum class Stage : std::int32_t { generating, creating, running, validating, done };

// Plain data in memory that parent and child share: it tells how far a dead child had come.
struct Outcome {
    Stage stage;
    std::int32_t signal;     // that ended the child, 0 if none
    std::int32_t exit_code;  // of a child that ended by itself
    nm_status status;        // of the first call that did not answer NM_OK, or NM_OK
    char message[256];       // of that call
    std::uint64_t inputs, inputs_kept;
    std::uint64_t vertices, precision_limited;
    std::uint32_t certificate_level;
    std::uint64_t violations;
    char violation[160];
    double seconds;               // of nm_mesh_create and nm_run
    std::uint64_t heap_bytes;     // the most that they held at a time
    std::uint64_t resident_bytes; // the most that the process had until then
};

struct Trial {
    Case what;
    nm_output output = NM_OUTPUT_HIERARCHICAL;
    std::uint64_t max_vertices = 0;
    unsigned wall_limit = 0;  // seconds, of the whole child
};

const char* stage_name(Stage stage);

// In this process, which may not survive it.
void run_trial(const Trial& trial, Outcome& outcome);

#endif
