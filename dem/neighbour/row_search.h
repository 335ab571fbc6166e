#pragma once

#include "dem/neighbour/sphere_rows.h"

#include <utility>
#include <vector>

namespace bergamo::dem
{

/// Looks for the partners of spheres one after another, in the order of rows. One for each thread.
class RowSearch
{
public:
  /// All are kept by reference.
  /// @param sought spheres of which pairs have one at least; none given, all
  RowSearch(const SphereRows &rows, double verlet_distance, const PeriodicCell &cell,
            std::span<const std::uint8_t> sought = {});

  /// Calls visit(s) with the place s in the order of rows of spheres in [begin, end), with their partners in `found`:
  /// those of a sphere's own class and of greater index, and those in the classes of larger spheres. So every pair is
  /// found once, and the many small spheres around a large one need not be gone through for it. A sphere sought also
  /// has the partners of its class that are not; others have larger spheres that are sought, and where there are none
  /// they are passed over.
  template <class Visit>
  void for_each_sphere(const std::int32_t begin, const std::int32_t end, Visit &&visit)
  {
    const auto last_of = [&](const SphereLayer &layer) { return rows.rows[layer.end_rows - 1].end; };
    for (const SphereClass &size : rows.classes)
    {
      const auto end_layers = rows.layers.begin() + size.end_layers;
      for (auto layer = std::partition_point(rows.layers.begin() + size.begin_layers, end_layers,
                                             [&](const SphereLayer &l) { return last_of(l) <= begin; });
           layer != end_layers && rows.rows[layer->begin_rows].begin < end; ++layer)
      {
        go_to_layer(size, std::max(begin, rows.rows[layer->begin_rows].begin), std::min(end, last_of(*layer)));
        const auto end_rows = rows.rows.begin() + layer->end_rows;
        for (auto row = std::partition_point(rows.rows.begin() + layer->begin_rows, end_rows,
                                             [&](const SphereRow &r) { return r.end <= begin; });
             row != end_rows && row->begin < end; ++row)
        {
          const auto [first, last] = of_interest(std::max(begin, row->begin), std::min(end, row->end));
          if (first == last)
            continue;
          go_to_row(first, last);
          for (std::int32_t s = first; s < last; ++s)
          {
            if ((s - first) % piece == 0)
              gather_larger(s, std::min(s + piece, last));
            if (!is_sought(s) && n_larger_sought == 0)
              continue;
            find_partners(s);
            visit(s);
          }
        }
      }
    }
  }

  std::vector<std::int32_t> found; ///< indices of n_found partners, in no order that matters; room behind them
  std::size_t n_found = 0;

private:
  static constexpr std::int32_t piece = 16; ///< spheres of a row that look at the same larger ones

  /// A layer in reach of that gone to.
  struct NearLayer
  {
    const SphereClass *size;
    std::int32_t begin_rows, end_rows;
    std::int32_t next_row; ///< where the last search for one ended
  };

  /// A row in reach, of its own class.
  struct NearRow
  {
    std::int32_t begin, end;
    std::int32_t next; ///< the first that the next sphere may reach
  };

  /// A row in reach, of larger spheres.
  struct LargerRow
  {
    std::int32_t begin, end;
    double reach; ///< [m]
  };

  /// Some spheres [begin, end) in an array, those at places up to the last one.
  struct Stretch
  {
    const SphereArrays *spheres;
    std::int32_t begin, end;
    double last_place;
    std::int32_t least; ///< index of a partner that is sought itself
  };

  bool is_sought(const std::int32_t s) const { return sought.empty() || sought[rows.spheres.sphere[s]]; }

  /// The spheres of [begin, end) in a row of the layer gone to among which any have partners.
  std::pair<std::int32_t, std::int32_t> of_interest(std::int32_t begin, std::int32_t end) const;

  /// From a sphere of the class gone to [m].
  double reach_to(const SphereClass &other) const;

  /// Least and greatest coordinates of the spheres [begin, end), in the cell [m].
  std::pair<Vec3, Vec3> bounds(std::int32_t begin, std::int32_t end) const;

  // To the spheres [begin, end) of a layer, of a row in it, of a piece of that.
  void go_to_layer(const SphereClass &size, std::int32_t begin, std::int32_t end);
  void go_to_row(std::int32_t begin, std::int32_t end);
  template <class Visit>
  void for_each_near_row(NearLayer &layer, const RowNumbers &numbers, Visit &&visit);
  void gather_larger(std::int32_t begin, std::int32_t end);

  void find_partners(std::int32_t of);
  void look_around(const NearRow &row, std::int32_t of);

  /// Adds the partners of a sphere among others.
  template <bool is_periodic>
  void look_into(const Stretch &others, std::int32_t of);

  const SphereRows &rows;
  const double verlet_distance;
  const PeriodicCell &cell;
  const std::span<const std::uint8_t> sought;
  const double rounding;             ///< of places in the cell and of numbers of rows, with room to spare [m]
  const SphereClass *size = nullptr; ///< of the layer gone to
  std::vector<NearLayer> near_layers;
  std::vector<NearRow> near_rows;
  std::vector<LargerRow> larger_rows;
  SphereArrays larger; ///< that may be partners of the piece of a row, those sought before the others
  std::int32_t n_larger = 0, n_larger_sought = 0;
};

} // namespace bergamo::dem
