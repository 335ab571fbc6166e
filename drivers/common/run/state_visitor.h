#pragma once

#include "dem/core/archive.h"
#include "dem/core/state.h"
#include "dem/core/types.h"

#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace bergamo::driver
{

/// Goes over the state of a run by name, either to write it to an archive or to read it back: what a driver keeps is
/// listed once for both. Names are HDF5 paths ("loading/step"). What the archive refuses is a RunError.
class StateVisitor
{
public:
  explicit StateVisitor(ArchiveWriter &archive) : writer_(&archive) {}
  explicit StateVisitor(const ArchiveReader &archive) : reader_(&archive) {}

  bool is_reading() const { return reader_ != nullptr; }

  void operator()(const std::string &name, double &value);
  void operator()(const std::string &name, std::int64_t &value);
  void operator()(const std::string &name, Vec3 &value);
  void operator()(const std::string &name, std::vector<double> &values);
  void operator()(const std::string &name, std::vector<Vec3> &values);
  void operator()(const std::string &name, std::span<double> values); ///< of a length that is known

  /// An object that names its state itself, see dem/core/state.h.
  template <class T>
  requires requires(T &object, StateReader &reader) { T::visit_state(object, reader); }
  void operator()(const std::string &name, T &object)
  {
    const auto go_over = [&](auto inner) { T::visit_state(object, inner); };
    if (reader_)
      go_over(StateReader(*reader_, name));
    else
      go_over(StateWriter(*writer_, name));
  }

  template <class Enum>
  requires std::is_enum_v<Enum>
  void operator()(const std::string &name, Enum &value)
  {
    auto number = static_cast<std::int64_t>(value);
    (*this)(name, number);
    value = static_cast<Enum>(number);
  }

  /// The archive itself, for models that write or read themselves; nothing in the other case.
  /// @{
  ArchiveWriter *writer() const { return writer_; }
  const ArchiveReader *reader() const { return reader_; }
  /// @}

private:
  ArchiveWriter *writer_ = nullptr;
  const ArchiveReader *reader_ = nullptr;
};

} // namespace bergamo::driver
