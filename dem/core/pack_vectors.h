#pragma once

#include "dem/core/pack.h"

#include <array>

/// Vectors in memory into packs and back. With AVX-512 a transposition in registers takes a third of the instructions
/// of moving number by number, and a touching contact moves six vectors in and three out at every step: the only
/// intrinsics of the program.
namespace bergamo
{

/// Three components and one unused: one register of four.
using Vec4 = Eigen::Vector4d;

namespace math
{

/// Vectors of all lanes. @param vector vector(lane): const Vec3 &
template <class Real, class Vector>
BERGAMO_INLINE Vector3<Real> gather_vectors(const Vector &vector)
{
#if defined(__AVX512F__) && defined(__AVX512VL__)
  if constexpr (std::is_same_v<Real, Pack>)
  {
    static_assert(pack_width == 8);
    const auto pair = [&](const int k) // rows k and k + 4 side by side; the mask keeps off what follows a vector
    {
      return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_maskz_loadu_pd(0b0111, vector(k).data())),
                                _mm256_maskz_loadu_pd(0b0111, vector(k + 4).data()), 1);
    };
    const __m512d r0 = pair(0), r1 = pair(1), r2 = pair(2), r3 = pair(3);
    const __m512d xz01 = _mm512_unpacklo_pd(r0, r1), xz23 = _mm512_unpacklo_pd(r2, r3);
    const __m512d y01 = _mm512_unpackhi_pd(r0, r1), y23 = _mm512_unpackhi_pd(r2, r3);
    const __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
    const __m512i high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
    return {Pack(_mm512_permutex2var_pd(xz01, low, xz23)), Pack(_mm512_permutex2var_pd(y01, low, y23)),
            Pack(_mm512_permutex2var_pd(xz01, high, xz23))};
  }
  else
#endif
    return {generate<Real>([&](const int lane) { return vector(lane)[0]; }),
            generate<Real>([&](const int lane) { return vector(lane)[1]; }),
            generate<Real>([&](const int lane) { return vector(lane)[2]; })};
}

/// Vectors of all lanes, which follow one another in memory.
template <class Real>
BERGAMO_INLINE Vector3<Real> load_vectors(const Vec3 *vectors)
{
#if defined(__AVX512F__)
  if constexpr (std::is_same_v<Real, Pack>)
  {
    static_assert(pack_width == 8 && sizeof(Vec3) == 24);
    const double *const numbers = vectors->data();
    const __m512d a = _mm512_loadu_pd(numbers), b = _mm512_loadu_pd(numbers + 8), c = _mm512_loadu_pd(numbers + 16);
    const auto pick = [&](const __m512i of_ab, const __m512i and_of_c)
    { return Pack(_mm512_permutex2var_pd(_mm512_permutex2var_pd(a, of_ab, b), and_of_c, c)); };
    return {pick(_mm512_setr_epi64(0, 3, 6, 9, 12, 15, 0, 0), _mm512_setr_epi64(0, 1, 2, 3, 4, 5, 10, 13)),
            pick(_mm512_setr_epi64(1, 4, 7, 10, 13, 0, 0, 0), _mm512_setr_epi64(0, 1, 2, 3, 4, 8, 11, 14)),
            pick(_mm512_setr_epi64(2, 5, 8, 11, 14, 0, 0, 0), _mm512_setr_epi64(0, 1, 2, 3, 4, 9, 12, 15))};
  }
  else
#endif
    return gather_vectors<Real>([&](const int lane) -> const Vec3 & { return vectors[lane]; });
}

/// Vectors of four of all lanes, which follow one another in memory: x, y, z, w.
template <class Real>
BERGAMO_INLINE std::array<Real, 4> load_fours(const double *numbers)
{
#if defined(__AVX512F__)
  if constexpr (std::is_same_v<Real, Pack>)
  {
    static_assert(pack_width == 8);
    const auto two = [&](const int k) { return _mm512_loadu_pd(numbers + 8 * k); };
    const __m512d xz0 = _mm512_unpacklo_pd(two(0), two(1)), xz1 = _mm512_unpacklo_pd(two(2), two(3));
    const __m512d yw0 = _mm512_unpackhi_pd(two(0), two(1)), yw1 = _mm512_unpackhi_pd(two(2), two(3));
    const __m512i low = _mm512_setr_epi64(0, 4, 1, 5, 8, 12, 9, 13);
    const __m512i high = _mm512_setr_epi64(2, 6, 3, 7, 10, 14, 11, 15);
    return {Pack(_mm512_permutex2var_pd(xz0, low, xz1)), Pack(_mm512_permutex2var_pd(yw0, low, yw1)),
            Pack(_mm512_permutex2var_pd(xz0, high, xz1)), Pack(_mm512_permutex2var_pd(yw0, high, yw1))};
  }
  else
#endif
  {
    const auto number = [&](const int d)
    { return generate<Real>([&](const int lane) { return numbers[4 * lane + d]; }); };
    return {number(0), number(1), number(2), number(3)};
  }
}

