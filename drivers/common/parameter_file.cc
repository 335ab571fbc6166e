#include "drivers/common/parameter_file.h"

#include "dem/core/error.h"
#include "dem/core/whole_file.h"
#include "drivers/common/nearest_name.h"
#include "drivers/common/number_text.h"
#include "drivers/common/parameter_scan.h"

#include <deal.II/base/parameter_handler.h>

#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace bergamo::driver
{

namespace
{

/// Lets deal.II accept exactly what a binding accepts.
class BindingPattern : public dealii::Patterns::PatternBase
{
public:
  explicit BindingPattern(const ParameterBinding &binding) : binding(binding) {}
  bool match(const std::string &text) const override { return binding.refusal(text).empty(); }
  std::string description(const OutputStyle) const override { return binding.allowed; }
  std::unique_ptr<PatternBase> clone() const override { return std::make_unique<BindingPattern>(binding); }

private:
  ParameterBinding binding;
};

std::vector<std::string> split_path(const std::string &path)
{
  std::vector<std::string> parts;
  std::istringstream stream(path);
  for (std::string part; std::getline(stream, part, '/');)
    parts.push_back(part);
  return parts;
}

std::string usual_of(const ParameterEntry &entry)
{
  const std::string usual = entry.binding.range.usual_text();
  return usual.empty() ? "" : " Usual: " + usual + ".";
}

void declare(dealii::ParameterHandler &handler, const std::vector<ParameterEntry> &entries)
{
  for (const ParameterEntry &entry : entries)
  {
    for (const std::string &section : entry.section)
      handler.enter_subsection(section);
    handler.declare_entry(entry.name, entry.default_text, BindingPattern(entry.binding),
                          entry.doc + ". Allowed: " + entry.binding.allowed + "." + usual_of(entry));
    for (std::size_t i = 0; i < entry.section.size(); ++i)
      handler.leave_subsection();
  }
}

std::string print(const dealii::ParameterHandler &handler, const std::string &title)
{
  std::ostringstream stream;
  handler.print_parameters(stream, static_cast<dealii::ParameterHandler::OutputStyle>(
                                       dealii::ParameterHandler::PRM | dealii::ParameterHandler::KeepDeclarationOrder));
  std::string text = stream.str();
  if (const std::string heading = "# Listing of Parameters\n# ---------------------\n"; text.starts_with(heading))
    text.erase(0, heading.size());
  return "# " + title + "\n" + text;
}

} // namespace

struct ParameterFile::Implementation
{
  std::string title;
  std::vector<ParameterEntry> entries;
  std::map<std::string, std::size_t> index; ///< of an entry, by its path
  std::vector<std::string> paths;
  std::vector<std::string> sections; ///< all section paths, those above others included

  /// Refuses a section that no parameter is in; `place` says where it was read.
  void check_section(const std::string &section, const std::string &place) const
  {
    if (std::find(sections.begin(), sections.end(), section) != sections.end())
      return;
    const std::string near = did_you_mean(section, sections);
    throw ConfigError("unknown section '" + section + "' in " + place + (near.empty() ? remedy() : near));
  }

  /// The entry with this path and value; refuses an unknown name or a value that is not allowed.
  ParameterEntry &checked_entry(const std::string &path, const std::string &value, const std::string &place)
  {
    const auto found = index.find(path);
    if (found == index.end())
      throw ConfigError("unknown parameter '" + path + "' in " + place + suggestion(path));
    ParameterEntry &entry = entries[found->second];
    const std::string refusal = entry.binding.refusal(value);
    if (!refusal.empty())
      throw ConfigError("parameter '" + path + "' in " + place + ": " + refusal +
                        (refusal.ends_with("?") ? " Allowed: " : "; allowed: ") + entry.binding.allowed);
    return entry;
  }

  std::string suggestion(const std::string &path) const
  {
    const std::string name = path.substr(path.rfind('/') + 1);
    const ParameterEntry *nearest = nullptr; // right name, wrong section
    for (const ParameterEntry &entry : entries)
      if (entry.name == name && (!nearest || name_distance(path, entry.path) < name_distance(path, nearest->path)))
        nearest = &entry;
    if (nearest)
      return "; did you mean '" + nearest->path + "'?";
    const std::string near = did_you_mean(path, paths);
    return near.empty() ? remedy() : near;
  }

  static std::string remedy() { return "; --print-parameters lists the known ones"; }
};

ParameterFile::ParameterFile(std::string title) : implementation(std::make_unique<Implementation>())
{
  implementation->title = std::move(title);
}

ParameterFile::~ParameterFile() = default;

void ParameterFile::add(const std::string &section, const std::string &name, std::string &value, const std::string &doc,
                        const std::vector<std::string> &choices)
{
  add_bound(section, name, doc,
            bind_choice(
                choices, [&value, choices](const std::size_t i) { value = choices.at(i); },
                [&value, choices] {
                  return static_cast<std::size_t>(std::find(choices.begin(), choices.end(), value) - choices.begin());
                }));
}

void ParameterFile::add_bound(const std::string &section, const std::string &name, const std::string &doc,
                              ParameterBinding binding)
{
  const std::string path = section + "/" + name;
  if (section.empty() || name.empty() || name.find_first_of("/=#") != std::string::npos)
    throw std::logic_error("parameter '" + path + "' needs a section and a name without '/', '=' and '#'");
  const std::string default_text = binding.text();
  if (!binding.refusal(default_text).empty())
    throw std::logic_error("default of parameter '" + path + "' is not allowed: " + binding.refusal(default_text));
  if (!implementation->index.emplace(path, implementation->entries.size()).second)
    throw std::logic_error("parameter '" + path + "' was added twice");
  implementation->paths.push_back(path);
  std::string above;
  for (const std::string &part : split_path(section))
  {
    above += (above.empty() ? "" : "/") + part;
    auto &sections = implementation->sections;
    if (std::find(sections.begin(), sections.end(), above) == sections.end())
      sections.push_back(above);
  }
  implementation->entries.push_back({split_path(section), name, path, doc, default_text, std::move(binding), ""});
}

void ParameterFile::read(const std::filesystem::path &file)
{
  std::ifstream stream(file);
  std::ostringstream text;
  if (stream)
    text << stream.rdbuf();
  if (!stream || std::filesystem::is_directory(file))
    throw ConfigError("parameter file '" + file.string() + "' cannot be read; check the path and your permissions");
  read_text(text.str(), file.filename().string());
}

void ParameterFile::read_text(const std::string &text, const std::string &source)
{
  // Names, values and structure are checked here, with messages for people; then deal.II reads the same text.
  const std::string plain = plain_parameter_text(text);
  std::map<std::string, int> line_of;
  for (const ParameterStatement &statement : scan_parameters(plain, source))
  {
    const std::string place = source + " line " + std::to_string(statement.line);
    if (statement.kind == ParameterStatement::Kind::section)
      implementation->check_section(statement.path, place);
    else
    {
      implementation->checked_entry(statement.path, statement.value, place);
      if (const auto [earlier, is_new] = line_of.emplace(statement.path, statement.line); !is_new)
        throw ConfigError("parameter '" + statement.path + "' is set twice in " + source + ", in line " +
                          std::to_string(earlier->second) + " and in line " + std::to_string(statement.line) +
                          "; remove one of them");
    }
  }

  dealii::ParameterHandler handler;
  declare(handler, implementation->entries);
  try
  {
    handler.parse_input_from_string(plain);
  }
  catch (const std::exception &) // its text is for programmers; the scan above has explained all known mistakes
  {
    throw ConfigError(source + " cannot be read as a parameter file; compare it with what --print-parameters writes");
  }
  for (const auto &path_and_line : line_of)
  {
    ParameterEntry &entry = implementation->entries[implementation->index.at(path_and_line.first)];
    entry.binding.assign(handler.get(entry.section, entry.name));
    entry.place = source + " line " + std::to_string(path_and_line.second);
  }
}

void ParameterFile::set(const std::string &assignment)
{
  const std::string place = "--set \"" + assignment + "\"";
  const std::size_t equal_sign = assignment.find('=');
  if (equal_sign == std::string::npos)
    throw ConfigError(place + " has no '='; write --set \"Section/Name=value\"");
  std::string path;
  for (const std::string &part : split_path(assignment.substr(0, equal_sign)))
    path += (path.empty() ? "" : "/") + std::string(trimmed(part));
  const std::string value(trimmed(std::string_view(assignment).substr(equal_sign + 1)));
  ParameterEntry &entry = implementation->checked_entry(path, value, place);
  entry.binding.assign(value);
  entry.place = place;
}

std::span<const ParameterEntry> ParameterFile::entries() const
{
  return implementation->entries;
}

std::string ParameterFile::resolved_text() const
{
  dealii::ParameterHandler handler;
  declare(handler, implementation->entries);
  for (const ParameterEntry &entry : implementation->entries)
  {
    const std::string text = entry.binding.text();
    if (const std::string refusal = entry.binding.refusal(text); !refusal.empty())
      throw std::logic_error("parameter '" + entry.path + "' was changed to a value that is not allowed: " + refusal);
    for (const std::string &section : entry.section)
      handler.enter_subsection(section);
    handler.set(entry.name, text);
    for (std::size_t i = 0; i < entry.section.size(); ++i)
      handler.leave_subsection();
  }
  return print(handler, implementation->title);
}

void ParameterFile::write_resolved(const std::filesystem::path &file) const
{
  write_whole_file(file, resolved_text());
}

} // namespace bergamo::driver
