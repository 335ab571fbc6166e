#pragma once

#include "dem/core/error.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace bergamo::dem
{

/// The lines of a file of text, one after the other, as words; knows where each of them stands. Blank lines and such
/// that begin with # are passed over. Own code: a reader that rounds correctly and names line and column of tables with
/// commas and with blanks is less than the glue about one.
class TextRows
{
public:
  /// Reads the file. @param separator between words: a comma, or a blank for any number of blanks and tabs. Throws
  /// ConfigError for one that is missing, not to be read, or empty.
  TextRows(std::filesystem::path path, char separator);

  /// Goes on to the next line. @return false at the end
  bool next();

  const std::vector<std::string_view> &words() const { return words_; }
  std::string_view text() const { return text_; }
  std::size_t line() const { return line_; } ///< from 1

  /// A word as a finite number. Throws ConfigError, with file, line and column, for one that is none.
  double number(std::size_t column) const;

  /// A word as a whole number, likewise.
  std::int64_t integer(std::size_t column) const;

  /// Throws ConfigError "file PATH, line 3: ..." with the parts as << writes them.
  template <class... Parts>
  [[noreturn]] void refuse(const Parts &...parts) const
  {
    reject("file ", path_.string(), ", line ", line_, ": ", parts...);
  }
  template <class... Parts>
  [[noreturn]] void refuse_word(const std::size_t column, const Parts &...parts) const
  {
    refuse("column ", column + 1, " (", name_of(column), ") is '", words_[column], "': ", parts...);
  }

  /// The names that messages give to the columns, and how many words each line has from now on.
  void name_columns(std::vector<std::string> names) { names_ = std::move(names); }
  const std::vector<std::string> &names() const { return names_; }

  const std::filesystem::path &path() const { return path_; }

private:
  std::string name_of(std::size_t column) const;
  void split();

  std::filesystem::path path_;
  char separator_;
  std::string content_;
  std::size_t begin_ = 0, line_ = 0;
  std::string_view text_;
  std::vector<std::string_view> words_;
  std::vector<std::string> names_;
};

} // namespace bergamo::dem
