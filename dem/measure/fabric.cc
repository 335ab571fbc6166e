#include "dem/measure/fabric.h"

namespace bergamo::dem
{

Mat3 fabric_tensor(const std::span<const TouchingContact> contacts)
{
  Mat3 sum = Mat3::Zero();
  if (contacts.empty())
    return sum;
  for (const TouchingContact &contact : contacts)
    sum += contact.state.normal * contact.state.normal.transpose();
  return sum / static_cast<double>(contacts.size());
}

} // namespace bergamo::dem
