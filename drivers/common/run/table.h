#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace bergamo::driver
{

/// A column of a table: its name, which ends with its unit ("stress_1_Pa"), and where its numbers come from.
struct Column
{
  std::string name;
  std::function<double()> value;
};

/// What is written of a sample: names, units and values side by side.
class Table
{
public:
  Table(std::vector<Column> columns) : columns_(std::move(columns)) {}

  const std::vector<Column> &columns() const { return columns_; }

  /// Puts further columns to the right.
  void add(const std::vector<Column> &columns) { columns_.insert(columns_.end(), columns.begin(), columns.end()); }

  std::vector<std::string> names() const
  {
    std::vector<std::string> names;
    for (const Column &column : columns_)
      names.push_back(column.name);
    return names;
  }

  /// The present value of every column.
  std::vector<double> row() const
  {
    std::vector<double> row;
    for (const Column &column : columns_)
      row.push_back(column.value());
    return row;
  }

private:
  std::vector<Column> columns_;
};

} // namespace bergamo::driver
