#pragma once

#include "fe_dealii/material/mooney_rivlin.h"
#include "fe_dealii/material/neo_hooke.h"
#include "fe_dealii/material/ogden.h"

#include <catch2/catch.hpp>

/// The laws of rubber that tests of laws and elements share.
namespace bergamo::fe
{

inline constexpr ElasticParameters rubber{.young_modulus = 1.5e6, .poisson_ratio = 0.45, .density = 1100};

inline NeoHooke neo_hooke()
{
  return NeoHooke(rubber);
}

inline MooneyRivlin mooney_rivlin()
{
  return MooneyRivlin({.elastic = rubber, .second_share = 0.2});
}

inline Ogden ogden()
{
  return Ogden(OgdenParameters());
}

/// Runs a check for each law.
template <class Check>
void for_each_law(const Check &check)
{
  SECTION("Neo-Hooke")
  {
    check(neo_hooke());
  }
  SECTION("Mooney-Rivlin")
  {
    check(mooney_rivlin());
  }
  SECTION("Ogden")
  {
    check(ogden());
  }
}

} // namespace bergamo::fe
