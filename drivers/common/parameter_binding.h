#pragma once

#include "drivers/common/parameter_range.h"

#include <concepts>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace bergamo::driver
{

/// How one variable of a driver is read from a text and written as one.
struct ParameterBinding
{
  std::function<std::string(const std::string &)> refusal; ///< why a text is no value of it; empty if it is one
  std::function<void(const std::string &)> assign;         ///< takes a text without refusal
  std::function<std::string()> text;                       ///< the present value, such that assign gives the same back
  std::string allowed;                                     ///< in words, e.g. "a number >= 0"
  Range range = {};                                        ///< of numbers; any for all else
};

/// The variables must outlive the bindings.
ParameterBinding bind_number(double &value, const Range &range);
ParameterBinding bind_numbers(std::span<double> values, const Range &range);
ParameterBinding bind_number_list(std::vector<double> &values, const Range &range);
ParameterBinding bind_truth(bool &value);
ParameterBinding bind_text(std::string &value);

/// One of the choices' names; `set(i)` takes the i-th one, `get()` gives the index of the present one.
ParameterBinding bind_choice(std::vector<std::string> choices, std::function<void(std::size_t)> set,
                             std::function<std::size_t()> get);

/// Why `text` is no integer within both the range and [lowest, highest]; empty if it is.
std::string integer_refusal(const std::string &text, const Range &range, std::int64_t lowest, std::uint64_t highest);

template <std::integral Integer>
ParameterBinding bind_integer(Integer &value, const Range &range)
{
  using Limits = std::numeric_limits<Integer>;
  return {.refusal = [range](const std::string &text)
          { return integer_refusal(text, range, static_cast<std::int64_t>(Limits::min()), Limits::max()); },
          .assign =
              [&value](const std::string &text)
          {
            if constexpr (std::signed_integral<Integer>)
              value = static_cast<Integer>(std::stoll(text));
            else
              value = static_cast<Integer>(std::stoull(text));
          },
          .text = [&value] { return std::to_string(value); },
          .allowed = "a whole number" + (range.text().empty() && Limits::min() == 0 ? " >= 0" : range.text()),
          .range = range};
}

} // namespace bergamo::driver
