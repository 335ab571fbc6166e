#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace bergamo::benchmark
{

/// A folder of its own among the temporary files, which goes with the object.
class TemporaryFolder
{
public:
  /// Throws RunError where it cannot be made. @param name begins the folder's name
  explicit TemporaryFolder(const std::string &name);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder &) = delete;
  TemporaryFolder &operator=(const TemporaryFolder &) = delete;

  const std::filesystem::path &path() const { return folder; }

private:
  std::filesystem::path folder;
};

/// The path of a program by its name or path; nothing if there is none.
std::optional<std::filesystem::path> find_program(const std::string &program);

/// Between quotes, as a word of a shell command.
std::string quoted(const std::filesystem::path &path);

/// Runs a program in a folder, with one OpenMP thread, and waits for it. @param arguments as a shell reads them
/// @return all that it printed. Throws RunError with its last words if it cannot be started or fails.
std::string output_of(const std::filesystem::path &program, const std::string &arguments,
                      const std::filesystem::path &folder);

/// The number after the last `key` in what a program printed. Throws RunError if there is no such key.
double number_after(const std::string &text, const std::string &key);

/// The text between the `n`th key (from 0) and the next one. Throws RunError as number_after() does.
std::string part_after(const std::string &text, const std::string &key, int n);

} // namespace bergamo::benchmark
