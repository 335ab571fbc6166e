#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace bergamo
{

/// Lists of entries, one a row, without gaps in one array (compressed sparse rows).
template <class Entry>
class Rows
{
public:
  Rows() = default;

  /// Sorts entries into rows by counting; in a row they keep their order.
  /// @param each each(put) calls put(row, entry) for every entry, row in [0, n_rows); it is called twice and has to say
  /// the same both times
  template <class Each>
  Rows(const std::size_t n_rows, const Each &each) : begin_(n_rows + 1, 0)
  {
    each([&](const std::size_t row, const Entry &) { ++begin_[row + 1]; });
    for (std::size_t row = 0; row < n_rows; ++row)
      begin_[row + 1] += begin_[row];
    entries_.resize(begin_.back());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    each([&](const std::size_t row, Entry entry) { entries_[next[row]++] = std::move(entry); });
  }

  std::size_t size() const { return begin_.size() - 1; }
  std::span<const Entry> operator[](const std::size_t row) const
  {
    return {entries_.data() + begin_[row], begin_[row + 1] - begin_[row]};
  }

private:
  std::vector<std::size_t> begin_{0}; // row r: entries_[begin_[r]] .. entries_[begin_[r + 1]]
  std::vector<Entry> entries_;
};

} // namespace bergamo
