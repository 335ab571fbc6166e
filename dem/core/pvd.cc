#include "dem/core/pvd.h"

#include "dem/core/whole_file.h"
#include "dem/core/xml.h"

#include <charconv>

namespace bergamo
{

void write_pvd(const std::filesystem::path &path, const std::span<const std::pair<double, std::string>> frames)
{
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n  <Collection>\n";
  for (const auto &[time, name] : frames)
  {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, time).ptr;
    text +=
        "    <DataSet timestep=\"" + std::string(digits, end) + "\" part=\"0\" file=\"" + xml_escaped(name) + "\"/>\n";
  }
  text += "  </Collection>\n</VTKFile>\n";

  write_whole_file(path, text);
}

} // namespace bergamo
