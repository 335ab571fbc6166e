#include "dem/law/hertz.h"

namespace bergamo::dem
{

ElasticPair elastic_pair(const Material &m1, const Material &m2)
{
  const double compliance1 = (1. + m1.poisson_ratio) / m1.young_modulus;
  const double compliance2 = (1. + m2.poisson_ratio) / m2.young_modulus;
  return {1. / (compliance1 * (1. - m1.poisson_ratio) + compliance2 * (1. - m2.poisson_ratio)),
          compliance1 + compliance2, m1.poisson_ratio * compliance1 + m2.poisson_ratio * compliance2};
}

} // namespace bergamo::dem
