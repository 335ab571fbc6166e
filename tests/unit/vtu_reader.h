#pragma once

#include <catch2/catch.hpp>

#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <vector>

/// Just enough of a reader: the arrays by name from the raw binary part.
struct VtuReader
{
  std::string xml;
  std::string binary;
  std::size_t n_points = 0, n_cells = 0;
  std::map<std::string, std::size_t> offset;

  explicit VtuReader(const std::string &bytes)
  {
    const std::string mark = "<AppendedData encoding=\"raw\">\n_", end = "\n  </AppendedData>\n</VTKFile>\n";
    const std::size_t start = bytes.find(mark);
    REQUIRE(start != std::string::npos);
    REQUIRE(bytes.ends_with(end));
    xml = bytes.substr(0, start);
    binary = bytes.substr(start + mark.size(), bytes.size() - end.size() - start - mark.size());
    n_points = std::stoul(value_after("NumberOfPoints=\"", 0));
    n_cells = std::stoul(value_after("NumberOfCells=\"", 0));
    for (std::size_t at = xml.find("<DataArray"); at != std::string::npos; at = xml.find("<DataArray", at + 1))
      offset[value_after("Name=\"", at)] = std::stoul(value_after("offset=\"", at));
  }

  std::string value_after(const std::string &key, const std::size_t from) const
  {
    const std::size_t start = xml.find(key, from) + key.size();
    return xml.substr(start, xml.find('"', start) - start);
  }

  template <class Value>
  std::vector<Value> array(const std::string &name) const
  {
    REQUIRE(offset.count(name) == 1);
    const char *start = binary.data() + offset.at(name);
    std::uint64_t size;
    std::memcpy(&size, start, sizeof size);
    REQUIRE(offset.at(name) + sizeof size + size <= binary.size());
    REQUIRE(size % sizeof(Value) == 0);
    std::vector<Value> values(size / sizeof(Value));
    if (size > 0)
      std::memcpy(values.data(), start + sizeof size, size);
    return values;
  }
};
