#include "dem/core/error.h"
#include "dem/simulation/cell_work.h"
#include "dem/simulation/simulation.h"
#include "dem/state/repeated.h"

#include <algorithm>
#include <string>

/// Copies of a periodic cell, and what becomes of it where it repeats itself no more.
namespace bergamo::dem
{

Simulation Simulation::repeated(const CellCopies &copies) const
{
  copies.validate(particles.cell);
  Simulation all = *this;
  all.before_moving = {};
  all.particles = dem::repeated(particles, copies);
  all.particles.look_at_weights();
  all.contacts.repeat(copies, particles.parts.size());
  all.index.follow(all.particles.id);
  all.next_id = 1 + *std::max_element(all.particles.id.begin(), all.particles.id.end());
  for (PlaneWall &wall : all.walls)
    wall.force *= copies.n();
  for (int d = 0; d < 3; ++d)
    all.accounts.cell_work.image_force[d] *= copies.n() / copies.n_along[d];
  all.accounts.last_external_force.clear();
  all.accounts.external_work.clear();
  all.sort_by_place();
  all.reset_accounts();
  return all;
}

void Simulation::open_cell(const Vec3 &shift)
{
  const PeriodicCell closed = particles.cell;
  for (int d = 0; d < 3; ++d)
    require(closed.is_periodic(d) || shift[d] == 0.,
            std::string("shift of the grains of a cell that is opened along ") + "xyz"[d], shift[d],
            "zero where the cell does not repeat itself [m]");
  renew_neighbours(); // grains are in the cell, and contacts name the images as they are there
  for (const TouchingContact &contact : contacts.touching(particles))
    if (contact.image != own_image)
      accounts.exchanged -= stored_energy(contact.state).normal; // what its tangential spring held counts as lost
  particles.cell = PeriodicCell();
  accounts.cell_work.image_force.setZero();
  for (Vec3 &place : particles.position)
    place += shift;
  sort_by_place();
}

} // namespace bergamo::dem
