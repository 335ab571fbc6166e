#include "drivers/common/csv_table.h"

#include "dem/core/error.h"
#include "dem/core/whole_file.h"
#include "drivers/common/nearest_name.h"
#include "drivers/common/number_text.h"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace bergamo::driver
{

namespace
{

std::vector<std::string> fields_of(std::string line)
{
  line.erase(std::remove(line.begin(), line.end(), '\r'), line.end());
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');)
    fields.emplace_back(trimmed(field));
  if (line.ends_with(','))
    fields.emplace_back();
  return fields;
}

/// Where each wanted column stands in the header.
std::vector<std::size_t> places_of(const std::vector<std::string> &wanted, const std::vector<std::string> &header,
                                   const std::filesystem::path &path)
{
  std::vector<std::size_t> places;
  for (const std::string &name : wanted)
  {
    const auto found = std::find(header.begin(), header.end(), name);
    if (found == header.end())
      throw ConfigError("'" + path.string() + "' has no column '" + name + "'" + did_you_mean(name, header) +
                        "; its header must name it");
    places.push_back(static_cast<std::size_t>(found - header.begin()));
  }
  return places;
}

} // namespace

CsvTable read_csv(const std::filesystem::path &path, const std::vector<std::string> &wanted)
{
  std::ifstream file(path);
  if (!file || std::filesystem::is_directory(path))
    throw ConfigError("'" + path.string() + "' cannot be read; check the path and your permissions");
  std::string line;
  if (!std::getline(file, line) || trimmed(line).empty())
    throw ConfigError("'" + path.string() + "' is empty; it must begin with the names of its columns");
  const std::vector<std::string> header = fields_of(line);
  const std::vector<std::size_t> places = places_of(wanted, header, path);

  CsvTable table{path, {}, 0};
  for (const std::string &name : wanted)
    table.columns[name];
  for (int number = 2; std::getline(file, line) && !file.eof(); ++number)
  {
    if (trimmed(line).empty())
      continue;
    const std::vector<std::string> fields = fields_of(line);
    const std::string place = std::string("'") + path.string() + "' line " + std::to_string(number);
    if (fields.size() != header.size())
      throw ConfigError(place + " has " + std::to_string(fields.size()) + " values, not " +
                        std::to_string(header.size()) + " as the header; mend or remove the line");
    for (std::size_t i = 0; i < wanted.size(); ++i)
    {
      const auto value = parse_number(fields[places[i]]);
      if (!value)
        throw ConfigError(place + ": " + wanted[i] + " is '" + fields[places[i]] +
                          "'; it must be a finite number; mend or remove the line");
      table.columns[wanted[i]].push_back(*value);
    }
    ++table.n_rows;
  }
  return table;
}

void write_csv(const std::filesystem::path &path, const std::vector<std::string> &names,
               const std::vector<std::vector<double>> &rows)
{
  std::string text;
  const auto add = [&](const std::string &word, const bool is_last) { text.append(word).append(is_last ? "\n" : ","); };
  for (std::size_t k = 0; k < names.size(); ++k)
    add(names[k], k + 1 == names.size());
  for (const std::vector<double> &row : rows)
    for (std::size_t k = 0; k < row.size(); ++k)
      add(exact_text(row[k]), k + 1 == row.size());
  write_whole_file(path, text);
}

std::vector<std::string> names_of(const FigureList &figures)
{
  std::vector<std::string> names;
  for (const auto &[name, value] : figures)
    names.push_back(name);
  return names;
}

std::vector<double> values_of(const FigureList &figures)
{
  std::vector<double> values;
  for (const auto &[name, value] : figures)
    values.push_back(*value);
  return values;
}

void read_figures(const std::filesystem::path &path, const FigureList &figures)
{
  const CsvTable table = read_csv(path, names_of(figures));
  if (table.n_rows == 0)
    throw ConfigError("'" + path.string() + "' has no row of numbers; remove it, or begin a new run");
  for (const auto &[name, value] : figures)
    *value = table[name].front();
}

} // namespace bergamo::driver
