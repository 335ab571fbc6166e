#include "drivers/rve_triaxial/failure_report.h"

namespace bergamo::driver
{

std::string failure_report(const RveParameters &parameters, const std::vector<std::shared_ptr<Sample>> &samples)
{
  std::string failures, ways;
  for (const auto &sample : samples)
    if (!sample->failure.empty())
    {
      const std::string name = "\n  sample " + std::to_string(sample->settings.number) + ": ";
      failures += name + sample->failure;
      ways += name + parameters.alone(sample->settings);
    }
  if (failures.empty())
    return "";
  return "some samples failed; the others are kept:" + failures +
         "\n--restart tries them again with the same parameters, for failures of the machine; with other parameters "
         "they "
         "run by themselves in another folder (--output):" +
         ways;
}

} // namespace bergamo::driver
