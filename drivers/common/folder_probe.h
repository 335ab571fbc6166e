#pragma once

#include <filesystem>

namespace bergamo::driver
{

/// Whether a folder can be made within another one; if not, errno says why. Only trying tells: access() says yes to
/// root on file systems where nothing can be made.
bool can_make_folder_in(const std::filesystem::path &parent);

} // namespace bergamo::driver
