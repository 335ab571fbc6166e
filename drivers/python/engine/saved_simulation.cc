#include "drivers/python/engine/saved_simulation.h"

#include "dem/core/archive.h"
#include "dem/core/error.h"
#include "dem/io/snapshot.h"

#include <vector>

namespace bergamo::python
{
namespace
{

constexpr const char *kind = "simulation in Python", *materials_name = "python/materials";

} // namespace

void save(const dem::Simulation &simulation, const std::filesystem::path &path, const std::string &parameters)
{
  ArchiveWriter archive(path, kind);
  archive.write("parameters", parameters);
  std::vector<double> numbers;
  const dem::MaterialTable &table = simulation.parameters().materials;
  for (std::int32_t m = 0; m < table.size(); ++m)
    numbers.insert(numbers.end(), {table[m].young_modulus, table[m].poisson_ratio, table[m].density});
  archive.write(materials_name, numbers);
  dem::write_simulation(archive, simulation);
  archive.commit();
}

std::unique_ptr<dem::Simulation> load(const std::filesystem::path &path)
{
  const ArchiveReader archive(path, kind);
  const std::vector<double> numbers = archive.read_doubles(materials_name);
  if (numbers.empty() || numbers.size() % 3 != 0)
    throw RunError("the array " + std::string(materials_name) + " of " + path.string() + " has " +
                   std::to_string(numbers.size()) +
                   " numbers, not three for each material: it was written by another version; start the run anew");
  std::vector<dem::Material> materials;
  for (std::size_t k = 0; k < numbers.size(); k += 3)
    materials.push_back({numbers[k], numbers[k + 1], numbers[k + 2]});
  dem::SimulationParameters parameters;
  parameters.materials = dem::MaterialTable(materials);
  return dem::read_simulation(archive, parameters);
}

} // namespace bergamo::python
