#pragma once

#include <string>
#include <vector>

namespace bergamo::benchmark
{

/// How every script for LIGGGHTS begins: spheres of a data file in a domain with fixed faces.
/// @param skin of its neighbour list [m]
std::string liggghts_begin(const std::string &data_file, double skin);

/// A property of materials. @param kind peratomtype, or peratomtypepair with the number of materials
std::string liggghts_property(const std::string &name, const std::string &kind, const std::vector<double> &values);

} // namespace bergamo::benchmark
