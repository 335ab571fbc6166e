#pragma once

#include "coupling/adapter/two_scale_model.h"
#include "drivers/two_scale_triaxial/parameters.h"

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace bergamo::driver
{

/// Energies of both models and of their coupling [J]; the accounts open with the loading.
struct SpecimenEnergy
{
  double kinetic = 0., grains_elastic = 0., continuum_elastic = 0., coupling = 0.;
  double friction_loss = 0., viscous_loss = 0., plastic_loss = 0.;
  double wall_work = 0.;                         ///< of the walls on grains and of the boundary on the continuum
  double gravity_work = 0., curvature_work = 0.; ///< see dem::ContactLosses

  double balance() const
  {
    return kinetic + grains_elastic + continuum_elastic + coupling + friction_loss + viscous_loss + plastic_loss -
           wall_work - gravity_work - curvature_work;
  }
};

/// The cube under test: grains above, continuum below, joined in the overlap; or one of them alone. Its outer faces
/// move with prescribed strains: lower faces stand still, upper ones move.
class Specimen
{
public:
  /// @param grains the packing between six walls, or none for a continuum alone; @param box the grains' box before any
  /// loading (without grains: the cube); @param reference_by_id the grains' places at that time
  Specimen(const TriaxialParameters &parameters, std::unique_ptr<dem::Simulation> grains, const dem::Box &box,
           const std::vector<Vec3> &reference_by_id);

  /// One time step towards the strains at its end; sample() may be called in between.
  void compute(const Vec3 &strain_now, const Vec3 &strain_next);
  void move() { model.drift(); }

  /// Mean stresses of x, y, z from the forces on walls and boundary, tension positive [Pa] (Wellmann, fig. 6.5a).
  Vec3 stress() const;

  SpecimenEnergy energy() const;

  double time_step() const { return step; }
  Vec3 reference_edges() const { return edges; } ///< [m]

  coupling::TwoScaleModel model;

private:
  struct Face
  {
    std::optional<std::size_t> wall;                        ///< of the grains
    std::optional<fe::ExplicitBody::Constraint> constraint; ///< of the continuum
  };

  void join(const TriaxialParameters &parameters, const std::vector<Vec3> &reference_by_id, double layer);

  dem::Box cube;
  Vec3 edges, current_edges;
  double step;
  std::array<Face, 6> faces; ///< x-, x+, y-, y+, z-, z+
};

} // namespace bergamo::driver
