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

#if defined(__AVX512F__) && defined(__AVX512VL__)
/// Rows of four, one a lane, read by column.
struct RowsOfFour
{
  /// @param row row(lane): __m256d
  template <class Row>
  BERGAMO_INLINE explicit RowsOfFour(const Row &row)
  {
    static_assert(pack_width == 8);
    const auto pair = [&](const int k) // rows k and k + 4 side by side
    { return _mm512_insertf64x4(_mm512_castpd256_pd512(row(k)), row(k + 4), 1); };
    const __m512d r0 = pair(0), r1 = pair(1), r2 = pair(2), r3 = pair(3);
    xz01 = _mm512_unpacklo_pd(r0, r1);
    xz23 = _mm512_unpacklo_pd(r2, r3);
    yw01 = _mm512_unpackhi_pd(r0, r1);
    yw23 = _mm512_unpackhi_pd(r2, r3);
  }

  BERGAMO_INLINE Pack x() const { return low(xz01, xz23); }
  BERGAMO_INLINE Pack y() const { return low(yw01, yw23); }
  BERGAMO_INLINE Pack z() const { return high(xz01, xz23); }
  BERGAMO_INLINE Pack w() const { return high(yw01, yw23); }

private:
  BERGAMO_INLINE static Pack low(const __m512d a, const __m512d b)
  {
    return Pack(_mm512_permutex2var_pd(a, _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13), b));
  }
  BERGAMO_INLINE static Pack high(const __m512d a, const __m512d b)
  {
    return Pack(_mm512_permutex2var_pd(a, _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15), b));
  }

  __m512d xz01, xz23, yw01, yw23;
};
#endif

/// Vectors of all lanes. @param vector vector(lane): const Vec3 &
template <class Real, class Vector>
BERGAMO_INLINE Vector3<Real> gather_vectors(const Vector &vector)
{
#if defined(__AVX512F__) && defined(__AVX512VL__)
  if constexpr (std::is_same_v<Real, Pack>)
  {
    const RowsOfFour rows([&](const int lane) // the mask keeps off what follows a vector
                          { return _mm256_maskz_loadu_pd(0b0111, vector(lane).data()); });
    return {rows.x(), rows.y(), rows.z()};
  }
  else
#endif
    return {generate<Real>([&](const int lane) { return vector(lane)[0]; }),
            generate<Real>([&](const int lane) { return vector(lane)[1]; }),
            generate<Real>([&](const int lane) { return vector(lane)[2]; })};
}

/// Vectors of four of all lanes: x, y, z, w. @param vector vector(lane): const Vec4 &
template <class Real, class Vector>
BERGAMO_INLINE std::array<Real, 4> gather_fours(const Vector &vector)
{
#if defined(__AVX512F__) && defined(__AVX512VL__)
  if constexpr (std::is_same_v<Real, Pack>)
  {
    const RowsOfFour rows([&](const int lane) { return _mm256_load_pd(vector(lane).data()); });
    return {rows.x(), rows.y(), rows.z(), rows.w()};
  }
  else
#endif
  {
    const auto number = [&](const int d) { return generate<Real>([&](const int lane) { return vector(lane)[d]; }); };
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

} // namespace math

} // namespace bergamo
