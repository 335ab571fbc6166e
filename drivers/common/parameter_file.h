#pragma once

#include "drivers/common/parameter_entry.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <type_traits>

namespace bergamo::driver
{

/// The parameters of a job: plain variables of the driver, bound to names in sections, read from a .prm file in the
/// syntax of deal.II's ParameterHandler ("subsection Grains", "set friction = 0.5", "end", "# comment").
///
/// A section is a path such as "Grains" or "Grains/Shape". Documentation texts state the SI unit in brackets, e.g.
/// "density of the grains [kg/m3]". The value that a variable has when it is added is the parameter's default, and
/// must be an allowed one. Variables must outlive this object.
///
/// Every mistake of the user throws ConfigError, which names the parameter, the place, the value, what is allowed and,
/// for a name, the nearest known one. After such an error the variables may have been changed in part.
class ParameterFile
{
public:
  explicit ParameterFile(std::string title);
  ~ParameterFile();
  ParameterFile(const ParameterFile &) = delete;
  ParameterFile &operator=(const ParameterFile &) = delete;

  /// A finite number within the range.
  void add(const std::string &section, const std::string &name, double &value, const std::string &doc,
           const Range &range = {})
  {
    add_bound(section, name, doc, bind_number(value, range));
  }

  /// A whole number within the range and the type's own limits.
  template <std::integral Integer>
  requires(!std::same_as<Integer, bool>) void add(const std::string &section, const std::string &name, Integer &value,
                                                  const std::string &doc, const Range &range = {})
  {
    add_bound(section, name, doc, bind_integer(value, range));
  }

  /// As many numbers as the span has, each within the range; "1, 0, 0". For an Eigen vector: {v.data(), 3}.
  void add(const std::string &section, const std::string &name, std::span<double> values, const std::string &doc,
           const Range &range = {})
  {
    add_bound(section, name, doc, bind_numbers(values, range));
  }

  /// Any number of numbers, each within the range; "0.1, 0.2".
  void add(const std::string &section, const std::string &name, std::vector<double> &values, const std::string &doc,
           const Range &range = {})
  {
    add_bound(section, name, doc, bind_number_list(values, range));
  }

  void add(const std::string &section, const std::string &name, bool &value, const std::string &doc)
  {
    add_bound(section, name, doc, bind_truth(value));
  }

  /// One line of text without '#'.
  void add(const std::string &section, const std::string &name, std::string &value, const std::string &doc)
  {
    add_bound(section, name, doc, bind_text(value));
  }

  /// One of the choices.
  void add(const std::string &section, const std::string &name, std::string &value, const std::string &doc,
           const std::vector<std::string> &choices);

  /// One of the named values of an enumeration.
  template <class Enum>
  requires std::is_enum_v<Enum>
  void add(const std::string &section, const std::string &name, Enum &value, const std::string &doc,
           const std::vector<std::pair<std::string, Enum>> &choices)
  {
    std::vector<std::string> names;
    for (const auto &choice : choices)
      names.push_back(choice.first);
    add_bound(section, name, doc,
              bind_choice(
                  names, [&value, choices](const std::size_t i) { value = choices.at(i).second; },
                  [&value, choices]
                  {
                    return static_cast<std::size_t>(std::find_if(choices.begin(), choices.end(),
                                                                 [&](const auto &choice)
                                                                 { return choice.second == value; }) -
                                                    choices.begin());
                  }));
  }

  /// Any other kind of value.
  void add_bound(const std::string &section, const std::string &name, const std::string &doc, ParameterBinding binding);

  /// Reads a file; parameters that it does not name keep their values.
  void read(const std::filesystem::path &file);

  /// Reads the text of a file; `source` names it in messages.
  void read_text(const std::string &text, const std::string &source);

  /// Takes one "Section/Name=value" of the command line.
  void set(const std::string &assignment);

  /// All parameters in the order in which they were added.
  std::span<const ParameterEntry> entries() const;

  /// A commented parameter file with the present values, at first the defaults; it reads back as the very same values.
  std::string resolved_text() const;

  /// Writes resolved_text() atomically. Throws RunError when the file cannot be written.
  void write_resolved(const std::filesystem::path &file) const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation;
};

} // namespace bergamo::driver
