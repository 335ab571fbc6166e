#pragma once

#include <compare>
#include <cstddef>

namespace bergamo
{

/// A place in one kind of list, which the compiler does not take for that in another: costs no more than its number.
/// @tparam List a type of no other use that stands for the kind
template <class List>
class Index
{
public:
  constexpr Index() = default;
  constexpr explicit Index(const std::size_t place) : place_(place) {}

  /// For the list itself: list[index.place()].
  constexpr std::size_t place() const { return place_; }

  friend constexpr auto operator<=>(Index, Index) = default;

private:
  std::size_t place_ = 0;
};

} // namespace bergamo
