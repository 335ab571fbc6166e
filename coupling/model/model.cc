#include "coupling/model/model.h"

#include "dem/core/error.h"

#include <algorithm>

namespace bergamo::coupling
{

void Model::compute_forces()
{
  for (const auto &mover : movers_)
    mover->compute_forces();
  for (const auto &coupling : couplings_)
    coupling->apply();
}

void Model::kick(const double time_step)
{
  for (const auto &mover : movers_)
    mover->kick(time_step);
}

void Model::drift(const double time_step)
{
  for (const auto &mover : movers_)
    mover->drift(time_step);
  for (const auto &coupling : couplings_)
    coupling->follow(time_step);
}

StableSteps Model::stable_steps() const
{
  StableSteps steps;
  for (const auto &mover : movers_)
    steps.movers.push_back({mover->name(), mover->stable_step(), {}, mover->steps_per_force()});
  for (std::size_t k = 0; k < couplings_.size(); ++k)
  {
    steps.couplings.push_back({couplings_[k]->name(), couplings_[k]->stable_step()});
    const std::vector<const Mover *> on = couplings_[k]->movers();
    for (std::size_t m = 0; m < movers_.size(); ++m)
      if (std::find(on.begin(), on.end(), movers_[m].get()) != on.end())
        steps.movers[m].couplings.push_back(k);
  }
  return steps;
}

void Model::require_movers_of(const Coupling &coupling) const
{
  for (const Mover *mover : coupling.movers())
    if (std::none_of(movers_.begin(), movers_.end(), [&](const auto &known) { return known.get() == mover; }))
      reject("coupling '", coupling.name(), "' acts on '", mover->name(),
             "', which is no part of the model; add its movers first");
}

} // namespace bergamo::coupling
