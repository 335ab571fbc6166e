#include "dem/io/triangle_soup.h"

#include <cerrno>
#include <fstream>
#include <sstream>
#include <system_error>

namespace bergamo::dem
{

std::string surface_file_content(const std::filesystem::path &path)
{
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    reject_surface_file(path, "it is a folder; give the file in it");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file)
    reject_surface_file(path, "it cannot be opened (", std::system_category().message(errno),
                        "); check its name and its permissions");
  std::ostringstream content;
  content << file.rdbuf();
  if (file.bad())
    reject_surface_file(path, "it cannot be read to its end (", std::system_category().message(errno), ")");
  if (content.view().empty())
    reject_surface_file(path, "the file is empty; write it again");
  return std::move(content).str();
}

std::string place_text(const Vec3 &place)
{
  std::ostringstream text;
  text << '(' << place.x() << ", " << place.y() << ", " << place.z() << ')';
  return text.str();
}

} // namespace bergamo::dem
