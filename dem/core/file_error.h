#pragma once

#include <filesystem>
#include <string>

namespace bergamo
{

/// "cannot write PATH: No space left on device; free some space …", with the remedy, for an error number of the system
/// (errno). @param action what cannot be done with the path, such as "write"
std::string file_error(const std::string &action, const std::filesystem::path &path, int error_number);

} // namespace bergamo
