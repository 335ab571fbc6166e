#include "fe_dealii/element/largest_eigenvalue.h"

#include "fe_dealii/element/element_group.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace bergamo::fe
{
namespace
{

// Upper bound on the greatest |λ| of a symmetric matrix A of n rows, which is overwritten. With T_m = tr A^m of even m,
// (T_2m/T_m)^(1/m) <= |λ| <= T_m^(1/m): squaring A closes the bracket from both sides, where a power iteration would
// come from below, the unsafe side, and may miss a mode. Compressed elements have negative λ, so the trace of A itself
// bounds nothing. NaN for a matrix that is not finite.
double largest_eigenvalue_bound(std::vector<double> &matrix, const std::size_t n)
{
  if (!std::all_of(matrix.begin(), matrix.end(), [](const double entry) { return std::isfinite(entry); }))
    return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> square(n * n);
  double log_scale = 0; // the power of A is matrix * exp(log_scale)
  double upper = 0;
  double power = 1;
  double log_trace_of_half = 0;
  for (int squaring = 0; squaring < 14; ++squaring)
  {
    double trace = 0;
    for (std::size_t i = 0; i < n; ++i)
      trace += matrix[n * i + i];
    if (squaring == 0 && !(trace > 0))
      for (const double entry : matrix)
        trace += 2 * std::abs(entry);
    if (!(trace > 0))
      return 0;
    const double log_trace = log_scale + std::log(trace);
    upper = log_trace / power;
    if (squaring > 1)
    {
      const double lower = (log_trace - log_trace_of_half) / (power / 2);
      if (upper - lower < 4e-3)
        break;
    }
    log_trace_of_half = log_trace;
    for (double &entry : matrix)
      // Tiny entries would sink into slow denormal numbers; against a trace of 1 they are nothing.
      entry = std::abs(entry) > 1e-60 * trace ? entry / trace : 0;
    std::fill(square.begin(), square.end(), 0.);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k)
        for (std::size_t j = 0; j < n; ++j)
          square[n * i + j] += matrix[n * i + k] * matrix[n * k + j];
    std::swap(matrix, square);
    log_scale = 2 * log_trace;
    power *= 2;
  }
  return std::exp(upper) * (1 + 1e-12); // covers rounding of the sums
}

} // namespace

double largest_eigenvalue(const ElementGroup &elements, const std::size_t element, const double *displacement)
{
  if (elements.is_rigid(element))
    return 0;
  const std::size_t n = elements.dofs_per_element();
  std::vector<double> matrix(n * n), mass(elements.nodes_per_element());
  elements.stiffness(element, displacement, matrix.data());
  elements.lumped_mass(element, mass.data());
  if (mass[0] <= 0) // no share in the continuum
    return 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      matrix[n * i + j] /= std::sqrt(mass[i / 3] * mass[j / 3]);
  return largest_eigenvalue_bound(matrix, n);
}

} // namespace bergamo::fe
