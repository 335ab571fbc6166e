#pragma once

#include <cstddef>

namespace bergamo::fe
{

class ElementGroup;

/// Bound from above, by at most 0.4 %, on the greatest |λ| of an element's K x = λ M x with its lumped mass [1/s²]; 0
/// for an element without mass or stiffness, or that is rigid; NaN where its stiffness is not finite. @param
/// displacement of the whole body [m]
double largest_eigenvalue(const ElementGroup &elements, std::size_t element, const double *displacement);

} // namespace bergamo::fe
