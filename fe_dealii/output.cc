#include "fe_dealii/output.h"

#include "dem/core/error.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/material/principal.h"
#include "fe_dealii/membrane_body.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe.h>
#include <deal.II/grid/filtered_iterator.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/data_out.h>

#include <cmath>
#include <fstream>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace bergamo::fe
{

namespace
{

/// Writes a file by write(stream) aside and then renames it.
template <class Write>
void write_whole(const std::filesystem::path &path, const Write &write)
{
  const std::filesystem::path aside = path.string() + ".part";
  std::error_code error;
  {
    std::ofstream file(aside);
    if (file)
      write(file);
    file.flush();
    if (!file)
    {
      file.close();
      std::filesystem::remove(aside, error);
      throw RunError("cannot write " + path.string() + "; check that its folder exists, is writable and has space");
    }
  }
  std::filesystem::rename(aside, path, error);
  if (error)
  {
    const std::string reason = error.message();
    std::filesystem::remove(aside, error);
    throw RunError("cannot rename " + aside.string() + " to " + path.string() + ": " + reason);
  }
}

dealii::Vector<double> dealii_vector(const std::span<const double> values)
{
  return {values.begin(), values.end()};
}

template <int dim, class Body>
void write(const Body &body, const std::vector<std::string> &names, const std::vector<dealii::Vector<float>> &cell_data,
           const std::filesystem::path &path)
{
  using Output = dealii::DataOut<dim, 3>;
  Output output;
  output.attach_dof_handler(body.dof_handler());
  const std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation> vector_field(
      3, dealii::DataComponentInterpretation::component_is_part_of_vector);
  const auto displacement = dealii_vector(body.displacement()), velocity = dealii_vector(body.velocity());
  output.add_data_vector(displacement, std::vector<std::string>(3, "displacement"), Output::type_dof_data,
                         vector_field);
  output.add_data_vector(velocity, std::vector<std::string>(3, "velocity"), Output::type_dof_data, vector_field);
  for (std::size_t k = 0; k < cell_data.size(); ++k)
    output.add_data_vector(cell_data[k], names[k], Output::type_cell_data);
  // Quadratic elements as quadratic cells: their corners alone would show u = z (1 − z) as zero.
  const unsigned int degree = body.dof_handler().get_fe().degree;
  dealii::DataOutBase::VtkFlags flags;
  flags.write_higher_order_cells = degree > 1;
  output.set_flags(flags);
  if constexpr (requires { body.is_absent(0); })
  {
    using Cells = dealii::FilteredIterator<typename Output::cell_iterator>;
    output.set_cell_selection(Cells([&body](const typename Output::cell_iterator &cell)
                                    { return cell->is_active() && !body.is_absent(cell->active_cell_index()); }));
  }
  output.build_patches(degree);
  write_whole(path, [&](std::ostream &file) { output.write_vtu(file); });
}

} // namespace

void write_vtu(const ExplicitBody &body, const std::filesystem::path &path)
{
  std::vector<std::string> names{"stress_xx",
                                 "stress_yy",
                                 "stress_zz",
                                 "stress_xy",
                                 "stress_yz",
                                 "stress_zx",
                                 "principal_stress_1",
                                 "principal_stress_2",
                                 "principal_stress_3",
                                 "pressure",
                                 "deviatoric_stress",
                                 "yield_function",
                                 "equivalent_plastic_strain",
                                 "elastic_energy_density",
                                 "material_id"};
  bool has_voids = false;
  for (std::size_t e = 0; e < body.n_elements(); ++e)
    has_voids = has_voids || std::holds_alternative<HypoplasticSand>(body.material(e));
  if (has_voids)
    names.push_back("void_ratio");
  std::vector<dealii::Vector<float>> cell_data(names.size(), dealii::Vector<float>(body.n_elements()));
  for (std::size_t e = 0; e < body.n_elements(); ++e)
  {
    const ElementState state = body.state_of(e);
    const Stress &stress = state.stress;
    const PrincipalFrame<double> frame = principal_frame(stress);
    for (int i = 0; i < 6; ++i)
      cell_data[i][e] = stress[i];
    for (int k = 0; k < 3; ++k)
      cell_data[6 + k][e] = frame.value[k];
    cell_data[9][e] = -mean_stress(stress);
    cell_data[10][e] = std::sqrt(3 * second_invariant(stress));
    cell_data[11][e] = state.yield_function;
    cell_data[12][e] = state.plastic_strain;
    cell_data[13][e] = state.energy_density;
    cell_data[14][e] = body.material_id(e);
    if (has_voids)
      cell_data[15][e] = state.void_ratio;
  }
  write<3>(body, names, cell_data, path);
}

void write_vtu(const MembraneBody &body, const std::filesystem::path &path)
{
  const std::vector<std::string> names{"principal_stress_1", "principal_stress_2", "thickness",
                                       "elastic_energy_density"};
  std::vector<dealii::Vector<float>> cell_data(names.size(), dealii::Vector<float>(body.n_elements()));
  for (std::size_t e = 0; e < body.n_elements(); ++e)
  {
    const MembraneState state = body.membrane_state_of(e);
    for (int k = 0; k < 2; ++k)
      cell_data[k][e] = state.principal_stress[k];
    cell_data[2][e] = state.thickness;
    cell_data[3][e] = body.state_of(e).energy_density;
  }
  write<2>(body, names, cell_data, path);
}

} // namespace bergamo::fe
