#pragma once

#include "dem/core/error.h"
#include "dem/core/types.h"

#include <pybind11/numpy.h>

#include <cstdint>
#include <string>
#include <vector>

/// Arrays of NumPy to and from vectors, by copies.
namespace bergamo::python
{

using Doubles = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;
using Integers = pybind11::array_t<std::int64_t, pybind11::array::c_style | pybind11::array::forcecast>;

/// Rows of `columns` numbers. Throws ConfigError, with the name, for another shape.
inline void require_rows(const pybind11::array &values, const pybind11::ssize_t columns, const std::string &name)
{
  if (values.ndim() == 2 && values.shape(1) == columns)
    return;
  std::string shape;
  for (pybind11::ssize_t k = 0; k < values.ndim(); ++k)
    shape += (k > 0 ? ", " : "") + std::to_string(values.shape(k));
  throw ConfigError(name + " has the shape (" + shape + "): it must be (n, " + std::to_string(columns) + ')');
}

/// Structs of doubles from rows, and back; Row is as long as so many doubles. @{
template <class Row>
std::vector<Row> rows_of(const Doubles &values, const std::string &name)
{
  require_rows(values, sizeof(Row) / sizeof(double), name);
  const auto *first = reinterpret_cast<const Row *>(values.data());
  return {first, first + values.shape(0)};
}

template <class Row>
pybind11::array_t<double> array_of(const std::vector<Row> &rows)
{
  constexpr auto columns = static_cast<pybind11::ssize_t>(sizeof(Row) / sizeof(double));
  const auto n = static_cast<pybind11::ssize_t>(rows.size());
  const auto *numbers = reinterpret_cast<const double *>(rows.data());
  if constexpr (columns == 1)
    return pybind11::array_t<double>(n, numbers);
  else
    return pybind11::array_t<double>({n, columns}, numbers);
}
/// @}

inline pybind11::array_t<double> array_of(const Vec3 &vector)
{
  return pybind11::array_t<double>(3, vector.data());
}

inline pybind11::array_t<std::int64_t> array_of(const std::vector<std::int64_t> &numbers)
{
  return pybind11::array_t<std::int64_t>(static_cast<pybind11::ssize_t>(numbers.size()), numbers.data());
}

/// Throws ConfigError, with the name, for other than three numbers.
inline Vec3 vector_of(const pybind11::handle &object, const std::string &name)
{
  const auto values = Doubles::ensure(object);
  if (!values || values.size() != 3)
  {
    PyErr_Clear();
    throw ConfigError(name + " is " + std::string(pybind11::repr(object)) + ": it must be three numbers");
  }
  return Vec3(values.data()[0], values.data()[1], values.data()[2]);
}

} // namespace bergamo::python
