#include "dem/io/grain_columns.h"

#include <algorithm>
#include <cmath>

namespace bergamo::dem
{
namespace
{

/// Finds columns by their names.
class Header
{
public:
  explicit Header(const TextRows &rows) : rows(rows), names(rows.names())
  {
    for (std::size_t k = 0; k < names.size(); ++k)
      if (std::find(names.begin(), names.begin() + k, names[k]) != names.begin() + k)
        rows.refuse("the column ", k + 1, " is called '", names[k], "' like one before it; give each its own name");
  }

  std::optional<std::size_t> find(const std::string &name) const
  {
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? std::nullopt : std::optional<std::size_t>(found - names.begin());
  }

  /// All of these columns, or none where the first is missing; one alone is refused.
  template <std::size_t n>
  bool find_all(const std::array<std::string, n> &wanted, std::array<std::optional<std::size_t>, n> &columns) const
  {
    std::size_t n_found = 0;
    for (std::size_t k = 0; k < n; ++k)
      n_found += (columns[k] = find(wanted[k])).has_value();
    if (n_found != 0 && n_found != n)
      for (std::size_t k = 0; k < n; ++k)
        if (!columns[k])
          rows.refuse("there is no column '", wanted[k], "' beside ", text_of(wanted), "; give all of them, or none");
    return n_found == n;
  }

  [[noreturn]] void miss(const std::string &what) const
  {
    rows.refuse("there are no columns for ", what, "; there are ", text_of(names));
  }

private:
  template <class Names>
  static std::string text_of(const Names &names)
  {
    std::string text;
    for (const std::string &name : names)
      text += (text.empty() ? "" : ", ") + name;
    return text;
  }

  const TextRows &rows;
  const std::vector<std::string> &names;
};

} // namespace

GrainColumns GrainColumns::of_csv(const TextRows &rows)
{
  const Header header(rows);
  GrainColumns c;
  c.id_ = header.find("id");
  c.material_ = header.find("material");
  if (!header.find_all({"x_m", "y_m", "z_m"}, c.place_))
    header.miss("the places, x_m, y_m and z_m");
  header.find_all({"qx", "qy", "qz", "qw"}, c.quaternion_);
  header.find_all({"exponent_1", "exponent_2"}, c.exponent_);
  if (header.find_all({"a_m", "b_m", "c_m"}, c.half_axis_))
    return c;
  c.half_axis_.fill(header.find("radius_m"));
  if (!c.half_axis_[0])
    header.miss("the sizes, half-axes a_m, b_m and c_m or radius_m");
  return c;
}

GrainColumns GrainColumns::of_dump(const TextRows &rows)
{
  const Header header(rows);
  GrainColumns c;
  c.id_ = header.find("id");
  c.material_ = header.find("type");
  c.first_material_ = 1;
  if (!header.find_all({"x", "y", "z"}, c.place_) && !header.find_all({"xu", "yu", "zu"}, c.place_))
    header.miss("the places, x, y and z (scaled ones, xs, are not read: dump x y z)");
  const bool is_lammps = header.find_all({"quati", "quatj", "quatk", "quatw"}, c.quaternion_);
  if (!is_lammps && !header.find_all({"quat2", "quat3", "quat4", "quat1"}, c.quaternion_))
    header.find_all({"Orientation.X", "Orientation.Y", "Orientation.Z", "Orientation.W"}, c.quaternion_);
  if (header.find_all({"blockiness2", "blockiness1"}, c.exponent_))
    c.exponents_are_blocks_ = true;
  else
    header.find_all({"SuperquadricRoundness.Phi", "SuperquadricRoundness.Theta"}, c.exponent_);
  if (header.find_all({"AsphericalShape.X", "AsphericalShape.Y", "AsphericalShape.Z"}, c.half_axis_))
    return c;
  if (header.find_all({"shapex", "shapey", "shapez"}, c.half_axis_))
  {
    c.axis_factor_ = is_lammps ? 0.5 : 1.;
    return c;
  }
  c.half_axis_.fill(header.find("radius"));
  if (!c.half_axis_[0])
  {
    c.half_axis_.fill(header.find("diameter"));
    c.axis_factor_ = 0.5;
  }
  if (!c.half_axis_[0])
    header.miss(
        "the sizes: shapex, shapey and shapez, radius or diameter (columns of computes, c_..., need these names: "
        "dump_modify colname)");
  return c;
}

std::optional<std::int64_t> GrainColumns::id(const TextRows &rows) const
{
  return id_ ? std::optional<std::int64_t>(rows.integer(*id_)) : std::nullopt;
}

Vec3 GrainColumns::place(const TextRows &rows) const
{
  return {rows.number(*place_[0]), rows.number(*place_[1]), rows.number(*place_[2])};
}

Quaternion GrainColumns::orientation(const TextRows &rows) const
{
  if (!quaternion_[0])
    return Quaternion::Identity();
  const Eigen::Vector4d q(rows.number(*quaternion_[0]), rows.number(*quaternion_[1]), rows.number(*quaternion_[2]),
                          rows.number(*quaternion_[3]));
  if (std::abs(q.norm() - 1.) > 1e-3)
    rows.refuse_word(*quaternion_[3], "with the other three it makes a quaternion of length ", q.norm(),
                     "; it must be 1");
  // One that is unit to rounding stays as it is, bit for bit.
  const bool is_unit = std::abs(q.squaredNorm() - 1.) < 1e-14;
  return Quaternion(is_unit ? q : Eigen::Vector4d(q / q.norm()));
}

Superquadric GrainColumns::shape(const TextRows &rows, const double unit) const
{
  Superquadric shape;
  for (int k = 0; k < 3; ++k)
  {
    shape.half_axes[k] = axis_factor_ * unit * rows.number(*half_axis_[k]);
    if (!(shape.half_axes[k] > 0.))
      rows.refuse_word(*half_axis_[k], "a length must be positive");
  }
  const auto exponent = [&](const std::size_t k)
  {
    const double number = rows.number(*exponent_[k]);
    if (exponents_are_blocks_ ? !(number > 1.) : !(number > 0. && number < 2.))
      rows.refuse_word(*exponent_[k], exponents_are_blocks_ ? "it must be above 1" : "it must be in (0, 2)");
    return exponents_are_blocks_ ? 2. / number : number;
  };
  if (exponent_[0])
  {
    shape.eps1 = exponent(0);
    shape.eps2 = exponent(1);
  }
  return shape;
}

std::int32_t GrainColumns::material(const TextRows &rows, const std::int32_t n_materials) const
{
  if (!material_)
    return 0;
  const std::int64_t number = rows.integer(*material_) - first_material_;
  if (number < 0 || number >= n_materials)
    rows.refuse_word(*material_, "the materials are ", first_material_, " to ", n_materials - 1 + first_material_);
  return static_cast<std::int32_t>(number);
}

} // namespace bergamo::dem