/// Writes the vectors of all lanes. @param target target(lane): Vec3 & or Vec4 &
/// @param fourth goes into the fourth place of Vec4
template <class Real, class Target>
BERGAMO_INLINE void scatter_vectors(const Vector3<Real> &v, const Target &target, const Real &fourth = Real(0.))
{
  using Row = std::remove_cvref_t<decltype(target(0))>;
#if defined(__AVX512F__) && defined(__AVX512VL__)
  if constexpr (std::is_same_v<Real, Pack>)
  {
    const auto x = static_cast<__m512d>(v[0]), y = static_cast<__m512d>(v[1]), z = static_cast<__m512d>(v[2]);
    const auto w = static_cast<__m512d>(fourth);
    const __m512i first = _mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11);
    const __m512i second = _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15);
    const auto store_row = [&](const int k, const __m256d row)
    {
      if constexpr (std::is_same_v<Row, Vec4>)
        _mm256_store_pd(target(k).data(), row);
      else
        _mm256_mask_storeu_pd(target(k).data(), 0b0111, row);
    };
    const auto store_four = [&](const int even_or_odd, const __m512d xy, const __m512d zw)
    {
      const __m512d front = _mm512_permutex2var_pd(xy, first, zw), back = _mm512_permutex2var_pd(xy, second, zw);
      store_row(even_or_odd, _mm512_castpd512_pd256(front));
      store_row(even_or_odd + 2, _mm512_extractf64x4_pd(front, 1));
      store_row(even_or_odd + 4, _mm512_castpd512_pd256(back));
      store_row(even_or_odd + 6, _mm512_extractf64x4_pd(back, 1));
    };
    store_four(0, _mm512_unpacklo_pd(x, y), _mm512_unpacklo_pd(z, w));
    store_four(1, _mm512_unpackhi_pd(x, y), _mm512_unpackhi_pd(z, w));
  }
  else
#endif
    for (int k = 0; k < width<Real>; ++k)
      if constexpr (std::is_same_v<Row, Vec4>)
        target(k) = Vec4(lane(v[0], k), lane(v[1], k), lane(v[2], k), lane(fourth, k));
      else
        target(k) = lane<Real>(v, k);
}

/// Writes the vectors of all lanes one after the other.
template <class Real>
BERGAMO_INLINE void store_vectors(const Vector3<Real> &v, Vec3 *vectors)
{
#if defined(__AVX512F__)
  if constexpr (std::is_same_v<Real, Pack>)
  {
    const auto x = static_cast<__m512d>(v[0]), y = static_cast<__m512d>(v[1]), z = static_cast<__m512d>(v[2]);
    double *const numbers = vectors->data();
    const auto put = [&](const int k, const __m512i of_xy, const __m512i and_of_z)
    { _mm512_storeu_pd(numbers + 8 * k, _mm512_permutex2var_pd(_mm512_permutex2var_pd(x, of_xy, y), and_of_z, z)); };
    put(0, _mm512_setr_epi64(0, 8, 0, 1, 9, 0, 2, 10), _mm512_setr_epi64(0, 1, 8, 3, 4, 9, 6, 7));
    put(1, _mm512_setr_epi64(0, 3, 11, 0, 4, 12, 0, 5), _mm512_setr_epi64(10, 1, 2, 11, 4, 5, 12, 7));
    put(2, _mm512_setr_epi64(13, 0, 6, 14, 0, 7, 15, 0), _mm512_setr_epi64(0, 13, 2, 3, 14, 5, 6, 15));
  }
  else
#endif
    scatter_vectors<Real>(v, [&](const int lane) -> Vec3 & { return vectors[lane]; });
}

} // namespace math

} // namespace bergamo
