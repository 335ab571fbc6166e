// Cost of a renewal of the neighbours for spheres of one size and of many, for grains that have left, and of the
// spatial order. `neighbours --help`.

#include "benchmarks/program.h"
#include "benchmarks/step_timing.h"

#include "dem/neighbour/spatial_order.h"
#include "dem/neighbour/verlet_list.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <iomanip>
#include <iostream>
#include <numbers>
#include <numeric>
#include <optional>
#include <random>

namespace
{

using namespace bergamo;
using namespace bergamo::benchmark;

struct Options
{
  int n_grains = 50000;
  int n_repeats = 15;
  int n_threads = 1;
  std::string only; ///< cases whose name has this in it, and the first two
  std::filesystem::path json;
};

using Radius = std::function<double(std::mt19937_64 &)>; ///< of one more grain; about 1

constexpr double bounding = 1.5; ///< radius of a long grain's bounding sphere over that of one of its volume

struct Case
{
  std::string name;
  Radius radius;
  double largest = 0.;         ///< radius of one more grain in the middle; 0: none
  double solid_fraction = 0.6; ///< thrown, of which what overlaps is taken away again
  double distance = 0.;        ///< of the grains that have left
  double share_away = 0.;      ///< of all grains; 0: one
};

Radius equal()
{
  return [](auto &) { return 1.; };
}

/// r between the smallest and `ratio` times it, density ~ r^-power.
Radius power_law(const double ratio, const double power)
{
  return [=](auto &generator)
  {
    const double u = std::uniform_real_distribution<double>(0., 1.)(generator);
    return power == 1. ? std::pow(ratio, u) : std::pow(1. + u * (std::pow(ratio, 1. - power) - 1.), 1. / (1. - power));
  };
}

Radius gaussian(const double deviation)
{
  return [=](auto &generator)
  { return std::clamp(std::normal_distribution<double>(1., deviation)(generator), 0.1, 2.); };
}

std::vector<Case> cases()
{
  return {{"equal", equal()},
          {"gas, equal", equal(), 0., 1e-3},
          {"Gaussian, deviation 0.3", gaussian(0.3)},
          {"r^-3, ratio 10", power_law(10., 3.)},
          {"r^-3, ratio 100", power_law(100., 3.)},
          {"r^-4, ratio 100", power_law(100., 4.)},
          {"one of 1.5", equal(), 1.5},
          {"one of 3", equal(), 3.},
          {"uniform, ratio 2", power_law(2., 0.)},
          {"uniform, ratio 4", power_law(4., 0.)},
          {"one of 10", equal(), 10.},
          {"one of 30", equal(), 30.},
          {"one 10 km away", equal(), 0., 0.6, 1e7},
          {"one 1e300 away", equal(), 0., 0.6, 1e300},
          {"a tenth away", equal(), 0., 0.6, 1e7, 0.1},
          {"gas, one of 100", equal(), 100., 1e-3},
          {"gas, r^-3, ratio 100", power_law(100., 3.), 0., 1e-3}};
}

struct Cloud
{
  std::vector<Vec3> positions;
  std::vector<double> radii;
  dem::PeriodicCell cell;
  double verlet_distance = 0.; ///< a tenth of the mean radius

