#include "dem/neighbour/size_classes.h"

#include "dem/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace bergamo::dem
{
namespace
{

constexpr int bins_per_octave = 4;
constexpr int n_bins = 24 * bins_per_octave; // the last one has all that is smaller

/// Spheres of about one range.
struct Bin
{
  std::int32_t n_spheres = 0;
  double largest = 0.; ///< range [m]
};
using Bins = std::array<Bin, n_bins>;

// Work for a sphere, over that of a test for nearness, as `benchmarks/neighbours` has it.
constexpr double tests_among_equals = 40.; // in a dense packing, with what rows are wider than spheres reach
constexpr double tests_for_a_class = 200.; // that a class of larger spheres costs, were it empty
constexpr double tests_of_larger = 60.;    // that its spheres cost if they are equal

/// First bin of each class, from the bins that are not empty. Least work by dynamic programming: a cut before a bin
/// makes one more class to look at for all spheres from there on, whatever the other cuts are.
std::vector<std::size_t> cheapest_cuts(const std::vector<Bin> &bins)
{
  const std::size_t n = bins.size();
  std::vector<double> n_below(n + 1, 0.), volume_below(n + 1, 0.); // of the bins from one on, cubes of ranges
  for (std::size_t k = n; k-- > 0;)
  {
    const double range = bins[k].largest / bins[0].largest;
    n_below[k] = n_below[k + 1] + bins[k].n_spheres;
    volume_below[k] = volume_below[k + 1] + bins[k].n_spheres * range * range * range;
  }
  std::vector<double> least(n + 1, std::numeric_limits<double>::infinity()); // of all bins before one
  std::vector<std::size_t> cut(n + 1, 0);                                    // the last one among them
  least[0] = 0.;
  for (std::size_t end = 1; end <= n; ++end)
    for (std::size_t begin = 0; begin < end; ++begin)
    {
      const double n_spheres = n_below[begin] - n_below[end], volume = volume_below[begin] - volume_below[end];
      const double range = bins[begin].largest / bins[0].largest;
      const double crowd = std::min(range * range * range * n_spheres / volume, n_spheres / tests_among_equals);
      const double work = least[begin] + n_spheres * tests_among_equals * crowd +
                          n_below[end] * (tests_for_a_class + tests_of_larger * crowd);
      if (work < least[end])
      {
        least[end] = work;
        cut[end] = begin;
      }
    }
  std::vector<std::size_t> cuts;
  for (std::size_t end = n; end > 0; end = cut[end])
    cuts.push_back(cut[end]);
  std::reverse(cuts.begin(), cuts.end());
  return cuts;
}

} // namespace

SizeClasses divide_by_size(const std::span<const double> radii, const double verlet_distance)
{
  const std::size_t n = radii.size();
  const auto range = [&](const std::size_t i) { return 2. * radii[i] + verlet_distance; };
  Collected<double> greatest;
  parallel_ranges(n, 1024,
                  [&](const std::size_t part, const std::size_t begin, const std::size_t end)
                  {
                    double most = 0.;
                    for (std::size_t i = begin; i < end; ++i)
                      most = std::max(most, range(i));
                    greatest.of(part).push_back(most);
                  });
  double largest = 0.;
  greatest.for_each([&](const double of_part) { largest = std::max(largest, of_part); });

  SizeClasses classes;
  classes.size_class.resize(n); // the bins at first
  Collected<Bins> counted;
  parallel_ranges(n, 1024,
                  [&](const std::size_t part, const std::size_t begin, const std::size_t end)
                  {
                    Bins bins;
                    for (std::size_t i = begin; i < end; ++i)
                    {
                      const double octaves = range(i) > 0. ? std::log2(largest / range(i)) : n_bins;
                      const auto bin = static_cast<std::int32_t>(std::min(bins_per_octave * octaves, n_bins - 1.));
                      classes.size_class[i] = bin;
                      ++bins[bin].n_spheres;
                      bins[bin].largest = std::max(bins[bin].largest, range(i));
                    }
                    counted.of(part).push_back(bins);
                  });
  Bins bins;
  counted.for_each(
      [&](const Bins &of_part)
      {
        for (int k = 0; k < n_bins; ++k)
        {
          bins[k].n_spheres += of_part[k].n_spheres;
          bins[k].largest = std::max(bins[k].largest, of_part[k].largest);
        }
      });
  std::vector<Bin> used;
  std::array<std::size_t, n_bins> index_of_bin;
  for (int k = 0; k < n_bins; ++k)
  {
    index_of_bin[k] = used.size();
    if (bins[k].n_spheres > 0)
      used.push_back(bins[k]);
  }
  const std::vector<std::size_t> cuts = cheapest_cuts(used);
  for (const std::size_t cut : cuts)
    classes.range.push_back(used[cut].largest);
  parallel_for(n,
               [&](const std::size_t i)
               {
                 const std::size_t bin = index_of_bin[classes.size_class[i]];
                 classes.size_class[i] =
                     static_cast<std::int32_t>(std::upper_bound(cuts.begin(), cuts.end(), bin) - cuts.begin()) - 1;
               });
  return classes;
}

} // namespace bergamo::dem
