#include "drivers/common/processor_name.h"

#include <catch2/catch.hpp>

#include <cctype>
#include <fstream>
#include <string>

TEST_CASE("a processor has the name that the system has for it, or is unknown")
{
  const std::string name = bergamo::driver::processor_name();
  REQUIRE_FALSE(name.empty());
  CHECK_FALSE(std::isspace(static_cast<unsigned char>(name.front())));
  CHECK(name.front() != ':');
  std::ifstream file("/proc/cpuinfo");
  bool is_known = false;
  for (std::string line; std::getline(file, line);)
    is_known |= line.starts_with("model name") && line.ends_with(": " + name);
  CHECK((is_known || name == "unknown"));
}
