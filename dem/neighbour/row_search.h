#pragma once

#include "dem/neighbour/sphere_rows.h"

#include <vector>

namespace bergamo::dem
{

/// Looks for the partners of spheres one after another, in the order of rows. One for each thread.
class RowSearch
{
public:
  /// All are kept by reference.
  RowSearch(const SphereRows &rows, double verlet_distance, const PeriodicCell &cell);

  /// Calls visit(i) with the index i of each sphere of [begin, end) in the order of rows, with its partners in `found`:
  /// those of its own class and of greater index, and those in the classes of larger spheres. So every pair is found
  /// once, and nothing is looked for among the many small spheres around a large one.
  template <class Visit>
  void for_each_sphere(const std::int32_t begin, const std::int32_t end, Visit &&visit)
  {
    const auto last_of = [&](const SphereLayer &layer) { return rows.rows[layer.end_rows - 1].end; };
    for (const SizeClass &size : rows.classes)
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
          const std::int32_t first = std::max(begin, row->begin), last = std::min(end, row->end);
          go_to_row(first, last);
          for (std::int32_t s = first; s < last; ++s)
          {
            find_partners(s);
            visit(rows.spheres.sphere[s]);
          }
        }
      }
    }
  }

  std::vector<std::int32_t> found; ///< indices of n_found partners, in no order that matters; room behind them
  std::size_t n_found = 0;

private:
  /// A layer in reach of that gone to.
  struct NearLayer
  {
    const SizeClass *size;
    std::int32_t begin_rows, end_rows;
    std::int32_t next_row; ///< where the last search for one ended
  };

  /// Spheres by place among which there may be partners.
  struct Candidates
  {
    const SphereArrays *spheres;
    double reach; ///< to a partner [m]
    std::int32_t begin, end;
    std::int32_t next; ///< the first that the next sphere may reach
    bool is_own_class;
  };

  /// A sphere of a larger class, or an image of it.
  struct Larger
  {
    double place;
    std::int32_t sphere; ///< in the order of rows
  };

  double reach_to(const SizeClass &other) const;
  void go_to_layer(const SizeClass &size, std::int32_t begin, std::int32_t end);
  void go_to_row(std::int32_t begin, std::int32_t end);
  template <class Visit>
  void for_each_near_row(NearLayer &layer, const RowNumbers &numbers, Visit &&visit);
  void gather(const SphereRow &row, double reach, const Vec3 &low, const Vec3 &high);
  void put_in_order(SphereArrays &spheres);
  void find_partners(std::int32_t of);
  void look_around(const Candidates &candidates, std::int32_t of);

  /// Adds the partners among candidates [begin, end) up to a place.
  template <bool is_periodic>
  void look_into(const Candidates &candidates, std::int32_t of, std::int32_t begin, std::int32_t end,
                 double last_place);

  const SphereRows &rows;
  const double verlet_distance;
  const PeriodicCell &cell;
  const double rounding; ///< of places in the cell and of numbers of rows, with room to spare [m]
  const SizeClass *size = nullptr;
  std::vector<NearLayer> near_layers;
  std::vector<Candidates> candidates;
  std::vector<Larger> larger;
  std::vector<SphereArrays> in_order; ///< the larger spheres of each class
};

} // namespace bergamo::dem
