// The outcomes as a Markdown table.
#ifndef NETMESH_BREAKERS_TABLE_HPP
#define NETMESH_BREAKERS_TABLE_HPP

#include <string>

#include "trial.hpp"

std::string table_head();
std::string table_row(const Trial& trial, const Outcome& outcome, const Outcome& generic);

// "hierarchical" or "well-spaced".
const char* output_name(nm_output output);

#endif
