#include "dem/io/grain_file.h"

#include "dem/geometry/rigid_clump.h"
#include "dem/io/grain_columns.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <set>
#include <sstream>
#include <unordered_set>
#include <utility>

namespace bergamo::dem
{
namespace
{

void require_unit(const double unit)
{
  if (!(unit > 0.) || !std::isfinite(unit))
    reject("the unit of a file's lengths is ", unit, " m; give a positive number, 0.001 for millimetres");
}

std::vector<std::string> texts_of(const std::vector<std::string_view> &words, const std::size_t first = 0)
{
  return {words.begin() + static_cast<std::ptrdiff_t>(first), words.end()};
}

bool is_table(const std::filesystem::path &path)
{
  return path.extension() == ".csv" || path.extension() == ".CSV";
}

/// Of a table: its names; of a dump: the head of its only time step. The next line is that of the first grain.
GrainColumns read_head(TextRows &rows, std::int64_t &n_announced)
{
  if (is_table(rows.path()))
  {
    rows.next();
    rows.name_columns(texts_of(rows.words()));
    return GrainColumns::of_csv(rows);
  }
  while (rows.next())
  {
    if (rows.text() == "ITEM: NUMBER OF ATOMS" && rows.next())
      n_announced = rows.integer(0);
    else if (rows.text().starts_with("ITEM: ATOMS"))
    {
      rows.name_columns(texts_of(rows.words(), 2));
      return GrainColumns::of_dump(rows);
    }
  }
  rows.refuse("there is no line 'ITEM: ATOMS'; give a dump of LAMMPS or LIGGGHTS, or a table whose name ends in .csv");
}

ClumpPart part_of(const TextRows &rows, const GrainColumns &columns, const double unit)
{
  ClumpPart part{columns.shape(rows, unit), unit * columns.place(rows), columns.orientation(rows)};
  try
  {
    part.shape.validate();
  }
  catch (const ConfigError &error)
  {
    rows.refuse(error.what());
  }
  return part;
}

/// Kinds of clumps that a file has, up to their size: the integrals over what parts share take half a second each.
class ClumpKinds
{
public:
  /// The clump in its principal frame. @param shape in the frame of its first part
  Clump of(const ClumpShape &shape)
  {
    const double size = shape.parts.front().shape.half_axes[0];
    ClumpShape unit = shape;
    for (ClumpPart &part : unit.parts)
    {
      part.shape.half_axes /= size;
      part.position /= size;
    }
    for (const Kind &kind : kinds)
      if (are_alike(kind.unit, unit))
        return kind.clump.scaled(size / kind.size);
    kinds.push_back({std::move(unit), size, Clump(shape)});
    return kinds.back().clump;
  }

private:
  struct Kind
  {
    ClumpShape unit; ///< over the first half-axis of its first part
    double size;     ///< that half-axis [m]
    Clump clump;
  };

  static constexpr double tolerance = 1e-6; // that of the integrals, and of files in single precision

  static bool are_alike(const ClumpPart &a, const ClumpPart &b)
  {
    return (a.shape.half_axes - b.shape.half_axes).norm() < tolerance &&
           std::abs(a.shape.eps1 - b.shape.eps1) < tolerance && std::abs(a.shape.eps2 - b.shape.eps2) < tolerance &&
           (a.position - b.position).norm() < tolerance && a.orientation.angularDistance(b.orientation) < tolerance;
  }
  static bool are_alike(const ClumpShape &a, const ClumpShape &b)
  {
    return std::equal(a.parts.begin(), a.parts.end(), b.parts.begin(), b.parts.end(),
                      [](const ClumpPart &p, const ClumpPart &q) { return are_alike(p, q); });
  }

