#pragma once

#include "dem/core/pack_vectors.h"
#include "dem/force/contact_store.h"

#include <cstdint>
#include <vector>

namespace bergamo::dem
{

/// What one contact gives to its bodies: the force on body 1 (body 2 gets the opposite) and both torques about the
/// centres, with the contact's weight.
struct Resultant
{
  Vec3 force = Vec3::Zero();                           ///< [N]
  Vec3 torque1 = Vec3::Zero(), torque2 = Vec3::Zero(); ///< [N m]
};

/// Force and torque on one body, in one line of the cache; the fourth numbers mean nothing.
struct alignas(64) BodyLoad
{
  Vec4 force = Vec4::Zero();  ///< [N]
  Vec4 torque = Vec4::Zero(); ///< about the centre [N m]

  BodyLoad &operator+=(const BodyLoad &other)
  {
    force += other.force;
    torque += other.torque;
    return *this;
  }
};

/// What the contacts of a periodic cell add up to, by direction; forces on body 1, with the weights [N m].
template <class Real>
struct Virial
{
  Vector3<Real> branch{Real(0.), Real(0.), Real(0.)}; ///< sum of branch * force: volume * mean stress (Wellmann 5.3)
  Vector3<Real> image{Real(0.), Real(0.), Real(0.)};  ///< sum of shifts of the second grains' images * force (5.5)

  /// @param half_line half the branch, shift of the second grain's image [m]
  void add(const Vector3<Real> &half_line, const Vector3<Real> &shift, const Vector3<Real> &force)
  {
    branch += Real(2.) * half_line.cwiseProduct(force);
    image += shift.cwiseProduct(force);
  }
};

/// Sums what contacts give to their bodies without locks, and the same bits on any number of threads: the slots of the
/// contacts make chunks of fixed size, a chunk sums by itself for each of its bodies, and a body adds up what its
/// chunks hold for it, in their order. Neighbours share chunks, so that a chunk has far fewer bodies than contacts and
/// sums within the core's own cache.
class LoadSums
{
public:
  std::size_t n_chunks() const { return count.size(); }

  /// Whether the bodies of each chunk are listed for the slots as they are; if not, list_bodies() comes first.
  bool is_current() const { return current; }

  /// Lists the bodies of each chunk; what chunks have summed for their bodies stays.
  /// @param first, second bodies by slot, in [0, n_bodies)
  void list_bodies(const std::vector<std::int32_t> &first, const std::vector<std::int32_t> &second,
                   std::size_t n_bodies);

  /// Follows a slot that has been given to a contact of two bodies; is_current() no longer where room is short.
  void take(std::int32_t slot, std::int32_t first, std::int32_t second);

  /// Begins the sums of a chunk at zero.
  void start(const std::size_t chunk)
  {
    for (auto entry = row[chunk]; entry < row[chunk] + count[chunk]; ++entry)
      load[entry] = {};
    for (auto entry = row[chunk]; !transfer.empty() && entry < row[chunk] + count[chunk]; ++entry)
      transfer[entry] = {};
    block_virial[chunk] = {};
    slot_virial[chunk] = {};
  }

  /// Adds what a block of contacts gives, in the order of the slots; an unused slot must give nothing.
  void add(const std::size_t block, const Vector3<Pack> &force, const Vector3<Pack> &torque1,
           const Vector3<Pack> &torque2)
  {
    alignas(64) Vec4 f[pack_width], t1[pack_width], t2[pack_width];
    math::scatter_vectors<Pack>(force, [&](const int lane) -> Vec4 & { return f[lane]; });
    math::scatter_vectors<Pack>(torque1, [&](const int lane) -> Vec4 & { return t1[lane]; });
    math::scatter_vectors<Pack>(torque2, [&](const int lane) -> Vec4 & { return t2[lane]; });
    const Targets *targets = &target[block * pack_width];
    for (int lane = 0; lane < pack_width; ++lane)
    {
      BodyLoad &on1 = load[targets[lane].first], &on2 = load[targets[lane].second];
      on1.force += f[lane];
      on1.torque += t1[lane];
      on2.force -= f[lane];
      on2.torque += t2[lane];
    }
  }

  /// Adds what the contact of one slot gives.
  void add(const std::int32_t slot, const Resultant &r)
  {
    BodyLoad &on1 = load[target[slot].first], &on2 = load[target[slot].second];
    on1.force.head<3>() += r.force;
    on1.torque.head<3>() += r.torque1;
    on2.force.head<3>() -= r.force;
    on2.torque.head<3>() += r.torque2;
  }

  /// Whether transfers are summed, too: where weights differ, what a body's own weight makes of a contact beyond that
  /// of the contact (see Particles::transfer_force).
  bool has_transfers() const { return sums_transfers; }
  void sum_transfers(bool are_wanted);

  /// Adds shares of what the contact of one slot gives, on body 1 and on body 2.
  void add_transfer(const std::int32_t slot, const Resultant &r, const double share1, const double share2)
  {
    BodyLoad &on1 = transfer[target[slot].first], &on2 = transfer[target[slot].second];
    on1.force.head<3>() += share1 * r.force;
    on1.torque.head<3>() += share1 * r.torque1;
    on2.force.head<3>() -= share2 * r.force;
    on2.torque.head<3>() += share2 * r.torque2;
  }

  /// The virial of a chunk's blocks, and of its single contacts, to be added to.
  Virial<Pack> &virial_of_block(const std::size_t block) { return block_virial[block * pack_width / slots_per_chunk]; }
  Virial<double> &virial_of_slot(const std::int32_t slot) { return slot_virial[slot / slots_per_chunk]; }

  /// Adds to `sum` the virial of all contacts.
  void add_virial(Virial<double> &sum) const;

  /// Adds to `sum` what all contacts give to a body, and what they transfer. @{
  void add_load(const std::size_t body_index, BodyLoad &sum) const { add_entries(load, body_index, sum); }
  void add_transfer(const std::size_t body_index, BodyLoad &sum) const
  {
    if (has_transfers())
      add_entries(transfer, body_index, sum);
  }
  /// @}

private:
  /// Where the contact of a slot adds to.
  struct Targets
  {
    std::int32_t first = 0, second = 0;
  };

  void add_entries(const std::vector<BodyLoad> &entries, const std::size_t body_index, BodyLoad &sum) const
  {
    if (body_index + 1 >= body_row.size())
      return; // not among the bodies listed
    for (auto k = body_row[body_index]; k < body_row[body_index] + body_count[body_index]; ++k)
      sum += entries[body_entry[k]];
  }

  std::int32_t entry_of(std::size_t chunk, std::int32_t body_index);
  bool list_entry(std::int32_t body_index, std::int32_t entry);

  bool current = false, sums_transfers = false;
  // Entries of chunk c: row[c] .. row[c] + count[c], with room for more up to row[c + 1].
  std::vector<std::int32_t> row, count;
  std::vector<std::int32_t> body;         // by entry
  std::vector<BodyLoad> load;             // by entry, of this step
  std::vector<BodyLoad> transfer;         // likewise; empty where none are summed
  std::vector<Targets> target;            // by slot
  std::vector<Virial<Pack>> block_virial; // by chunk, of this step
  std::vector<Virial<double>> slot_virial;
  // Entries of body b, in the order of the chunks: body_entry[body_row[b]] .. + body_count[b], with room as above.
  std::vector<std::int32_t> body_row, body_count, body_entry;
};

} // namespace bergamo::dem
