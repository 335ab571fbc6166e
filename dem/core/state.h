#pragma once

#include "dem/core/archive.h"
#include "dem/core/error.h"
#include "dem/core/types.h"

#include <concepts>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// Visiting the state of an object: the object names its fields once, and what comes by writes them into an archive,
/// reads them from one, or hashes them. A class takes part by a static template
///
///   template <class Self, class Visit> static void visit_state(Self &self, Visit &visit)
///   {
///     visit("time", self.time);        // numbers, vectors of numbers or of plain structs of doubles, other such
///     objects if constexpr (Visit::is_reading) // what follows from the state is made anew
///       ...
///   }
namespace bergamo
{
namespace detail
{

struct AnyVisit
{
  static constexpr bool is_reading = false;
  template <class T>
  void operator()(const char *, T &&)
  {
  }
};

template <class T>
concept HasState = requires(T &object, AnyVisit &visit)
{
  std::remove_const_t<T>::visit_state(object, visit);
};

template <class T>
std::span<const double> as_doubles(const T *values, const std::size_t n)
{
  return {reinterpret_cast<const double *>(values), n * (sizeof(T) / sizeof(double))};
}

} // namespace detail

/// Writes the state below a group of an archive.
class StateWriter
{
public:
  static constexpr bool is_reading = false;

  StateWriter(ArchiveWriter &archive, std::string group) : archive(archive), group(std::move(group)) {}

  template <class T>
  [[gnu::cold]] void operator()(const char *name, const T &value)
  {
    const std::string path = group + '/' + name;
    if constexpr (detail::HasState<const T>)
    {
      StateWriter inner(archive, path);
      T::visit_state(value, inner);
    }
    else if constexpr (std::integral<T>)
      archive.write(path, static_cast<std::int64_t>(value));
    else if constexpr (std::same_as<T, double>)
      archive.write(path, value);
    else
      archive.write(path, detail::as_doubles(&value, 1));
  }

  template <class T>
  [[gnu::cold]] void operator()(const char *name, const std::vector<T> &values)
  {
    const std::string path = group + '/' + name;
    if constexpr (std::integral<T>)
      archive.write(path, std::vector<std::int64_t>(values.begin(), values.end()));
    else if constexpr (detail::HasState<const T>)
    {
      archive.write(path + "/size", static_cast<std::int64_t>(values.size()));
      StateWriter inner(archive, path);
      for (std::size_t k = 0; k < values.size(); ++k)
        inner(std::to_string(k).c_str(), values[k]);
    }
    else if constexpr (std::is_empty_v<T>)
      archive.write(path, static_cast<std::int64_t>(values.size()));
    else if constexpr (sizeof(T) % sizeof(double) == 0 && alignof(T) >= alignof(double))
      archive.write(path, detail::as_doubles(values.data(), values.size()));
    else
    {
      static_assert(sizeof(T) % sizeof(float) == 0);
      const auto *numbers = reinterpret_cast<const float *>(values.data());
      archive.write(path, std::vector<double>(numbers, numbers + values.size() * sizeof(T) / sizeof(float)));
    }
  }

private:
  ArchiveWriter &archive;
  std::string group;
};

/// Reads what a StateWriter wrote. Throws RunError where the archive does not hold it.
class StateReader
{
public:
  static constexpr bool is_reading = true;

  StateReader(const ArchiveReader &archive, std::string group) : archive(archive), group(std::move(group)) {}

  template <class T>
  [[gnu::cold]] void operator()(const char *name, T &value)
  {
    const std::string path = group + '/' + name;
    if constexpr (detail::HasState<T>)
    {
      StateReader inner(archive, path);
      T::visit_state(value, inner);
    }
    else if constexpr (std::integral<T>)
      value = static_cast<T>(archive.read_integer(path));
    else if constexpr (std::same_as<T, double>)
      value = archive.read_double(path);
    else
      archive.read_into(path, std::span<double>(reinterpret_cast<double *>(&value), sizeof(T) / sizeof(double)));
  }

  template <class T>
  [[gnu::cold]] void operator()(const char *name, std::vector<T> &values)
  {
    const std::string path = group + '/' + name;
    if constexpr (std::integral<T>)
    {
      const std::vector<std::int64_t> numbers = archive.read_integers(path);
      values.assign(numbers.begin(), numbers.end());
    }
    else if constexpr (detail::HasState<T>)
    {
      values.resize(archive.read_integer(path + "/size"));
      StateReader inner(archive, path);
      for (std::size_t k = 0; k < values.size(); ++k)
        inner(std::to_string(k).c_str(), values[k]);
    }
    else if constexpr (std::is_empty_v<T>)
      values.resize(archive.read_integer(path));
    else if constexpr (sizeof(T) % sizeof(double) == 0 && alignof(T) >= alignof(double))
      take<double>(path, values);
    else
      take<float>(path, values);
  }

private:
  template <class Number, class T>
  void take(const std::string &path, std::vector<T> &values) const
  {
    constexpr std::size_t n = sizeof(T) / sizeof(Number);
    const std::vector<double> numbers = archive.read_doubles(path);
    if (numbers.size() % n != 0)
      throw RunError("the snapshot's array " + path + " has " + std::to_string(numbers.size()) +
                     " numbers, not a multiple of " + std::to_string(n) +
                     ": it was written by another version; start the run anew");
    values.resize(numbers.size() / n);
    auto *target = reinterpret_cast<Number *>(values.data());
    for (std::size_t k = 0; k < numbers.size(); ++k)
      target[k] = static_cast<Number>(numbers[k]);
  }

  const ArchiveReader &archive;
  std::string group;
};

/// FNV-1a over the bytes of the state: equal states have equal hashes, on any number of threads and after any restart.
class StateHash
{
public:
  static constexpr bool is_reading = false;

  template <class T>
  void operator()(const char *, const T &value)
  {
    if constexpr (detail::HasState<const T>)
      T::visit_state(value, *this);
    else
      add(&value, sizeof(T));
  }

  template <class T>
  [[gnu::cold]] void operator()(const char *name, const std::vector<T> &values)
  {
    if constexpr (detail::HasState<const T>)
      for (const T &value : values)
        (*this)(name, value);
    else if constexpr (!std::is_empty_v<T>)
      add(values.data(), values.size() * sizeof(T));
  }

  std::uint64_t value() const { return hash; }

private:
  [[gnu::noinline]] void add(const void *data, const std::size_t n_bytes)
  {
    const auto *bytes = static_cast<const unsigned char *>(data);
    for (std::size_t i = 0; i < n_bytes; ++i)
      hash = (hash ^ bytes[i]) * 1099511628211u;
  }

  std::uint64_t hash = 14695981039346656037u;
};

} // namespace bergamo
