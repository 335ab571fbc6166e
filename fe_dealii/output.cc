#include "fe_dealii/output.h"

#include "fe_dealii/error.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/material/principal.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/numerics/data_out.h>

#include <array>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

namespace bergamo::fe
{

void write_vtu(const ExplicitBody &body, const std::filesystem::path &path)
{
  const char *const names[] = {"stress_xx",
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
                               "equivalent_plastic_strain"};
  std::array<dealii::Vector<float>, std::size(names)> cell_data;
  for (auto &data : cell_data)
    data.reinit(body.n_elements());
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
  }

  dealii::DataOut<3> output;
  output.attach_dof_handler(body.dof_handler());
  const std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation> vector_field(
      3, dealii::DataComponentInterpretation::component_is_part_of_vector);
  using Output = dealii::DataOut<3>;
  output.add_data_vector(body.displacement(), std::vector<std::string>(3, "displacement"), Output::type_dof_data,
                         vector_field);
  output.add_data_vector(body.velocity(), std::vector<std::string>(3, "velocity"), Output::type_dof_data, vector_field);
  for (std::size_t k = 0; k < cell_data.size(); ++k)
    output.add_data_vector(cell_data[k], names[k], Output::type_cell_data);
  output.build_patches();

  const std::filesystem::path aside = path.string() + ".part";
  std::error_code error;
  {
    std::ofstream file(aside);
    if (file)
      output.write_vtu(file);
    file.flush();
    if (!file)
    {
      file.close();
      std::filesystem::remove(aside, error);
      throw AnalysisError("cannot write " + path.string() +
                          "; check that its folder exists, is writable and has space");
    }
  }
  std::filesystem::rename(aside, path, error);
  if (error)
  {
    const std::string reason = error.message();
    std::filesystem::remove(aside, error);
    throw AnalysisError("cannot rename " + aside.string() + " to " + path.string() + ": " + reason);
  }
}

} // namespace bergamo::fe