  std::vector<Kind> kinds;
};

/// A body by the global places of its parts, and what all of it is made of.
struct Body
{
  ClumpShape shape;
  std::int32_t material = 0;
};

void add_body(Particles &particles, const Body &body, const double density, ClumpKinds &kinds)
{
  const ClumpPart &first = body.shape.parts.front();
  if (body.shape.parts.size() == 1)
  {
    particles.add(first.shape, density, first.position, first.orientation, body.material);
    particles.orientation.back() = first.orientation; // not made unit once more, which would change its last digits
    return;
  }
  const Clump clump = kinds.of(in_frame(body.shape, first.position, first.orientation));
  const ClumpPart &same = clump.parts().front(); // the first part in the principal frame
  const Quaternion principal = first.orientation * same.orientation.conjugate();
  particles.add(clump, density, first.position - principal * same.position, principal, body.material);
}

/// Ids of the file where they are 0 to n - 1; otherwise those that particles have, which count them.
void take_ids(Particles &particles, const std::vector<std::int64_t> &ids)
{
  std::vector<bool> is_there(ids.size(), false);
  for (const std::int64_t id : ids)
    if (id >= 0 && id < static_cast<std::int64_t>(ids.size()))
      is_there[id] = true;
  if (std::all_of(is_there.begin(), is_there.end(), [](const bool is) { return is; }))
    particles.id = ids;
}

Box box_of(const Particles &particles)
{
  Box box{Vec3::Constant(std::numeric_limits<double>::infinity()), {}};
  box.high = -box.low;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    const Vec3 reach = Vec3::Constant(particles.bounding_radius[i]);
    box.low = box.low.cwiseMin(particles.position[i] - reach);
    box.high = box.high.cwiseMax(particles.position[i] + reach);
  }
  return box;
}

std::string statement_of(const std::filesystem::path &path, const GrainsOfFile &grains)
{
  double smallest = std::numeric_limits<double>::infinity(), largest = 0.;
  for (const Superquadric &shape : grains.particles.parts.shape)
  {
    smallest = std::min(smallest, shape.half_axes.minCoeff());
    largest = std::max(largest, shape.half_axes.maxCoeff());
  }
  const auto &number = grains.particles.parts.material;
  std::ostringstream text;
  text << path.string() << ": " << grains.particles.size() << " grains";
  if (grains.particles.has_clumps())
    text << " of " << grains.particles.parts.size() << " parts";
  text << " with half-axes of " << smallest << " to " << largest << " m in";
  for (int k = 0; k < 3; ++k)
    text << (k ? " x [" : " [") << grains.box.low[k] << ", " << grains.box.high[k] << ']';
  text << " m; materials";
  for (const std::int32_t material : std::set<std::int32_t>(number.begin(), number.end()))
    text << ' ' << material;
  return text.str();
}

} // namespace

GrainsOfFile read_grains(const std::filesystem::path &path, const MaterialTable &materials, const double unit)
{
  require_unit(unit);
  TextRows rows(path, is_table(path) ? ',' : ' ');
  std::int64_t n_announced = -1;
  const GrainColumns columns = read_head(rows, n_announced);
  GrainsOfFile result;
  std::vector<std::int64_t> ids;
  std::unordered_set<std::int64_t> known;
  ClumpKinds kinds;
  Body body;
  const auto finish_body = [&]
  {
    if (!body.shape.parts.empty())
      add_body(result.particles, std::exchange(body, {}), materials[body.material].density, kinds);
  };
  const bool is_dump = !is_table(path);
  std::int64_t n_lines = 0;
  while ((!is_dump || n_lines != n_announced) && rows.next())
  {
    ++n_lines;
    const std::int64_t id = columns.id(rows).value_or(static_cast<std::int64_t>(ids.size()));
    const std::int32_t own_material = columns.material(rows, materials.size());
    const bool goes_on = !is_dump && !ids.empty() && id == ids.back();
    if (!goes_on)
    {
      finish_body();
      if (!known.insert(id).second)
        rows.refuse("the id ", id,
                    " was given to a grain before; only the parts of a clump have the same, line after line");
      ids.push_back(id);
    }
    else if (own_material != body.material)
      rows.refuse("the grain ", id, " is of material ", body.material, " and of ", own_material, "; give it one");
    body.material = own_material;
    body.shape.parts.push_back(part_of(rows, columns, unit));
  }
  finish_body();
  if (is_dump && n_announced >= 0 && n_lines != n_announced)
    rows.refuse("the file ends after ", n_lines, " grains of ", n_announced, "; write it again");
  rows.name_columns({});
  if (is_dump && rows.next())
    rows.refuse("behind its ", n_announced, " grains stands '", rows.text(), "'; give a file of one time step");
  if (ids.empty())
    rows.refuse("there are no grains");
  take_ids(result.particles, ids);
  result.box = box_of(result.particles);
  result.statement = statement_of(path, result);
  return result;
}

std::map<std::string, ClumpShape> read_clumps(const std::filesystem::path &path, const double unit)
{
  require_unit(unit);
  TextRows rows(path, ',');
  rows.next();
  rows.name_columns(texts_of(rows.words()));
  const GrainColumns columns = GrainColumns::of_csv(rows);
  const auto found = std::find(rows.names().begin(), rows.names().end(), "clump");
  if (found == rows.names().end())
    rows.refuse("there is no column 'clump' with the names of the clumps");
  const std::size_t column = found - rows.names().begin();
  std::map<std::string, ClumpShape> clumps;
  std::string last;
  while (rows.next())
  {
    const std::string name(rows.words()[column]);
    if (name != last && clumps.contains(name))
      rows.refuse_word(column, "parts of that clump stood before; keep its lines together");
    clumps[last = name].parts.push_back(part_of(rows, columns, unit));
  }
  if (clumps.empty())
    rows.refuse("there are no clumps");
  return clumps;
}

} // namespace bergamo::dem
