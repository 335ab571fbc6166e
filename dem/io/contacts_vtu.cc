#include "dem/io/contacts_vtu.h"

#include "dem/io/vtk_cell.h"
#include "dem/io/vtu_writer.h"
#include "dem/measure/contact_list.h"

#include <cstdint>

namespace bergamo::dem
{

void write_contacts_vtu(const Particles &particles, const std::span<const TouchingContact> contacts,
                        const std::filesystem::path &path)
{
  const std::size_t n = contacts.size();
  const auto array = [n](const std::string &attributes, const std::size_t bytes, auto put) {
    return VtuArray{attributes, n, bytes, put};
  };
  const auto scalar = [&](const std::string &name, auto value)
  {
    return array(vtu_attributes("Float32", name), sizeof(float),
                 [contacts, value](const std::size_t c, std::byte *out)
                 { put_bytes(out, static_cast<float>(value(contacts[c].state))); });
  };
  const auto id = [&](const std::string &name, std::int32_t TouchingContact::*grain)
  {
    return array(vtu_attributes("Int64", name), sizeof(std::int64_t),
                 [contacts, &particles, grain](const std::size_t c, std::byte *out)
                 {
                   const std::int32_t i = contacts[c].*grain;
                   put_bytes(out, i == no_grain ? std::int64_t(-1) : particles.id[i]);
                 });
  };
  const VtuArray points{vtu_attributes("Float64", "Points", 3), n, 6 * sizeof(double),
                        [&](const std::size_t c, std::byte *out)
                        {
                          const Vec3 &begin = particles.position[contacts[c].first];
                          put_bytes<double>(out, begin);
                          put_bytes<double>(out, begin + contacts[c].branch);
                        }};
  const VtuArray connectivity = array(vtu_attributes("Int32", "connectivity"), 2 * sizeof(std::int32_t),
                                      [](const std::size_t c, std::byte *out)
                                      {
                                        put_bytes(out, static_cast<std::int32_t>(2 * c));
                                        put_bytes(out, static_cast<std::int32_t>(2 * c + 1));
                                      });
  const VtuArray offsets =
      array(vtu_attributes("Int64", "offsets"), sizeof(std::int64_t),
            [](const std::size_t c, std::byte *out) { put_bytes(out, static_cast<std::int64_t>(2 * (c + 1))); });
  const VtuArray types = array(vtu_attributes("UInt8", "types"), sizeof vtk_line,
                               [](std::size_t, std::byte *out) { put_bytes(out, vtk_line); });
  const VtuArray tangential =
      array(vtu_attributes("Float32", "tangential_force", 3), 3 * sizeof(float),
            [contacts](const std::size_t c, std::byte *out)
            { put_bytes<float>(out, contacts[c].state.weight * contacts[c].state.forces.tangential); });
  const VtuArray normal =
      array(vtu_attributes("Float32", "normal", 3), 3 * sizeof(float),
            [contacts](const std::size_t c, std::byte *out) { put_bytes<float>(out, contacts[c].state.normal); });
  const VtuArray place = array(vtu_attributes("Float64", "point", 3), 3 * sizeof(double),
                               [contacts, &particles](const std::size_t c, std::byte *out)
                               { put_bytes<double>(out, contact_point(contacts[c], particles)); });
  write_vtu({2 * n,
             n,
             points,
             {connectivity, offsets, types},
             {},
             {id("first", &TouchingContact::first), id("second", &TouchingContact::second),
              scalar("normal_force", [](const ContactView &s) { return s.weight * s.forces.normal; }), tangential,
              normal, place, scalar("overlap", [](const ContactView &s) { return s.overlap; })}},
            path);
}

} // namespace bergamo::dem
