#pragma once

#include "dem/core/types.h"
#include "dem/geometry/face_plane.h"
#include "dem/geometry/surface_contact.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace bergamo::dem
{

struct Surface;

/// A feature among those of all surfaces, counted surface by surface: faces, edges, vertices.
struct FeatureOfSurface
{
  std::int32_t surface;
  Feature feature;
  std::int32_t number;
};

/// Which feature a count means. @param count in [0, sum of n_features())
FeatureOfSurface feature_of(std::span<const Surface> surfaces, std::int32_t count);

/// Surface of triangles that grains touch on the side of its normals. Its nodes move as they are told: who owns it sets
/// velocities, or moves it to places between steps, and takes the nodes' forces. A surface at rest costs nothing but
/// its contacts.
struct Surface
{
  Surface() = default;

  /// At rest. Throws ConfigError for triangles that make no surface, see SurfaceTopology.
  /// @param nodes places [m]; @param triangles anticlockwise as seen from the grains
  Surface(std::vector<Vec3> nodes, std::vector<Triangle> triangles);

  SurfaceView view() const { return {topology, node, offset}; }
  std::size_t n_features() const { return topology.n_faces() + topology.n_edges() + topology.n_nodes(); }
  bool is_at_rest() const { return drift_velocity.empty(); } ///< over the step before

  FeatureField<double> field_of(const FeatureOfSurface &feature) const; ///< over the step before; it has moved then

  /// Adds a force at a point on or above a feature to those on the nodes, with its moment, so that these do the work of
  /// the force along field_of() however the nodes move. @param[in,out] forces by node [N]
  void add_force(const FeatureOfSurface &feature, const Vec3 &point, const Vec3 &force, std::span<Vec3> forces) const;

  Vec3 direction_of_edge(std::int32_t edge) const;             ///< unit vector
  std::int32_t face_of(const FeatureOfSurface &feature) const; ///< the feature itself, or a face that has it

  /// Moves on with the velocities. @param time_step [s]
  void advance(double time_step);

  /// Moves from where advance() has left the nodes to given places, within the same step: places count, and the
  /// velocities that led there follow from them. @param places of all nodes [m]; @param time_step the drift's [s]
  void move_to(std::span<const Vec3> places, double time_step);

  /// Whether the nodes' forces are kept from step to step, for the work.
  bool keeps_forces() const { return !velocity.empty() || !drift_velocity.empty(); }

  /// Takes the forces of this step and books the work since the last one. @param time_step of the drift between [s]
  void take_forces(std::vector<Vec3> forces, double time_step);

  /// Throws ConfigError for numbers that are not finite, arrays of another length than the nodes, triangles without an
  /// area, or a material that the table lacks. @param n_materials of the table
  void validate(std::int32_t n_materials) const;

  SurfaceTopology topology;
  std::vector<Vec3> node;           ///< places [m]
  std::vector<Vec3> velocity;       ///< of the drift to come; empty: stays at rest; may be set between steps [m/s]
  std::vector<Vec3> drift_velocity; ///< over the step before, which led to the present places; empty: at rest [m/s]
  std::vector<Vec3> force; ///< of the grains on the nodes at this step, where kept; see Simulation::node_forces() [N]
  /// Grains touch what lies this far in front of the triangles, around their edges and vertices, too: half of a sheet's
  /// thickness where both of its sides are there [m], >= 0.
  double offset = 0.;
  double motion = 0.;        ///< path that no node has exceeded since the start [m]
  double work = 0.;          ///< done by the surface on the grains since the start [J]
  std::int32_t material = 1; ///< of the simulation's table
  /// Its nodes keep their distances: they rest, or move as those of one rigid body. Contacts on faces of others are
  /// searched every step while they move.
  bool is_rigid = false;

  template <class Self, class Visit>
  static void visit_state(Self &self, Visit &visit)
  {
    std::vector<std::int32_t> nodes_of_triangles = self.numbers();
    visit("triangles", nodes_of_triangles);
    visit("node", self.node);
    visit("velocity", self.velocity);
    visit("drift_velocity", self.drift_velocity);
    visit("force", self.force);
    visit("offset", self.offset);
    visit("motion", self.motion);
    visit("work", self.work);
    visit("material", self.material);
    std::int32_t is_rigid = self.is_rigid;
    visit("is_rigid", is_rigid);
    if constexpr (Visit::is_reading)
    {
      self.restore(nodes_of_triangles);
      self.is_rigid = is_rigid != 0;
    }
  }

private:
  FacePlane<double> plane_of(const Triangle &triangle) const;
  std::vector<std::int32_t> numbers() const;
  void restore(const std::vector<std::int32_t> &nodes_of_triangles);

  std::vector<Vec3> old_force;      // of the step before, where the surface moves
  std::vector<std::int32_t> loaded; // nodes with a force, some of them twice
};

/// Shares of the nodes of a feature at a point on it; they add up to 1.
struct NodeShares
{
  std::array<std::int32_t, 3> node;
  std::array<double, 3> share; ///< 0 for nodes that the feature lacks

  Vec3 of(std::span<const Vec3> values) const
  {
    return share[0] * values[node[0]] + share[1] * values[node[1]] + share[2] * values[node[2]];
  }
};

/// @param point in space: what is straight below it on the face, or on the line of the edge, counts [m]
NodeShares node_shares(const Surface &surface, Feature feature, std::int32_t number, const Vec3 &point);

} // namespace bergamo::dem
