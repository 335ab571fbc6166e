#include "dem/simulation/cell_work.h"

#include "dem/core/parallel.h"

namespace bergamo::dem
{
namespace
{

/// Power of the affine acceleration on the grains at their present velocities [W].
/// @param since the places are those of so long ago [s]
double kick_power(const Particles &p, const double since)
{
  const Vec3 gradient = stretching(p.cell);
  if (gradient == Vec3::Zero())
    return 0.;
  return ordered_sum(p.size(), 0.,
                     [&](const std::size_t i)
                     {
                       const Vec3 &v = p.velocity[i], place = p.position[i] - since * v;
                       return p.weight[i] * p.mass[i] * gradient.cwiseProduct(place).dot(v);
                     });
}

} // namespace

void CellWork::book_contacts(const PeriodicCell &cell, const Vec3 &force, const double drift)
{
  sum += half_kick + 0.5 * drift * (image_force + force).dot(cell.drift_rate);
  half_kick = 0.;
  image_force = force;
}

double CellWork::at_this_step(const Particles &particles, const double drift) const
{
  return sum + 0.5 * drift * kick_power(particles, 0.);
}

void CellWork::begin_kick(const Particles &particles, const double drift)
{
  sum = at_this_step(particles, drift);
}

void CellWork::end_kick(const Particles &particles, const double drift)
{
  half_kick = 0.5 * drift * kick_power(particles, drift);
}

double return_to_cell(Particles &particles)
{
  const PeriodicCell &cell = particles.cell;
  double change = 0.;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    if (particles.weight[i] < 1.) // tied to its place in a continuum
      continue;
    const Vec3 edges_over = (particles.position[i].array() / cell.edges.array()).floor();
    if (edges_over == Vec3::Zero())
      continue;
    Vec3 &velocity = particles.velocity[i];
    const double old_square = velocity.squaredNorm();
    particles.position[i] -= edges_over.cwiseProduct(cell.period);
    velocity -= edges_over.cwiseProduct(cell.rate);
    particles.drift_velocity[i] -= edges_over.cwiseProduct(cell.drift_rate); // as seen against its new images
    change += 0.5 * particles.weight[i] * particles.mass[i] * (velocity.squaredNorm() - old_square);
  }
  return change;
}

Vec3 stretching(const PeriodicCell &cell)
{
  return cell.is_periodic() ? Vec3(cell.acceleration.cwiseQuotient(cell.edges)) : Vec3(Vec3::Zero());
}

} // namespace bergamo::dem
