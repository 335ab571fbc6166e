#pragma once

#include "coupling/adapter/two_scale_model.h"
#include "drivers/common/run/joined_start.h"
#include "drivers/common/run/rotation_watch.h"
#include "drivers/common/summary.h"
#include "drivers/two_scale_triaxial/packing_stage.h"
#include "drivers/two_scale_triaxial/specimen_boundary.h"
#include "drivers/two_scale_triaxial/specimen_sample.h"
#include "fe_dealii/step_control.h"

#include <memory>
#include <optional>
#include <vector>

namespace bergamo::driver
{

/// Throws ConfigError where the time step is above the stable one of the continuum, on the smallest cube that a packing
/// may end in: told before the grains are packed.
void require_stable_continuum(const TriaxialParameters &parameters);

/// The specimen under test: grains above, continuum below, joined in the overlap, between walls; or a layer of
/// continuum between grains, in a periodic cell; or one of them alone. Its edges follow prescribed strains.
class Specimen
{
public:
  /// @param grains the packing between six walls or in a periodic cell, or none for a continuum alone; @param start
  /// before any loading
  /// @throws ConfigError where the time step is above the stable one of the continuum
  Specimen(const TriaxialParameters &parameters, std::unique_ptr<dem::Simulation> grains, const LoadingStart &start);

  void settle(Progress &progress) { start_at_rest(model, progress); } ///< call once, before the first step

  /// One time step towards the strains at its end; measure() may be called in between. Throws RunError where the
  /// continuum has become too stiff for the step.
  void compute(const Vec3 &strain_now, const Vec3 &strain_next);
  void move() { model.drift(); }

  /// @param time [s]
  /// @throws RunError where the run has diverged, naming the time
  SpecimenSample measure(double time) const;

  std::int64_t n_grains() const { return model.grains() ? model.grains()->particles.size() : 0; }
  std::int64_t n_undecided() const { return model.grains() ? model.grains()->contacts.n_undecided() : 0; }

  /// Warns once where strains of the continuum are too small a description for its rotation.
  void look_at_rotation(Progress &progress);

  /// Stresses by height and, with grains, their forces, as stress_profile.csv and contact_forces.csv in a folder.
  void write_tables(const std::filesystem::path &folder, const std::vector<coupling::SlabStress> &profile) const;

  void add_figures(Summary &summary) const; ///< edges of the cube, and the greatest rotation of a continuum

  coupling::TwoScaleModel model;
  std::optional<fe::StepControl> body_steps; ///< watches that of the continuum
  RotationWatch rotation;                    ///< of the continuum's elements

private:
  void join(const std::vector<Vec3> &reference_by_id);

  const TriaxialParameters &parameters;
  dem::Box cube;
  Vec3 edges, strain = Vec3::Zero();
  double step;
  std::unique_ptr<SpecimenBoundary> boundary;
};

/// The state of a loading, by name; in reading the specimen is made.
void visit_loading(StateVisitor &visit, std::unique_ptr<Specimen> &specimen, LoadingStart &start,
                   const TriaxialParameters &parameters);

} // namespace bergamo::driver
