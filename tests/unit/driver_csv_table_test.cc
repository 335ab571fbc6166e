#include "dem/core/error.h"
#include "drivers/common/csv_table.h"
#include "tests/temporary_folder.h"

#include <catch2/catch.hpp>

using namespace bergamo::driver;
using bergamo::ConfigError;
using Catch::Matchers::Contains;

TEST_CASE("the wanted columns of a table are read wherever they stand; others and a cut last row are left out")
{
  TemporaryFolder folder;
  const auto path = folder / "table.csv";
  put(path, "name,b_Pa,a\r\nfirst,-2.5,1\r\n,1e3,2\r\nlast,7,");
  const CsvTable table = read_csv(path, {"a", "b_Pa"});
  CHECK(table.n_rows == 2);
  CHECK(table["a"] == std::vector<double>{1, 2});
  CHECK(table["b_Pa"] == std::vector<double>{-2.5, 1000});
}

TEST_CASE("mistakes in a table name the file, the line and the column")
{
  TemporaryFolder folder;
  const auto path = folder / "table.csv";
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"", "is empty"},
      {"strain_x,stress\n", "has no column 'strain_z'; did you mean 'strain_x'?"},
      {"a,strain_z\n1,2\n3\n", "line 3 has 1 values, not 2"},
      {"a,strain_z\n1,2,3\n", "line 2 has 3 values, not 2"},
      {"a,strain_z\n1,\n", "line 2: strain_z is ''"},
      {"a,strain_z\n1,nan\n", "line 2: strain_z is 'nan'"},
  };
  for (const auto &[text, message] : wrong)
  {
    put(path, text);
    CHECK_THROWS_WITH(read_csv(path, {"strain_z"}), Contains("table.csv") && Contains(message));
    CHECK_THROWS_AS(read_csv(path, {"strain_z"}), ConfigError);
  }
  CHECK_THROWS_WITH(read_csv(folder / "none.csv", {"a"}), Contains("none.csv") && Contains("cannot be read"));
  CHECK_THROWS_WITH(read_csv(folder.path(), {"a"}), Contains("cannot be read"));
}
