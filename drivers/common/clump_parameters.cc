#include "drivers/common/clump_parameters.h"

#include "dem/core/error.h"
#include "drivers/common/number_text.h"

#include <algorithm>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace bergamo::driver
{
namespace
{

/// Either the clump or why there is none.
struct ReadClump
{
  dem::ClumpShape clump;
  std::string refusal;
};

ReadClump read_clump(const std::string_view text)
{
  ReadClump result;
  for (std::size_t begin = 0; begin <= text.size();)
  {
    const std::size_t end = std::min(text.find(';', begin), text.size());
    const std::string part(trimmed(text.substr(begin, end - begin)));
    begin = end + 1;
    std::istringstream words(part);
    std::vector<double> v;
    for (std::string word; words >> word;)
    {
      const auto number = parse_number(word);
      if (!number)
        return {{}, "'" + word + "' in the part '" + part + "' is not a finite number"};
      v.push_back(*number);
    }
    if (v.size() != 8 && v.size() != 12)
      return {{}, "the part '" + part + "' has " + std::to_string(v.size()) + " numbers, not 8 or 12"};
    dem::ClumpPart read{{Vec3(v[3], v[4], v[5]), v[6], v[7]}, Vec3(v[0], v[1], v[2])};
    if (v.size() == 12)
      read.orientation = Quaternion(v[8], v[9], v[10], v[11]);
    result.clump.parts.push_back(read);
  }
  try
  {
    result.clump.validate();
  }
  catch (const ConfigError &error)
  {
    result.refusal = error.what();
  }
  return result;
}

std::string text_of(const dem::ClumpShape &clump)
{
  std::string text;
  for (const dem::ClumpPart &part : clump.parts)
  {
    const Vec3 &x = part.position, &r = part.shape.half_axes;
    std::vector<double> numbers{x[0], x[1], x[2], r[0], r[1], r[2], part.shape.eps1, part.shape.eps2};
    const Quaternion &q = part.orientation;
    if (q.coeffs() != Quaternion::Identity().coeffs())
      numbers.insert(numbers.end(), {q.w(), q.x(), q.y(), q.z()});
    text += text.empty() ? "" : " ;";
    for (const double number : numbers)
    {
      text += text.empty() ? "" : " ";
      text += exact_text(number);
    }
  }
  return text;
}

} // namespace

ParameterBinding bind_clump(dem::ClumpShape &clump)
{
  return {.refusal = [](const std::string &text) { return read_clump(text).refusal; },
          .assign = [&clump](const std::string &text) { clump = read_clump(text).clump; },
          .text = [&clump] { return text_of(clump); },
          .allowed = "parts x y z r1 r2 r3 eps1 eps2, and w x y z of a turned one, separated by semicolons"};
}

} // namespace bergamo::driver
