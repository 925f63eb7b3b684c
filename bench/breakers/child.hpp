// A trial in a child process: whatever becomes of it, the parent goes on.
#ifndef NETMESH_BREAKERS_CHILD_HPP
#define NETMESH_BREAKERS_CHILD_HPP

#include <functional>
#include <vector>

#include "trial.hpp"

// Outcomes in the order of the trials, jobs of them at a time. finished is told each one's index as
// it ends.
std::vector<Outcome> run_in_children(const std::vector<Trial>& trials, unsigned jobs,
                                     const std::function<void(std::size_t, const Outcome&)>& finished);

#endif
