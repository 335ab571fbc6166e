#pragma once

#include "dem/core/types.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <experimental/simd>
#include <sleef.h>

/// SIMD packs of doubles and the few functions that a kernel templated over Real (double or a pack) needs.
///
/// A Pack is as wide as the instruction set of the build, 8 with AVX-512, 4 with AVX, 2 with SSE2; Lanes<n> has n lanes
/// in any build. Every operation works lane by lane, so what a lane holds never depends on its neighbours: results do
/// not depend on how work was batched.
/// This file and pack_vectors.h are the only ones that know the vector library.
namespace bergamo
{

/// A pack of n doubles, in as few registers as hold it; with the width of the build's registers it is a Pack.
template <int n>
using Lanes = std::experimental::simd<double, std::experimental::simd_abi::deduce_t<double, n>>;
template <class Abi>
using PackOf = std::experimental::simd<double, Abi>;
template <class Abi>
using MaskOfPack = std::experimental::simd_mask<double, Abi>;

using Pack = std::experimental::native_simd<double>;
inline constexpr int pack_width = static_cast<int>(Pack::size());

/// Small functions of packs: a call would spill every register.
#define BERGAMO_INLINE [[gnu::always_inline]] inline

namespace math
{

template <class Real>
struct MaskOf
{
  using type = typename Real::mask_type;
};
template <>
struct MaskOf<double>
{
  using type = bool;
};
/// Result of a comparison: bool, or one a lane.
template <class Real>
using Mask = typename MaskOf<Real>::type;

BERGAMO_INLINE bool any(const bool mask)
{
  return mask;
}
template <class Abi>
BERGAMO_INLINE bool any(const MaskOfPack<Abi> &mask)
{
  return std::experimental::any_of(mask);
}

BERGAMO_INLINE double select(const bool mask, const double yes, const double no)
{
  return mask ? yes : no;
}
template <class Abi>
BERGAMO_INLINE PackOf<Abi> select(const MaskOfPack<Abi> &mask, const PackOf<Abi> &yes, PackOf<Abi> no)
{
  where(mask, no) = yes;
  return no;
}
template <class Real>
BERGAMO_INLINE Vector3<Real> select(const Mask<Real> &mask, const Vector3<Real> &yes, const Vector3<Real> &no)
{
  return {select(mask, yes[0], no[0]), select(mask, yes[1], no[1]), select(mask, yes[2], no[2])};
}
template <class Real>
BERGAMO_INLINE Vector2<Real> select(const Mask<Real> &mask, const Vector2<Real> &yes, const Vector2<Real> &no)
{
  return {select(mask, yes[0], no[0]), select(mask, yes[1], no[1])};
}

using std::abs, std::sqrt, std::exp, std::log;

BERGAMO_INLINE Pack abs(const Pack &x)
{
  return std::experimental::abs(x);
}
template <class Abi>
BERGAMO_INLINE PackOf<Abi> sqrt(const PackOf<Abi> &x)
{
  return std::experimental::sqrt(x);
}
/// 1 / sqrt(x) for positive normal x, to 2 ulp.
BERGAMO_INLINE double inverse_sqrt(const double x)
{
  return 1. / std::sqrt(x);
}
BERGAMO_INLINE Pack inverse_sqrt(const Pack &x)
{
#if defined(__AVX512F__)
  // From 14 bits by two of Newton's steps: a root and a quotient of eight doubles take three times as long.
  Pack y(_mm512_rsqrt14_pd(static_cast<__m512d>(x)));
  for (int step = 0; step < 2; ++step)
    y = y + y * (Pack(0.5) - Pack(0.5) * x * y * y);
  return y;
#else
  return Pack(1.) / std::experimental::sqrt(x);
#endif
}

// Which one max and min give where either is a NaN is up to the compiler (packs: g++ 12 does as it likes).
BERGAMO_INLINE double max(const double a, const double b)
{
  return a > b ? a : b;
}
BERGAMO_INLINE double min(const double a, const double b)
{
  return a < b ? a : b;
}
BERGAMO_INLINE Pack max(const Pack &a, const Pack &b)
{
  return std::experimental::max(a, b);
}
BERGAMO_INLINE Pack min(const Pack &a, const Pack &b)
{
  return std::experimental::min(a, b);
}

// SLEEF, at most 1.0 ulp (Shibata & Petrogalli 2020).
#if defined(__AVX512F__)
BERGAMO_INLINE Pack exp(const Pack &x)
{
  return Pack(Sleef_expd8_u10avx512f(static_cast<__m512d>(x)));
}
BERGAMO_INLINE Pack log(const Pack &x)
{
  return Pack(Sleef_logd8_u10avx512f(static_cast<__m512d>(x)));
}
#elif defined(__AVX2__)
BERGAMO_INLINE Pack exp(const Pack &x)
{
  return Pack(Sleef_expd4_u10avx2(static_cast<__m256d>(x)));
}
BERGAMO_INLINE Pack log(const Pack &x)
{
  return Pack(Sleef_logd4_u10avx2(static_cast<__m256d>(x)));
}
#elif defined(__AVX__)
BERGAMO_INLINE Pack exp(const Pack &x)
{
  return Pack(Sleef_expd4_u10avx(static_cast<__m256d>(x)));
}
BERGAMO_INLINE Pack log(const Pack &x)
{
  return Pack(Sleef_logd4_u10avx(static_cast<__m256d>(x)));
}
#else // SSE2
BERGAMO_INLINE Pack exp(const Pack &x)
{
  return Pack(Sleef_expd2_u10sse2(static_cast<__m128d>(x)));
}
BERGAMO_INLINE Pack log(const Pack &x)
{
  return Pack(Sleef_logd2_u10sse2(static_cast<__m128d>(x)));
}
#endif

template <class Real>
BERGAMO_INLINE Real clamp(const Real &x, const Real &low, const Real &high)
{
  return min(max(x, low), high);
}

/// A pack made lane by lane: value(lane). For double one call, with lane 0.
template <class Real, class Value>
BERGAMO_INLINE Real generate(Value &&value)
{
  if constexpr (std::is_same_v<Real, double>)
    return value(0);
  else
    return Real([&](auto lane) { return value(static_cast<int>(lane)); });
}

/// The numbers from an address on, one a lane.
BERGAMO_INLINE Pack load(const double *numbers)
{
  return Pack(numbers, std::experimental::element_aligned);
}

/// Writes them there.
BERGAMO_INLINE void store(const Pack &x, double *numbers)
{
  x.copy_to(numbers, std::experimental::element_aligned);
}

/// The first lane that is true; of as many as there are, if none is.
BERGAMO_INLINE int first_true(const Pack::mask_type &mask)
{
  return any(mask) ? std::experimental::find_first_set(mask) : pack_width;
}

BERGAMO_INLINE double lane(const double x, int)
{
  return x;
}
BERGAMO_INLINE double lane(const Pack &x, const int k)
{
  return x[static_cast<std::size_t>(k)];
}
BERGAMO_INLINE bool lane(const bool x, int)
{
  return x;
}
BERGAMO_INLINE bool lane(const Pack::mask_type &x, const int k)
{
  return x[static_cast<std::size_t>(k)];
}
template <class Real>
BERGAMO_INLINE Vec3 lane(const Vector3<Real> &x, const int k)
{
  return {lane(x[0], k), lane(x[1], k), lane(x[2], k)};
}

/// A function of one double applied to every lane.
template <class Function>
BERGAMO_INLINE double map(const double x, Function &&f)
{
  return f(x);
}
template <class Abi, class Function>
BERGAMO_INLINE PackOf<Abi> map(const PackOf<Abi> &x, Function &&f)
{
  return PackOf<Abi>([&](auto lane) { return f(x[lane]); });
}

/// Of the C library in every lane: a pack gives the bits that its lanes give alone.
inline double library_log(const double x)
{
  return std::log(x);
}
inline double library_exp(const double x)
{
  return std::exp(x);
}
/// x^exponent for x > 0.
inline double library_pow(const double x, const double exponent)
{
  return std::pow(x, exponent);
}

/// As map(), for a function that is a call: inserting lane by lane costs least between calls.
template <class Abi, class Function>
PackOf<Abi> call_by_lanes(const PackOf<Abi> &x, const Function &f)
{
  PackOf<Abi> result = x;
  for (std::size_t lane = 0; lane < x.size(); ++lane)
    result[lane] = f(x[lane]);
  return result;
}
template <class Abi>
PackOf<Abi> library_log(const PackOf<Abi> &x)
{
  return call_by_lanes(x, [](const double lane) { return std::log(lane); });
}
template <class Abi>
PackOf<Abi> library_exp(const PackOf<Abi> &x)
{
  return call_by_lanes(x, [](const double lane) { return std::exp(lane); });
}
template <class Abi>
PackOf<Abi> library_pow(const PackOf<Abi> &x, const double exponent)
{
  return call_by_lanes(x, [exponent](const double lane) { return std::pow(lane, exponent); });
}

/// Sum over the lanes, always in the same order: neighbours first.
template <class Abi>
BERGAMO_INLINE double sum(const PackOf<Abi> &x)
{
  constexpr std::size_t n = PackOf<Abi>::size();
  static_assert(n == 2 || n == 4 || n == 8);
  if constexpr (n == 2)
    return x[0] + x[1];
  else if constexpr (n == 4)
    return (x[0] + x[1]) + (x[2] + x[3]);
  else
    return ((x[0] + x[1]) + (x[2] + x[3])) + ((x[4] + x[5]) + (x[6] + x[7]));
}

/// Least of the lanes; one that is a NaN does not count, unless it is the first.
template <class Abi>
BERGAMO_INLINE double least(const PackOf<Abi> &x)
{
  double result = x[0];
  for (std::size_t lane = 1; lane < x.size(); ++lane)
    result = x[lane] < result ? x[lane] : result;
  return result;
}

} // namespace math

/// Lanes of Real.
template <class Real>
inline constexpr int width = std::is_same_v<Real, double> ? 1 : pack_width;

} // namespace bergamo

namespace Eigen
{
template <>
struct NumTraits<bergamo::Pack> : GenericNumTraits<double>
{
  using Real = bergamo::Pack;
  using NonInteger = bergamo::Pack;
  using Literal = bergamo::Pack;
  using Nested = bergamo::Pack;
};
} // namespace Eigen
