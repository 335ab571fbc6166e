#include "drivers/pile_installation/fields.h"

#include "coupling/adapter/cell_stress.h"
#include "dem/io/grid_vtu.h"
#include "dem/measure/stress.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace bergamo::driver
{
namespace
{

/// Square cells from a lower end upwards, and even on both sides of the pile.
dem::HexahedronGrid square_grid(const GrainDomain &domain, const double breadth, const double top, const double edge,
                                const int n_across)
{
  const int n_upwards = std::max(1, static_cast<int>(std::ceil((top - domain.bottom) / edge - 1e-9)));
  const Vec3 half(0.5 * n_across * edge, 0.5 * breadth, 0.);
  const Vec3 low = -half + domain.bottom * Vec3::UnitZ();
  return {{low, half + (domain.bottom + n_upwards * edge) * Vec3::UnitZ()}, {n_across, 1, n_upwards}};
}

double top_of(const InstallationParameters &p, const InstallationStart &start)
{
  return start.sand.height + p.pile.width;
}

Vec3 centre_of(const dem::HexahedronGrid &grid, const std::size_t cell)
{
  const std::size_t nx = grid.n_cells[0], ny = grid.n_cells[1];
  const auto along = [](const std::size_t n) { return static_cast<double>(n) + 0.5; };
  return grid.box.low +
         grid.cell_edges().cwiseProduct(Vec3(along(cell % nx), along(cell / nx % ny), along(cell / (nx * ny))));
}

/// Of two scales less the largest grain: such whose centres lie beyond the block are gone, so up to its radius from the
/// block's edge there is less than there was.
GrainDomain domain_of(const Installation &installation, const InstallationParameters &p)
{
  const std::optional<GroundPlan> &plan = installation.plan();
  if (!plan)
    return {0.5 * p.sand.box[0], 0.};
  const double grain = p.sand.distribution.largest_half_axis * std::cbrt(6. / std::numbers::pi); // as its box
  return {plan->outer_half_width - grain, plan->outer_bottom + grain};
}

} // namespace

std::vector<double> solid_fractions(const std::span<const dem::Sphere> grains, const dem::HexahedronGrid &grid,
                                    const GrainDomain &domain, const double radius)
{
  const double inside = radius * (1. - 1e-9); // a sphere may touch the edges
  std::vector<std::size_t> cells;
  std::vector<Vec3> centres;
  for (std::size_t cell = 0; cell < grid.size(); ++cell)
  {
    const Vec3 centre = centre_of(grid, cell);
    if (std::abs(centre[0]) + inside > domain.half_width || centre[2] - inside < domain.bottom)
      continue;
    cells.push_back(cell);
    centres.push_back(centre);
  }
  const std::vector<double> sampled = dem::sampled_solid_fraction(grains, centres, radius);
  std::vector<double> fractions(grid.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t k = 0; k < cells.size(); ++k)
    fractions[cells[k]] = sampled[k];
  return fractions;
}

dem::HexahedronGrid solid_fraction_grid(const InstallationParameters &p, const InstallationStart &start)
{
  const double edge = p.fields.spacing;
  const int n_across = std::max(1, static_cast<int>(std::floor(p.sand.box[0] / edge + 1e-9)));
  return square_grid({0.5 * p.sand.box[0], 0.}, p.sand.box[1], top_of(p, start), edge, n_across);
}

dem::HexahedronGrid stress_grid(const InstallationParameters &p, const InstallationStart &start)
{
  const GrainDomain ground{0.5 * p.sand.box[0] + (p.is_two_scale() ? p.beyond_sides : 0.),
                           p.is_two_scale() ? -p.beyond_bottom : 0.};
  const int n_across = std::max(1, static_cast<int>(std::lround(2. * ground.half_width / p.fields.stress_cell)));
  return square_grid(ground, p.sand.box[1], top_of(p, start), 2. * ground.half_width / n_across, n_across);
}

void write_solid_fraction(const Installation &installation, const InstallationParameters &p,
                          const std::filesystem::path &path)
{
  const dem::HexahedronGrid grid = solid_fraction_grid(p, installation.start());
  const std::vector<double> fractions = solid_fractions(dem::equivalent_spheres(installation.sand().particles), grid,
                                                        domain_of(installation, p), p.fields.sphere_radius);
  const dem::GridField fields[] = {{"solid_fraction", std::span<const double>(fractions)}};
  dem::write_grid_vtu(grid, {.of_cells = fields}, path);
}

void write_stress(const Installation &installation, const InstallationParameters &p, const std::filesystem::path &path)
{
  using coupling::CellStress;
  using Measure = std::function<double(const CellStress &)>;
  const auto component = [](const int i, const int j)
  { return [i, j](const CellStress &cell) { return 0.5 * (cell.total()(i, j) + cell.total()(j, i)); }; };
  const std::pair<const char *, Measure> measures[] = {
      {"pressure", [](const CellStress &cell) { return dem::pressure(cell.total()); }},
      {"deviatoric_stress", [](const CellStress &cell) { return dem::deviatoric_stress(cell.total()); }},
      {"stress_xx", component(0, 0)},
      {"stress_yy", component(1, 1)},
      {"stress_zz", component(2, 2)},
      {"stress_zx", component(2, 0)},
      {"pressure_of_grains", [](const CellStress &cell) { return dem::pressure(cell.grains); }},
      {"pressure_of_continuum", [](const CellStress &cell) { return dem::pressure(cell.continuum); }}};

  const dem::HexahedronGrid grid = stress_grid(p, installation.start());
  const std::vector<CellStress> cells = coupling::cell_stresses(installation.models(), grid);
  std::vector<std::vector<double>> values;
  values.reserve(std::size(measures));
  std::vector<dem::GridField> fields;
  for (const auto &[name, measure] : measures)
  {
    std::transform(cells.begin(), cells.end(), std::back_inserter(values.emplace_back()), measure);
    fields.push_back({name, std::span<const double>(values.back())});
  }
  dem::write_grid_vtu(grid, {.of_cells = fields}, path);
}

} // namespace bergamo::driver
