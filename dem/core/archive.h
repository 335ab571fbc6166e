#pragma once

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace bergamo
{

// Archives: named arrays, numbers and texts in one HDF5 file, kept bit for bit. Names are HDF5 paths
// ("grains/position"), the groups on the way are made by themselves. Any HDF5 tool reads an archive.
//
// The first 512 bytes, the user block that HDF5 leaves to its users, hold a readable seal: format version, length and
// a 64 bit checksum of all that follows. A reader checks it before HDF5 sees the file, so a damaged file is an error
// and never other data. Besides, every array carries HDF5's Fletcher32 for other readers.
//
// HDF5 is not thread-safe: use archives from one thread at a time.

/// Collects a file in memory and writes it whole or not at all.
class ArchiveWriter
{
public:
  /// `kind` says what the archive holds, e.g. "grain snapshot"; the reader must ask for the same.
  /// Throws RunError when the folder cannot be written to.
  ArchiveWriter(const std::filesystem::path &path, const std::string &kind);
  ~ArchiveWriter(); ///< drops everything that was not committed
  ArchiveWriter(const ArchiveWriter &) = delete;
  ArchiveWriter &operator=(const ArchiveWriter &) = delete;

  /// Each name may be written once (RunError otherwise).
  void write(const std::string &name, std::span<const double> values);
  void write(const std::string &name, std::span<const std::int64_t> values);
  void write(const std::string &name, double value);
  void write(const std::string &name, const std::string &text);

  template <std::integral Integer>
  void write(const std::string &name, const Integer value)
  {
    write_integer(name, static_cast<std::int64_t>(value));
  }

  /// Puts the file in place; a file of that name from before stays whole until then. Nothing may follow.
  /// Throws RunError (disk full, ...) that names the path, the system's reason and the remedy.
  void commit() { finish()(); }

  /// The same in two parts: what is left for commit() once HDF5 has done its own. It may be called, once, by another
  /// thread and when the writer is gone, which then drops nothing; without a call the partial file goes with the last
  /// copy of it.
  std::function<void()> finish();

private:
  struct State;
  std::shared_ptr<State> state_;

  void write_integer(const std::string &name, std::int64_t value);
};

/// Reads an archive. A file that is missing, foreign, of another kind, from a newer version or damaged, and a name that
/// it lacks or that holds something else, is a RunError that names the file, the thing and the remedy.
class ArchiveReader
{
public:
  ArchiveReader(const std::filesystem::path &path, const std::string &kind);
  ~ArchiveReader();
  ArchiveReader(const ArchiveReader &) = delete;
  ArchiveReader &operator=(const ArchiveReader &) = delete;

  /// Whether the archive holds an array, number or text of that name.
  bool has(const std::string &name) const;

  std::vector<double> read_doubles(const std::string &name) const;
  std::vector<std::int64_t> read_integers(const std::string &name) const;
  double read_double(const std::string &name) const;
  std::int64_t read_integer(const std::string &name) const;
  std::string read_text(const std::string &name) const;

  /// Reads an array of exactly the size of `values`.
  void read_into(const std::string &name, std::span<double> values) const;
  void read_into(const std::string &name, std::span<std::int64_t> values) const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace bergamo
