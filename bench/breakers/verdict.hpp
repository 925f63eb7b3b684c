// Judgement of a trial: the outcomes that count as failures.
#ifndef NETMESH_BREAKERS_VERDICT_HPP
#define NETMESH_BREAKERS_VERDICT_HPP

#include <string>

#include "trial.hpp"

// Memory is allowed to be this many times that of the generic case.
constexpr double most_memory_ratio = 4.0;

// The memory of a trial against that of uniform points of the same number, dimension and output:
// as it is, or, where the mesh has more vertices than the generic one, per vertex. A run that
// answered NM_LIMIT made as many vertices as it was allowed to.
double heap_ratio(const Trial& trial, const Outcome& outcome, const Outcome& generic);
double resident_ratio(const Trial& trial, const Outcome& outcome, const Outcome& generic);

// One clause about what is wrong, empty if nothing is.
std::string failure(const Trial& trial, const Outcome& outcome, const Outcome& generic);

// The part of failure that needs no generic case: all but the memory.
std::string failure_of_itself(const Trial& trial, const Outcome& outcome);

#endif
