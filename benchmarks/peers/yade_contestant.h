#pragma once

#include "benchmarks/child_process.h"
#include "benchmarks/peers/contestant.h"

#include <nlohmann/json.hpp>

namespace bergamo::benchmark
{

/// YADE, Debian's yade: Law2_ScGeom_MindlinPhys_Mindlin with damping ratios (betan) and none along the tangent (betas),
/// triangles as facets with the curvature of a plane (hertzian). Along the normal and in the tangential stiffness it is
/// Bergamo's law to the formula, and the tangential force is summed up as a force, too. What differs: that force does
/// not shrink with a contact that opens; facets know nothing of one another, so a bead over the edge of two touches
/// both of them, even where they lie in one plane.
class YadeContestant : public Contestant
{
public:
  explicit YadeContestant(std::filesystem::path program);

  std::string name() const override { return "YADE"; }
  std::vector<double> distances() const override { return {0.05, 0.1, 0.2, 0.4}; }
  Track run(const BulkCase &bulk, double distance) override;
  double time(const BulkCase &bulk, int n_steps, double distance) override;

private:
  std::string execute(const BulkCase &bulk, double distance, const nlohmann::json &job) const;

  std::filesystem::path program;
  TemporaryFolder folder;
};

} // namespace bergamo::benchmark
