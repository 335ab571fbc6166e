#pragma once

#include "dem/core/error.h"

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace bergamo::dem
{

/// Places of particles in the arrays by their ids, which may have gaps.
class IdIndex
{
public:
  /// Throws ConfigError where an id occurs twice.
  void follow(const std::vector<std::int64_t> &ids)
  {
    ++n_orders_;
    place.clear();
    place.reserve(ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i)
      if (!place.emplace(ids[i], static_cast<std::int32_t>(i)).second)
        throw ConfigError("two particles have the id " + std::to_string(ids[i]) + ": give each one its own");
  }

  /// Grows whenever places may have changed.
  std::int64_t n_orders() const { return n_orders_; }

  bool has(const std::int64_t id) const { return place.contains(id); }

  /// Throws ConfigError for an id that no particle has.
  std::int32_t operator()(const std::int64_t id) const
  {
    const auto found = place.find(id);
    if (found == place.end())
      throw ConfigError("no particle has the id " + std::to_string(id) + ": it never was, or it has been removed");
    return found->second;
  }

private:
  std::unordered_map<std::int64_t, std::int32_t> place;
  std::int64_t n_orders_ = 0;
};

} // namespace bergamo::dem
