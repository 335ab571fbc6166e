#pragma once

#include "benchmarks/child_process.h"
#include "benchmarks/peers/contestant.h"

namespace bergamo::benchmark
{

/// LIGGGHTS-PUBLIC, Debian's liggghts: `model hertz tangential history` with limitForce on and no tangential damping.
/// Its spring and dashpot along the normal are Bergamo's, to the formula, and so is its tangential stiffness. What
/// differs: the tangential force follows from the displacement summed up, which Bergamo sums as a force; on triangles
/// each has a contact of its own, and one on an edge counts once for the faces that share it, by rules of angles.
class LiggghtsContestant : public Contestant
{
public:
  explicit LiggghtsContestant(std::filesystem::path program);

  std::string name() const override { return "LIGGGHTS"; }
  std::vector<double> distances() const override { return {0.05, 0.1, 0.2, 0.4}; }
  Track run(const BulkCase &bulk, double distance) override;
  double time(const BulkCase &bulk, int n_steps, double distance) override;

private:
  std::string execute(const BulkCase &bulk, double distance, const std::string &commands) const;

  std::filesystem::path program;
  TemporaryFolder folder;
};

} // namespace bergamo::benchmark
