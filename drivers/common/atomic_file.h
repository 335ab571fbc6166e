#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace bergamo::driver
{

/// Writes a whole file such that a reader sees the old one or the new one, even if the machine stops in between:
/// written aside as `path`.part, brought to disk, renamed. Throws RunError with the path, the system's reason and the
/// remedy; the old file is then as it was, and no part is left behind.
void write_atomically(const std::filesystem::path &path, std::string_view text);

/// The same for a format with a writer of its own: `write` gets the path to write to. Whatever it throws passes
/// through after the part has been removed.
void write_atomically(const std::filesystem::path &path,
                      const std::function<void(const std::filesystem::path &part)> &write);

/// "cannot write 'path': No space left on device; free some space …" for an error number of the system (errno).
std::string file_error(const std::string &action, const std::filesystem::path &path, int error_number);

} // namespace bergamo::driver
