// Makes a failing case small.
#ifndef NETMESH_BREAKERS_SHRINK_HPP
#define NETMESH_BREAKERS_SHRINK_HPP

#include "trial.hpp"

// A subset of the trial's points, in their order, that fails with the same status or signal and from
// which no single point can be left out.
PointSet shrink(const Trial& trial, unsigned jobs);

#endif
