#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace bergamo::fe
{

/// A dashpot between a node of a body and the ground at rest: the force −C v on the node.
struct Dashpot
{
  unsigned int node = 0, element = 0; ///< the element sets how stiff, and so how viscous, the body is there
  std::array<double, 6> viscosity{};  ///< C of the element at rest, xx yy zz xy yz zx, positive definite [N s/m]
};

/// All dashpots of a body, those of a node together.
class Dashpots
{
public:
  using Vector = std::array<double, 3>;

  bool empty() const { return nodes_.empty(); }
  const std::vector<unsigned int> &nodes() const { return nodes_; } ///< that have any, ascending

  /// @param n_nodes of the body
  void add(std::span<const Dashpot> dashpots, std::size_t n_nodes);

  const std::vector<unsigned int> &elements() const { return elements_; } ///< that they belong to, ascending

  /// Takes the viscosities of a step. @param factor of that at rest, of each of elements() [-]
  void set_viscosity(std::span<const double> factor);

  bool has(const std::size_t node) const { return !place_.empty() && place_[node] >= 0; }

  /// C v of a node that has dashpots [N].
  Vector drag(std::size_t node, const Vector &velocity) const;

  /// The velocity v⁺ after a kick with m (v⁺ − v⁻)/h = F − C (v⁻ + v⁺)/2, the centred form that sets no limit to the
  /// time step: all but the dashpots is in `without`. A component that is prescribed has its velocity there.
  struct Kick
  {
    Vector old{};                  ///< v⁻ [m/s]
    Vector without{};              ///< v⁺ without dashpots, or as prescribed [m/s]
    Vector inertia{};              ///< that a force over the time of the kick meets, m/h and its like [kg/s]
    std::array<bool, 3> is_free{}; ///< not prescribed
  };
  Vector velocity_after(std::size_t node, const Kick &kick) const;

private:
  std::vector<Dashpot> dashpots_;
  std::vector<unsigned int> nodes_, elements_;
  std::vector<std::size_t> element_place_;       // of each dashpot's element in elements_
  std::vector<int> place_;                       // of each node of the body in nodes_, −1 where it has none
  std::vector<std::array<double, 6>> viscosity_; // of nodes_
};

} // namespace bergamo::fe
