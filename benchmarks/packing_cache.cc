#include "benchmarks/packing_cache.h"

#include "dem/core/error.h"
#include "dem/io/snapshot.h"

#include <chrono>
#include <cmath>
#include <sstream>

namespace bergamo::benchmark
{
namespace
{

namespace fs = std::filesystem;

constexpr const char *archive_kind = "settled packing";
constexpr int route = 4; // increase it with every change of settle_packing()

/// Figures of the packing after one more step: they tell whether the engine still reads its own files rightly.
PackingFigures figures_after_step(const dem::Simulation &packing)
{
  dem::Simulation next = packing;
  next.step();
  return packing_figures(next);
}

std::unique_ptr<dem::Simulation> read_packing(const fs::path &path, const PackingRecipe &recipe)
{
  const ArchiveReader archive(path, archive_kind);
  if (archive.read_integer("recipe/route") != route || archive.read_double("recipe/pressure") != recipe.pressure ||
      archive.read_integer("recipe/seed") != static_cast<std::int64_t>(recipe.seed))
    throw RunError(path.string() + " was packed in another way");
  auto packing = dem::read_simulation(archive, sand_parameters());
  const PackingFigures figures = figures_after_step(*packing);
  const auto agrees = [&](const char *name, const double value)
  {
    const double stored = archive.read_double(name);
    return std::abs(value - stored) <= 0.01 * std::abs(stored);
  };
  if (static_cast<int>(packing->particles.size()) != recipe.n_grains ||
      !agrees("figures/coordination_number", figures.coordination_number) ||
      !agrees("figures/pressure", figures.pressure) || !agrees("figures/solid_fraction", figures.solid_fraction))
    throw RunError(path.string() + " does not give back the packing that was stored");
  return packing;
}

void write_packing(const fs::path &path, const PackingRecipe &recipe, const dem::Simulation &packing)
{
  const PackingFigures figures = figures_after_step(packing);
  ArchiveWriter archive(path, archive_kind);
  archive.write("recipe/route", route);
  archive.write("recipe/pressure", recipe.pressure);
  archive.write("recipe/seed", recipe.seed);
  archive.write("figures/coordination_number", figures.coordination_number);
  archive.write("figures/pressure", figures.pressure);
  archive.write("figures/solid_fraction", figures.solid_fraction);
  dem::write_simulation(archive, packing);
  archive.commit();
}

} // namespace

std::unique_ptr<dem::Simulation> cached_packing(const fs::path &folder, const PackingRecipe &recipe,
                                                const std::function<void(const std::string &)> &log)
{
  const std::string title = std::to_string(recipe.n_grains) + ' ' + name(recipe.kind);
  const fs::path path = folder / (name(recipe.kind) + '_' + std::to_string(recipe.n_grains) + ".h5");
  std::error_code ignored;
  if (fs::exists(path, ignored))
    try
    {
      auto packing = read_packing(path, recipe);
      log(title + ": settled packing read from " + path.string());
      return packing;
    }
    catch (const RunError &error)
    {
      log(title + ": packed anew, because " + error.what());
    }
  const auto start = std::chrono::steady_clock::now();
  auto packing = settle_packing(recipe, [&](const std::string &line) { log(title + ' ' + line); });
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  write_packing(path, recipe, *packing);
  std::ostringstream text;
  text << title << ": settled in " << seconds << " s and kept in " << path.string();
  log(text.str());
  return packing;
}

} // namespace bergamo::benchmark
