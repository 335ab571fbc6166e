#include "drivers/common/folder_probe.h"

#include <unistd.h>

#include <cstdlib>
#include <string>

namespace bergamo::driver
{

bool can_make_folder_in(const std::filesystem::path &parent)
{
  std::string probe = (parent / ".writable_XXXXXX").string();
  return ::mkdtemp(probe.data()) != nullptr && ::rmdir(probe.c_str()) == 0;
}

} // namespace bergamo::driver
