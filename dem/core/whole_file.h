#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

namespace bergamo
{

/// A file that appears whole or not at all: bytes go to `path` + ".partial" and take the name `path` on commit().
/// Until then an older file at `path` stays as it is; without commit() the destructor removes the partial file.
/// Whatever goes wrong (no such folder, no right to write, disk full) is a RunError that names the path, the
/// system's reason and the remedy.
class WholeFile
{
public:
  /// Opens the partial file at once, so that a folder that cannot be written to is known before any work.
  explicit WholeFile(std::filesystem::path path);
  ~WholeFile();
  WholeFile(const WholeFile &) = delete;
  WholeFile &operator=(const WholeFile &) = delete;

  void write(const void *bytes, std::size_t size);
  void write(std::string_view text) { write(text.data(), text.size()); }

  /// Brings the bytes to the disk and gives the file its name.
  void commit();

  const std::filesystem::path &path() const { return path_; }

private:
  [[noreturn]] void fail(int reason) const;

  std::filesystem::path path_;
  std::filesystem::path partial_;
  int descriptor_ = -1;
};

/// Writes a whole file at once; errors as above.
void write_whole_file(const std::filesystem::path &path, std::string_view text);

} // namespace bergamo
