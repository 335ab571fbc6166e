#include "dem/core/index.h"
#include "dem/core/rows.h"

#include <catch2/catch.hpp>

#include <random>
#include <type_traits>

using bergamo::Index, bergamo::Rows;

TEST_CASE("rows hold what was put into them, in the order in which it was put")
{
  std::mt19937 random(1);
  constexpr std::size_t n_rows = 17, n_entries = 200;
  std::vector<std::size_t> row(n_entries);
  std::vector<std::vector<int>> expected(n_rows);
  for (std::size_t k = 0; k < n_entries; ++k)
  {
    row[k] = random() % (n_rows - 3) + 1; // the first and the last rows stay empty
    expected[row[k]].push_back(static_cast<int>(k));
  }
  const Rows<int> rows(n_rows,
                       [&](const auto &put)
                       {
                         for (std::size_t k = 0; k < n_entries; ++k)
                           put(row[k], static_cast<int>(k));
                       });
  REQUIRE(rows.size() == n_rows);
  for (std::size_t r = 0; r < n_rows; ++r)
    CHECK(std::vector<int>(rows[r].begin(), rows[r].end()) == expected[r]);
  CHECK(Rows<int>().size() == 0);
}

TEST_CASE("an index into one list is none into another, and costs a number")
{
  using Node = Index<struct Nodes>;
  using Grain = Index<struct Grains>;
  STATIC_REQUIRE_FALSE(std::is_convertible_v<std::size_t, Node>);
  STATIC_REQUIRE_FALSE(std::is_convertible_v<Node, std::size_t>);
  STATIC_REQUIRE_FALSE(std::is_convertible_v<Node, Grain>);
  STATIC_REQUIRE_FALSE(std::is_constructible_v<Node, Grain>);
  STATIC_REQUIRE(sizeof(Node) == sizeof(std::size_t));
  STATIC_REQUIRE(std::is_trivially_copyable_v<Node>);
  CHECK(Node(3).place() == 3);
  CHECK(Node(3) < Node(4));
  CHECK(Node() == Node(0));
}
