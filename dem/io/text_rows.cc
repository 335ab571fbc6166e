#include "dem/io/text_rows.h"

#include "dem/core/file_error.h"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <utility>

namespace bergamo::dem
{
namespace
{

constexpr std::string_view blanks = " \t\r";

std::string_view trimmed(std::string_view text)
{
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos)
    return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string content_of(const std::filesystem::path &path)
{
  if (std::filesystem::is_directory(path))
    reject("file ", path.string(), ": it is a folder; name a file");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::string content(std::istreambuf_iterator<char>(file), {});
  if (!file.is_open() || file.bad())
    throw ConfigError(file_error("read", path, errno));
  if (content.empty())
    reject("file ", path.string(), ": it is empty; write it again");
  return content;
}

/// The whole word as a number; false for anything else.
template <class Number>
bool parse(const std::string_view word, Number &number)
{
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc() && end == word.data() + word.size();
}

} // namespace

TextRows::TextRows(std::filesystem::path path, const char separator)
    : path_(std::move(path)), separator_(separator), content_(content_of(path_))
{
}

bool TextRows::next()
{
  while (begin_ < content_.size())
  {
    const std::size_t end = std::min(content_.find('\n', begin_), content_.size());
    text_ = trimmed(std::string_view(content_).substr(begin_, end - begin_));
    begin_ = end + 1;
    ++line_;
    if (text_.empty() || text_.front() == '#')
      continue;
    split();
    if (!names_.empty() && words_.size() != names_.size())
      refuse("it has ", words_.size(), " words under ", names_.size(), " columns; give one each");
    return true;
  }
  return false;
}

void TextRows::split()
{
  words_.clear();
  for (std::size_t begin = 0; begin <= text_.size();)
  {
    std::size_t end = separator_ == ',' ? text_.find(',', begin) : text_.find_first_of(blanks, begin);
    end = std::min(end, text_.size());
    if (separator_ == ',' || end > begin)
      words_.push_back(trimmed(text_.substr(begin, end - begin)));
    begin = end + 1;
  }
}

std::string TextRows::name_of(const std::size_t column) const
{
  return column < names_.size() ? names_[column] : "without a name";
}

double TextRows::number(const std::size_t column) const
{
  double value = 0.;
  if (!parse(words_[column], value) || !std::isfinite(value))
    refuse_word(column, "that is no finite number");
  return value;
}

std::int64_t TextRows::integer(const std::size_t column) const
{
  std::int64_t value = 0;
  if (!parse(words_[column], value))
    refuse_word(column, "that is no whole number");
  return value;
}

} // namespace bergamo::dem
