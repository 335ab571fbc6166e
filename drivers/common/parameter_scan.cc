#include "drivers/common/parameter_scan.h"

#include "dem/core/error.h"
#include "drivers/common/nearest_name.h"
#include "drivers/common/number_text.h"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace bergamo::driver
{

namespace
{

struct OpenSection
{
  std::string name;
  int line;
};

std::string path_of(const std::vector<OpenSection> &open, const std::string &name)
{
  std::string path;
  for (const OpenSection &section : open)
    path += section.name + "/";
  return path + name;
}

/// The statement's first word in lower case, and the rest.
std::pair<std::string, std::string> first_word(const std::string &statement)
{
  const std::size_t end = std::min(statement.find(' '), statement.size());
  std::string word = statement.substr(0, end);
  std::transform(word.begin(), word.end(), word.begin(), [](const unsigned char c) { return std::tolower(c); });
  return {word, std::string(trimmed(std::string_view(statement).substr(end)))};
}

/// A logical line without its comment and with blanks for tabs.
std::string bare(std::string line)
{
  line.erase(std::min(line.find('#'), line.size()));
  std::replace(line.begin(), line.end(), '\t', ' ');
  return std::string(trimmed(line));
}

class Scanner
{
public:
  explicit Scanner(const std::string &source) : source(source) {}

  void take(const std::string &statement, const int line)
  {
    const auto [word, rest] = first_word(statement);
    const std::string place = source + " line " + std::to_string(line);
    if (word == "set" && rest.find('=') != std::string::npos)
    {
      const std::size_t equal_sign = rest.find('=');
      const std::string name(trimmed(std::string_view(rest).substr(0, equal_sign)));
      const std::string value(trimmed(std::string_view(rest).substr(equal_sign + 1)));
      statements.push_back({ParameterStatement::Kind::value, path_of(open, name), value, line});
    }
    else if (word == "set")
      throw ConfigError(place + ": '" + statement + "' has no '='; write 'set name = value'");
    else if (word == "subsection" && !rest.empty())
    {
      statements.push_back({ParameterStatement::Kind::section, path_of(open, rest), "", line});
      open.push_back({rest, line});
    }
    else if (word == "end" && rest.empty())
    {
      if (open.empty())
        throw ConfigError(place + ": 'end' without a 'subsection' before it; remove it");
      open.pop_back();
    }
    else if (word == "include")
      throw ConfigError(place + ": 'include' is not supported; copy the parameters into this file");
    else
      throw ConfigError(place + ": '" + statement + "' is no statement" + statement_meant(word) +
                        "; allowed: 'subsection NAME', 'set NAME = VALUE', 'end', '# comment'");
  }

  std::vector<ParameterStatement> result() const
  {
    if (!open.empty())
      throw ConfigError(source + " line " + std::to_string(open.back().line) + ": subsection '" + open.back().name +
                        "' has no 'end'; add one");
    return statements;
  }

private:
  static std::string statement_meant(const std::string &word)
  {
    const std::vector<std::string> known = {"subsection", "set", "end"};
    return word == "subsection" || word == "end" ? "" : did_you_mean(word, known);
  }

  std::string source;
  std::vector<OpenSection> open;
  std::vector<ParameterStatement> statements;
};

} // namespace

std::string plain_parameter_text(const std::string &text)
{
  std::string plain = text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text;
  plain.erase(std::remove(plain.begin(), plain.end(), '\r'), plain.end());
  return plain;
}

std::vector<ParameterStatement> scan_parameters(const std::string &text, const std::string &source)
{
  Scanner scanner(source);
  std::istringstream stream(text);
  std::string logical_line;
  int line = 0, first_line = 1;
  const auto take = [&]
  {
    if (const std::string statement = bare(logical_line); !statement.empty())
      scanner.take(statement, first_line);
    logical_line.clear();
  };
  for (std::string physical_line; std::getline(stream, physical_line);)
  {
    ++line;
    if (logical_line.empty())
      first_line = line;
    logical_line += trimmed(physical_line);
    if (logical_line.ends_with('\\')) // goes on in the next line
      logical_line.pop_back();
    else
      take();
  }
  take();
  return scanner.result();
}

} // namespace bergamo::driver
