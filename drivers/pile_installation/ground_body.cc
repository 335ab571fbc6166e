#include "drivers/pile_installation/ground_body.h"

#include "dem/core/error.h"
#include "drivers/common/bearable_stress.h"
#include "fe_dealii/mesh/pit_mesh.h"
#include "fe_dealii/stable_step.h"

#include <deal.II/grid/tria.h>

namespace bergamo::driver
{

std::unique_ptr<fe::ExplicitBody> make_ground(const InstallationParameters &p, const InstallationStart &start,
                                              const GroundPlan &plan)
{
  const fe::Material material = p.continuum.material();

  fe::ExplicitBodyParameters body;
  body.material = material;
  body.kind.hourglass = p.bending_elements ? fe::Hourglass::bending : fe::Hourglass::at_points;
  body.kind.kinematics = p.large_strain ? fe::Kinematics::large_strain : fe::Kinematics::small_strain;
  body.gravity = {0., 0., -p.gravity()};
  body.damping = p.continuum_damping;
  body.initial_stress =
      [material, top = plan.top, weight = p.continuum.density() * p.gravity(), ratio = start.at_rest](const auto &place)
  {
    const Vec3 stress = bearable(material, -weight * (top - place[2]) * ratio);
    return fe::Stress{stress[0], stress[1], stress[2], 0., 0., 0.};
  };
  dealii::Triangulation<3> mesh;
  fe::make_pit(mesh_of(plan, p.mesh), mesh);
  return std::make_unique<fe::ExplicitBody>(mesh, body);
}

void require_below(const double limit, const double time_step)
{
  if (time_step > limit)
    reject("Pile/time step is ", time_step, " s: it must stay below ", limit, " s, the stable step of the elements");
}

void require_stable_ground(const InstallationParameters &p)
{
  if (!p.is_two_scale())
    return;
  constexpr double densest = 0.74;
  InstallationStart least;
  least.sand.level = p.sand.box[2] * p.sand.solid_fraction / densest;
  least.at_rest = {0.5, 0.5, 1.};
  require_below(fe::stable_step(*make_ground(p, least, p.plan(least.sand.level))).time_step, p.simulation.time_step);
}

} // namespace bergamo::driver