  dem::VerletList list(const double distance) const
  {
    return dem::build_verlet_list({positions, radii}, distance, cell);
  }
  void keep(const std::vector<std::int32_t> &grains)
  {
    Cloud kept;
    for (const std::int32_t i : grains)
    {
      kept.positions.push_back(positions[i]);
      kept.radii.push_back(radii[i]);
    }
    positions = std::move(kept.positions);
    radii = std::move(kept.radii);
  }
};

/// Takes away what overlaps a larger grain that stays.
void take_away_overlaps(Cloud &cloud)
{
  std::vector<std::int32_t> by_size(cloud.radii.size());
  std::iota(by_size.begin(), by_size.end(), 0);
  std::sort(by_size.begin(), by_size.end(),
            [&](const std::int32_t i, const std::int32_t j)
            { return cloud.radii[i] != cloud.radii[j] ? cloud.radii[i] > cloud.radii[j] : i < j; });
  cloud.keep(by_size); // now the first of a pair is the larger one
  const dem::VerletList overlaps = cloud.list(0.);
  std::vector<bool> stays(cloud.radii.size(), true);
  std::vector<std::int32_t> left;
  for (std::size_t i = 0; i < stays.size(); ++i)
  {
    if (!stays[i])
      continue;
    left.push_back(static_cast<std::int32_t>(i));
    for (auto pair = overlaps.row[i]; pair < overlaps.row[i + 1]; ++pair)
      stays[overlaps.second[pair]] = false;
  }
  cloud.keep(left);
}

Cloud make_cloud(const Case &of, const int n, const bool is_periodic)
{
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> unit(0., 1.);
  Cloud cloud;
  double volume = 0.;
  for (int i = 0; i < n; ++i)
  {
    const double r = of.radius(generator);
    cloud.radii.push_back(r);
    volume += 4. / 3. * std::numbers::pi * r * r * r;
  }
  const double largest = std::max(of.largest, *std::max_element(cloud.radii.begin(), cloud.radii.end()));
  const double edge =
      std::max(std::cbrt(volume / of.solid_fraction), 4.5 * bounding * largest); // two ranges in a periodic cell
  for (int i = 0; i < n; ++i)
    cloud.positions.push_back(edge * Vec3(unit(generator), unit(generator), unit(generator)));
  if (of.largest > 0.)
  {
    cloud.positions.push_back(Vec3::Constant(0.5 * edge));
    cloud.radii.push_back(of.largest);
  }
  if (is_periodic)
    cloud.cell = dem::PeriodicCell(Vec3::Constant(edge));
  take_away_overlaps(cloud);
  for (double &r : cloud.radii)
    r *= bounding;
  cloud.keep(dem::spatial_order(cloud.positions, 1.)); // as the engine keeps its grains
  cloud.verlet_distance = 0.1 * std::accumulate(cloud.radii.begin(), cloud.radii.end(), 0.) / cloud.radii.size();
  if (of.distance > 0.)
    for (int k = std::max(1, static_cast<int>(of.share_away * cloud.radii.size())); k > 0; --k)
      cloud.positions[static_cast<std::size_t>(unit(generator) * cloud.radii.size())] =
          of.distance * Vec3(unit(generator), unit(generator), unit(generator));
  return cloud;
}

/// Runs of a cloud.
struct Measured
{
  std::string name;
  Cloud cloud;
  std::size_t n_pairs = 0;
  std::vector<double> list_ms = {}, list_cpu_ms = {}, order_cpu_ms = {};
};

/// Of the processor for this program, all threads together: what else the machine does counts little.
double cpu_ms()
{
  return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

nlohmann::json report(const std::vector<Measured> &all, const std::string &space)
{
  nlohmann::json rows = nlohmann::json::array();
  const auto ns = [](const Measured &m) { return 1e6 * spread(m.list_cpu_ms).least / m.cloud.radii.size(); };
  const auto pairs = [](const Measured &m) { return 1. * m.n_pairs / m.cloud.radii.size(); };
  const auto ns_of_equal = [&](const double pairs_of_a_grain) // on the line through the dense ones and the gas
  {
    const Measured &dense = all[0], &gas = all[1];
    return ns(gas) + (ns(dense) - ns(gas)) * (pairs_of_a_grain - pairs(gas)) / (pairs(dense) - pairs(gas));
  };
  std::cout << space << std::string(26 - space.size(), ' ')
            << "grains   pairs a grain   list ms: least, CPU least median   ns a grain   over equal   order CPU ms\n"
            << std::fixed;
  for (const Measured &m : all)
  {
    const Spread list = spread(m.list_ms), cpu = spread(m.list_cpu_ms), order = spread(m.order_cpu_ms);
    std::cout << std::left << std::setw(24) << m.name << std::right << std::setw(8) << m.cloud.radii.size()
              << std::setw(16) << std::setprecision(2) << pairs(m) << std::setw(17) << list.least << std::setw(11)
              << cpu.least << std::setw(7) << cpu.median << std::setw(13) << std::setprecision(1) << ns(m)
              << std::setw(13) << std::setprecision(2) << ns(m) / ns_of_equal(pairs(m)) << std::setw(15) << order.least
              << '\n';
    rows.push_back({{"case", m.name},
                    {"space", space},
                    {"grains", m.cloud.radii.size()},
                    {"pairs", m.n_pairs},
                    {"list_ms", {{"least", list.least}, {"median", list.median}, {"most", list.most}}},
                    {"list_cpu_ms", {{"least", cpu.least}, {"median", cpu.median}, {"most", cpu.most}}},
                    {"order_cpu_ms", {{"least", order.least}, {"median", order.median}, {"most", order.most}}},
                    {"ns_per_grain", ns(m)},
                    {"over_equal", ns(m) / ns_of_equal(pairs(m))}});
  }
  return rows;
}

nlohmann::json measure(const Options &options)
{
  omp_set_num_threads(options.n_threads);
  nlohmann::json rows = nlohmann::json::array();
  for (const bool is_periodic : {false, true})
  {
    std::vector<Measured> all;
    for (const Case &c : cases())
      if ((!is_periodic || c.distance == 0.) && // nothing leaves a periodic cell
          (all.size() < 2 || c.name.find(options.only) != std::string::npos))
        all.push_back({c.name, make_cloud(c, options.n_grains, is_periodic)});
    for (int round = 0; round < options.n_repeats; ++round) // in turns, so that other work meets all alike
      for (Measured &m : all)
      {
        Stopwatch watch;
        double list = 0.;
        const double start = cpu_ms();
        m.n_pairs = m.cloud.list(m.cloud.verlet_distance).size();
        const double between = cpu_ms();
        watch.lap(list);
        dem::spatial_order(m.cloud.positions, 1.);
        m.list_ms.push_back(1e3 * list);
        m.list_cpu_ms.push_back(between - start);
        m.order_cpu_ms.push_back(cpu_ms() - between);
      }
    rows.push_back(report(all, is_periodic ? "periodic cell" : "box"));
  }
  return {{"rows", rows}, {"threads", options.n_threads}};
}

std::optional<Options> parse(const int argc, char **const argv)
{
  Options o;
  CLI::App app(
      "Time to make the Verlet list and the spatial order of spheres thrown at random, of which those stay that "
      "overlap none, in their spatial order: of one size, of many sizes, and with grains that have left.",
      "neighbours");
  app.add_option("--grains", o.n_grains, "Thrown (default: 50000)")->check(CLI::Range(100, 100000000));
  app.add_option("--repeats", o.n_repeats, "Rounds (default: 15)")->check(CLI::PositiveNumber);
  app.add_option("--threads", o.n_threads, "Threads (default: 1)")->check(CLI::PositiveNumber);
  app.add_option("--only", o.only, "Only the first two cases and those with this in their names");
  app.add_option("--json", o.json, "Write the figures to this file, too");
  app.footer(
      "Radii are 1 or begin at 1, and grow by half once all lie apart, as the bounding spheres of long grains "
      "do. 'r^-3' is the number density over the radius; 'one of 10' is one grain of radius 10 among those of 1; "
      "'gas' has a thousandth of solids. 'ns a grain' is the least CPU time of a list; 'over equal' compares it "
      "with equal spheres that have as many pairs, between the first two rows.");
  if (!parse_arguments(app, argc, argv))
    return std::nullopt;
  return o;
}

} // namespace

int main(const int argc, char **const argv)
{
  return run_program("neighbours",
                     [&]
                     {
                       if (const auto options = parse(argc, argv))
                         write_figures(options->json, [&] { return measure(*options); });
                     });
}
