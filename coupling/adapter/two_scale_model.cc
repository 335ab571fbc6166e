#include "coupling/adapter/two_scale_model.h"

namespace bergamo::coupling
{

TwoScaleModel::TwoScaleModel(std::unique_ptr<dem::Simulation> grains, std::unique_ptr<fe::ExplicitBody> body,
                             const double time_step)
    : time_step_(grains ? grains->parameters().time_step : time_step)
{
  if (grains)
    grains_ = &model_.add(std::make_unique<GrainsMover>(std::move(grains)));
  if (body)
    body_ = &model_.add(std::make_unique<SolidMover>(std::move(body)));
}

void TwoScaleModel::join(const CouplingParameters &parameters, const std::span<const double> nodal_weight,
                         const std::span<const Vec3> reference_by_id)
{
  overlap_ = &model_.add(
      std::make_unique<ArlequinCoupling>(*grains_, *body_, parameters, OverlapPlace{nodal_weight, reference_by_id}));
}

} // namespace bergamo::coupling
