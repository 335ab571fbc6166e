#include "dem/neighbour/verlet_list.h"

#include "dem/core/parallel_sum.h"
#include "dem/neighbour/row_search.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace bergamo::dem
{
namespace
{

/// What one part of the spheres in the order of rows has found.
struct Findings
{
  std::vector<std::int32_t> n_partners, partners;            ///< of greater index, of one sphere after another
  std::vector<std::pair<std::int32_t, std::int32_t>> turned; ///< pairs that were found from their second sphere
};

/// Calls body(part, begin, end) for the same parts of the spheres at every call.
template <class Body>
void for_parts(const std::size_t n, Body &&body)
{
  parallel_ranges(n, 256, body);
}

/// Finds the pairs of the spheres [begin, end) in the order of rows.
Findings find_pairs(RowSearch &&search, const BoundingSpheres &spheres, const SphereRows &rows,
                    const std::int32_t begin, const std::int32_t end)
{
  Findings findings;
  findings.n_partners.resize(end - begin);
  const auto is_fixed = [&](const std::int32_t i) { return !spheres.masses.empty() && std::isinf(spheres.masses[i]); };
  search.for_each_sphere(begin, end,
                         [&](const std::int32_t s)
                         {
                           const std::int32_t i = rows.spheres.sphere[s];
                           const std::size_t n_before = findings.partners.size();
                           const bool i_is_fixed = is_fixed(i);
                           for (std::size_t k = 0; k < search.n_found; ++k)
                           {
                             const std::int32_t j = search.found[k];
                             if (i_is_fixed && is_fixed(j))
                               continue;
                             if (!spheres.body.empty() && spheres.body[i] == spheres.body[j])
                               continue;
                             if (j > i)
                               findings.partners.push_back(j);
                             else
                               findings.turned.emplace_back(j, i);
                           }
                           findings.n_partners[s - begin] =
                               static_cast<std::int32_t>(findings.partners.size() - n_before);
                         });
  return findings;
}

/// Calls body(i, j) for all pairs found from their second sphere, on all threads: several may belong to one i.
template <class Body>
void for_each_turned(const std::vector<Findings> &of_part, Body &&body)
{
  parallel_ranges(of_part.size(), 1,
                  [&](const std::size_t, const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t part = begin; part < end; ++part)
                      for (const auto &[i, j] : of_part[part].turned)
                        body(i, j);
                  });
}

/// The number before one more is counted, whoever else counts.
std::int32_t count_one(std::int32_t &count)
{
  return std::atomic_ref(count).fetch_add(1, std::memory_order_relaxed);
}

} // namespace

VerletList build_verlet_list(const BoundingSpheres &spheres, const double verlet_distance, const PeriodicCell &cell)
{
  const std::size_t n = spheres.positions.size();
  const SphereRows rows(spheres, verlet_distance, cell);
  VerletList list;
  list.row.assign(n + 1, 0);
  std::vector<Findings> of_part(most_parts());
  for_parts(n,
            [&](const std::size_t part, const std::size_t begin, const std::size_t end)
            {
              of_part[part] = find_pairs(RowSearch(rows, verlet_distance, cell, spheres.sought), spheres, rows,
                                         static_cast<std::int32_t>(begin), static_cast<std::int32_t>(end));
              for (std::size_t s = begin; s < end; ++s)
                list.row[rows.spheres.sphere[s]] = of_part[part].n_partners[s - begin];
            });
  for_each_turned(of_part, [&](const std::int32_t i, std::int32_t) { count_one(list.row[i]); });
  exclusive_sum(list.row);

  list.first.resize(list.row[n]);
  list.second.resize(list.row[n]);
  list.image.resize(list.row[n], own_image);
  std::vector<std::int32_t> next(list.row.begin(), list.row.end() - 1);
  for_each_turned(of_part, // in any order: rows are sorted in the end
                  [&](const std::int32_t i, const std::int32_t j) { list.second[count_one(next[i])] = j; });
  for_parts(n,
            [&](const std::size_t part, const std::size_t begin, const std::size_t end)
            {
              auto partners = of_part[part].partners.begin();
              for (std::size_t s = begin; s < end; ++s)
              {
                const std::int32_t i = rows.spheres.sphere[s], n_partners = of_part[part].n_partners[s - begin];
                std::copy_n(partners, n_partners, list.second.begin() + next[i]);
                partners += n_partners;
                std::sort(list.second.begin() + list.row[i], list.second.begin() + list.row[i + 1]);
                std::fill(list.first.begin() + list.row[i], list.first.begin() + list.row[i + 1], i);
                if (cell.is_periodic())
                  for (auto pair = list.row[i]; pair < list.row[i + 1]; ++pair)
                    list.image[pair] = cell.nearest_image(spheres.positions[list.second[pair]] - spheres.positions[i]);
              }
            });
  return list;
}

} // namespace bergamo::dem
