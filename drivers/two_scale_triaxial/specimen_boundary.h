#pragma once

#include "coupling/adapter/two_scale_model.h"
#include "drivers/two_scale_triaxial/specimen_sample.h"

#include <memory>

namespace bergamo::driver
{

/// What bounds a specimen: it leads the edges along the strains and feels their stresses.
class SpecimenBoundary
{
public:
  virtual ~SpecimenBoundary() = default;

  /// Between compute_forces() and kick(): the edges go on from the present step with these velocities [m/s].
  virtual void move(const Vec3 &velocity) = 0;

  /// Mean principal stresses of the present step, tension positive [Pa].
  /// @param edges present ones [m]; @param sample with its profile
  virtual Vec3 stress(const Vec3 &edges, const SpecimenSample &sample) const = 0;
};

/// Six smooth rigid walls about grains, and the faces of a continuum; the lower ones stand still, the upper ones move.
/// Stresses are the mean forces on opposite ones (Wellmann, fig. 6.5a). Joined, the grains have no floor, and the
/// continuum has no upper face. Before the models are joined. @param model must outlive it
std::unique_ptr<SpecimenBoundary> between_walls(coupling::TwoScaleModel &model, bool is_joined);

/// A periodic cell, whose continuum repeats itself, too: across, and along z where it is alone. The stress is that of
/// the cell, of both models. The node next to the middle of the continuum goes along with the cell's homogeneous
/// deformation, as nothing else holds a continuum between grains. Before the models are joined.
/// @param edges of the cell [m]
std::unique_ptr<SpecimenBoundary> in_periodic_cell(coupling::TwoScaleModel &model, const Vec3 &edges);

} // namespace bergamo::driver
