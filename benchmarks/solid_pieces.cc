#include "benchmarks/solid_pieces.h"

#include "fe_dealii/element/finite_strain.h"
#include "fe_dealii/element/solid_elements.h"
#include "fe_dealii/element/solid_geometry.h"
#include "fe_dealii/element/stress_update.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <chrono>
#include <type_traits>

namespace bergamo::benchmark
{
namespace
{

using namespace fe;
using Clock = std::chrono::steady_clock;

constexpr std::size_t block_elements = 32; // as in a step

double seconds_since(const Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// All bricks are alike, so the first one's geometry is that of all.
template <int n_nodes>
SolidGeometry<n_nodes, packs_of(n_nodes)> brick_geometry(const dealii::DoFHandler<3> &dof_handler)
{
  const unsigned int degree = dof_handler.get_fe().degree;
  const dealii::FE_Q<3> scalar(degree);
  dealii::FEValues<3> values(scalar, dealii::QGauss<3>(degree + 1),
                             dealii::update_gradients | dealii::update_JxW_values);
  values.reinit(dof_handler.get_triangulation().begin_active());
  SolidGeometry<n_nodes, packs_of(n_nodes)> brick{};
  for (unsigned int point = 0; point < values.n_quadrature_points; ++point)
  {
    const unsigned int pack = point / points_per_pack, lane = point % points_per_pack;
    brick.volume[pack][lane] = values.JxW(point);
    for (int node = 0; node < n_nodes; ++node)
      for (int i = 0; i < 3; ++i)
        brick.gradient[pack][i][node][lane] = values.shape_grad(node, point)[i];
  }
  return brick;
}

/// The law at small strain, with the histories that it carries on.
template <class Law>
struct Increments
{
  Increments(const Law &of_points, ElementGroup &elements) : law(of_points)
  {
    const std::span<const double> values = elements.state().front().second;
    history.resize(values.size() * sizeof(double) / sizeof(history[0]));
    std::copy(values.begin(), values.end(), reinterpret_cast<double *>(history.data()));
    report.resize(points_per_pack * history.size());
  }

  void operator()(const Tensor3<Points> &strain, const Points &volume, const std::size_t pack)
  {
    // The gradient is symmetrized here; the few additions are the price of one kind of input for all laws.
    const Points components[6] = {strain[0][0] - 1.,           strain[1][1] - 1.,
                                  strain[2][2] - 1.,           strain[0][1] + strain[1][0],
                                  strain[1][2] + strain[2][1], strain[2][0] + strain[0][2]};
    update_stress(law, volume, components, history[pack], &report[points_per_pack * pack]);
  }

  Law law;
  std::vector<typename KeptAtPoints<Law>::History> history;
  std::vector<typename KeptAtPoints<Law>::Report> report;
};

/// The law at large strain: nothing is remembered, the stresses of a block are written to one place.
template <class Law>
struct Gradients
{
  Gradients(const Law &of_points, ElementGroup &) : law(of_points) {}

  void operator()(const Tensor3<Points> &f, const Points &volume, std::size_t)
  {
    const Tensor3<Points> minors = cofactor(f);
    const Points ratio = determinant(f, minors);
    const PointResponse<Points> response = law.respond(f, minors, ratio);
    stress = response.stress;
    energy += volume * response.energy;
    asm volatile("" : : "m"(stress), "m"(energy)); // somebody reads them
  }

  Law law;
  Tensor3<Points> stress;
  Points energy{};
};

/// @param u displacements that the gradients are of; @param per_pack elements that share a pack of points: the law is
/// asked at the points of the first of them
template <int n_nodes, class Law>
double time_law_at(Law &&law, const dealii::DoFHandler<3> &dof_handler, const ElementGroup &elements,
                   const std::vector<double> &u, const std::size_t per_pack)
{
  constexpr int n_packs = packs_of(n_nodes);
  const auto brick = brick_geometry<n_nodes>(dof_handler);
  std::vector<Tensor3<Points>> gradient(n_packs * block_elements);
  double seconds = 0.;
  for (std::size_t begin = 0; begin < elements.size(); begin += block_elements)
  {
    const std::size_t end = std::min(elements.size(), begin + block_elements);
    for (std::size_t e = begin; e < end; ++e)
    {
      double of_element[3 * n_nodes];
      for (int k = 0; k < 3 * n_nodes; ++k)
        of_element[k] = u[3 * std::size_t(elements.nodes(e)[k / 3]) + k % 3];
      for (int pack = 0; pack < n_packs; ++pack)
        gradient[n_packs * (e - begin) + pack] = finite_strain::deformation_gradient(brick, pack, of_element);
    }
    const auto start = Clock::now();
    for (std::size_t e = begin; e < end; e += per_pack)
      for (int pack = 0; pack < n_packs; ++pack)
        law(gradient[n_packs * (e - begin) + pack], brick.volume[pack], n_packs * e / per_pack + pack);
    seconds += seconds_since(start);
  }
  return seconds;
}

template <class Law>
using LawOfPoints = std::conditional_t<std::is_same_v<Law, LinearElastic> || std::is_same_v<Law, MohrCoulomb> ||
                                           std::is_same_v<Law, HypoplasticSand>,
                                       Increments<Law>, Gradients<Law>>;

} // namespace

SolidPieces::SolidPieces(const SolidCase &of_case, MovingSolid &of_solid)
    : what(of_case), solid(of_solid), elements(make_solid_elements(of_solid.body.dof_handler(), of_case.material,
                                                                   of_case.initial_stress(), {of_case.hourglass}))
{
  const auto present = solid.body.state();
  for (auto &[name, values] : elements->state())
    for (const auto &[other, from] : present)
      if (name == other)
        std::copy(from.begin(), from.end(), values.begin());
  const auto &u = solid.body.displacement(), &v = solid.body.velocity();
  for (std::size_t k = 0; k < u.size(); ++k)
  {
    before.push_back(u[k]);
    now.push_back(u[k] + solid.time_step * v[k]);
  }
}

double SolidPieces::time_elements(const int n_steps)
{
  const auto start = Clock::now();
  for (int n = 0; n < n_steps; ++n)
    for (std::size_t begin = 0; begin < elements->size(); begin += block_elements)
      elements->compute_forces(begin, std::min(elements->size(), begin + block_elements), now.data(), before.data());
  return seconds_since(start);
}

double SolidPieces::time_law(const int n_steps)
{
  std::vector<double> u = now;
  if (what.is_of_small_strain())
    for (std::size_t k = 0; k < u.size(); ++k)
      u[k] = now[k] - before[k];
  const auto time = [&](const auto &material)
  {
    LawOfPoints<std::remove_cvref_t<decltype(material)>> law(material, *elements);
    double seconds = 0.;
    for (int n = 0; n < n_steps; ++n)
      seconds += what.degree == 1
                     ? time_law_at<8>(law, solid.body.dof_handler(), *elements, u, what.bends() ? points_per_pack : 1)
                     : time_law_at<27>(law, solid.body.dof_handler(), *elements, u, 1);
    return seconds;
  };
  return std::visit(time, what.material);
}

} // namespace bergamo::benchmark
