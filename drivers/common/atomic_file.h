#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace bergamo::driver
{

/// Writes a whole file such that a reader sees the old one or the new one, even if the machine stops in between:
/// written aside as `path`.partial, brought to disk, renamed. Throws RunError with the path, the system's reason and
/// the remedy; the old file is then as it was, and no part is left behind.
void write_atomically(const std::filesystem::path &path, std::string_view text);

/// "cannot write 'path': No space left on device; free some space …" for an error number of the system (errno).
std::string file_error(const std::string &action, const std::filesystem::path &path, int error_number);

} // namespace bergamo::driver
