#include "dem/core/archive.h"
#include "dem/core/error.h"

#include "tests/temporary_folder.h"
#include <bit>

#include <catch2/catch.hpp>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <numeric>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace bergamo;
namespace fs = std::filesystem;

namespace
{

void write_all(const fs::path &path, const std::string &bytes)
{
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

bool same_bits(const std::vector<double> &a, const std::vector<double> &b)
{
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

const std::vector<double> peculiar{0.,
                                   -0.,
                                   1. / 3.,
                                   std::numeric_limits<double>::infinity(),
                                   -std::numeric_limits<double>::infinity(),
                                   std::numeric_limits<double>::denorm_min(),
                                   std::numeric_limits<double>::max(),
                                   std::bit_cast<double>(0x7ff80000deadbeefu),
                                   std::bit_cast<double>(0xfff0000000000001u)};

std::vector<double> many_doubles()
{
  std::vector<double> values(150000);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = std::sin(static_cast<double>(i));
  return values;
}

void write_example(const fs::path &path, const std::size_t n = 1000)
{
  std::vector<double> values(n);
  std::iota(values.begin(), values.end(), 0.5);
  const std::vector<std::int64_t> ids{4, 3, -1};
  ArchiveWriter writer(path, "test");
  writer.write("grains/position", values);
  writer.write("grains/id", ids);
  writer.write("time", 0.25);
  writer.commit();
}

std::string message_of(const std::function<void()> &action)
{
  try
  {
    action();
  }
  catch (const RunError &error)
  {
    return error.what();
  }
  return "";
}

} // namespace

TEST_CASE("an archive gives back every bit")
{
  const TemporaryFolder folder;
  const fs::path path = folder / "snapshot.h5";
  const std::vector<double> none, many = many_doubles();
  const std::vector<std::int64_t> integers{0, -1, std::numeric_limits<std::int64_t>::min(),
                                           std::numeric_limits<std::int64_t>::max()};
  {
    ArchiveWriter writer(path, "test");
    writer.write("peculiar", peculiar);
    writer.write("deep/er/many", many);
    writer.write("deep/er/integers", integers);
    writer.write("none", none);
    writer.write("no_integers", std::span<const std::int64_t>());
    writer.write("nan", peculiar[7]);
    writer.write("count", 7);
    writer.write("size", std::size_t{1} << 40);
    writer.write("text", "set Grains = 5\n# Überlappung \"ε\"\n");
    writer.write("empty text", std::string());
    writer.write("text with a zero", std::string("a\0b\0", 4));
    writer.commit();
  }
  CHECK_FALSE(fs::exists(path.string() + ".partial"));

  const ArchiveReader reader(path, "test");
  CHECK(same_bits(reader.read_doubles("peculiar"), peculiar));
  CHECK(same_bits(reader.read_doubles("deep/er/many"), many));
  CHECK(reader.read_integers("deep/er/integers") == integers);
  CHECK(reader.read_doubles("none").empty());
  CHECK(reader.read_integers("no_integers").empty());
  CHECK(std::bit_cast<std::uint64_t>(reader.read_double("nan")) == 0x7ff80000deadbeefu);
  CHECK(reader.read_integer("count") == 7);
  CHECK(reader.read_integer("size") == std::int64_t{1} << 40);
  CHECK(reader.read_text("text") == "set Grains = 5\n# Überlappung \"ε\"\n");
  CHECK(reader.read_text("empty text").empty());
  CHECK(reader.read_text("text with a zero") == std::string("a\0b\0", 4));
  CHECK(reader.has("deep/er/many"));
  CHECK(reader.has("none"));
  CHECK_FALSE(reader.has("deep/er"));
  CHECK_FALSE(reader.has("shallow/many"));

  std::vector<double> into(many.size());
  reader.read_into("deep/er/many", into);
  CHECK(same_bits(into, many));
  into.resize(5);
  CHECK_THROWS_WITH(reader.read_into("deep/er/many", into),
                    Catch::Contains("deep/er/many") && Catch::Contains("150000") && Catch::Contains("5 belong"));
}

TEST_CASE("equal content makes equal archives, byte for byte")
{
  const TemporaryFolder folder;
  write_example(folder / "a.h5");
  write_example(folder / "b.h5");
  CHECK(content_of(folder / "a.h5") == content_of(folder / "b.h5"));
}

TEST_CASE("an archive that is not committed leaves the older one alone")
{
  const TemporaryFolder folder;
  const fs::path path = folder / "snapshot.h5", partial = folder / "snapshot.h5.partial";
  write_example(path);
  const std::string before = content_of(path);

  SECTION("destroyed")
  {
    {
      ArchiveWriter writer(path, "test");
      writer.write("time", 1.);
      CHECK(fs::exists(partial));
    }
    CHECK_FALSE(fs::exists(partial));
  }
  SECTION("killed")
  {
    const pid_t child = ::fork();
    if (child == 0)
    {
      ArchiveWriter writer(path, "test");
      writer.write("many", many_doubles());
      ::raise(SIGKILL);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    REQUIRE(WIFSIGNALED(status));
    CHECK(fs::exists(partial));
  }
  CHECK(content_of(path) == before);
  write_example(path); // over whatever was left
  CHECK(content_of(path) == before);
  CHECK_FALSE(fs::exists(partial));
}

TEST_CASE("a truncated or lengthened archive is refused")
{
  const TemporaryFolder folder;
  const fs::path path = folder / "snapshot.h5", cut = folder / "cut.h5";
  write_example(path);
  const std::string whole = content_of(path);
  for (std::size_t length = 0; length < whole.size(); length += 97)
  {
    write_all(cut, whole.substr(0, length));
    CHECK_THROWS_AS(ArchiveReader(cut, "test"), RunError);
  }
  write_all(cut, whole.substr(0, whole.size() - 1));
  CHECK_THROWS_WITH(ArchiveReader(cut, "test"), Catch::Contains("cut.h5") && Catch::Contains("damaged"));
  write_all(cut, whole + '\0');
  CHECK_THROWS_WITH(ArchiveReader(cut, "test"), Catch::Contains("damaged"));
}

TEST_CASE("no flipped bit of an archive goes unseen")
{
  const TemporaryFolder folder;
  const fs::path path = folder / "snapshot.h5", changed = folder / "changed.h5";
  write_example(path, 200);
  const std::string whole = content_of(path);
  std::size_t n_seen = 0, n_tried = 0;
  for (std::size_t place = 0; place < whole.size(); place += place < 1024 ? 1 : 7)
  {
    std::string bytes = whole;
    bytes[place] = static_cast<char>(bytes[place] ^ (1 << place % 8));
    write_all(changed, bytes);
    ++n_tried;
    n_seen += !message_of([&] { ArchiveReader(changed, "test"); }).empty();
  }
  CHECK(n_seen == n_tried);

  // Pairs of flips that cancel in plain sums.
  std::string bytes = whole;
  std::swap_ranges(bytes.end() - 64, bytes.end() - 56, bytes.end() - 56);
  if (bytes != whole)
  {
    write_all(changed, bytes);
    CHECK_THROWS_AS(ArchiveReader(changed, "test"), RunError);
  }
  for (std::size_t place = 512; place + 8 < whole.size(); place += 64)
  {
    bytes = whole;
    bytes[place + 7] ^= '\x80';
    bytes[place + 15] ^= '\x80';
    write_all(changed, bytes);
    CHECK_THROWS_AS(ArchiveReader(changed, "test"), RunError);
  }
}

TEST_CASE("foreign files are refused with the reason")
{
  const TemporaryFolder folder;
  const fs::path path = folder / "snapshot.h5", foreign = folder / "foreign.h5";
  write_example(path);
  CHECK_THROWS_WITH(ArchiveReader(folder / "nowhere.h5", "test"),
                    Catch::Contains("nowhere.h5") && Catch::Contains("No such file"));
  CHECK_THROWS_WITH(ArchiveReader(folder.path(), "test"), Catch::Contains("folder"));
  write_all(foreign, "");
  CHECK_THROWS_WITH(ArchiveReader(foreign, "test"), Catch::Contains("no archive of Bergamo"));
  write_all(foreign, std::string(5000, 'x'));
  CHECK_THROWS_WITH(ArchiveReader(foreign, "test"), Catch::Contains("no archive of Bergamo"));
  write_all(foreign, content_of(path).substr(512)); // HDF5 without a seal
  CHECK_THROWS_WITH(ArchiveReader(foreign, "test"), Catch::Contains("an HDF5 file, but no archive"));
  CHECK_THROWS_WITH(ArchiveReader(path, "another kind"),
                    Catch::Contains("'test'") && Catch::Contains("'another kind'"));
}

TEST_CASE("an archive of a newer format is refused as such")
{
  // The seal of a later format, its checksum made here: word by word, the format number as the seed.
  const TemporaryFolder folder;
  const fs::path path = folder / "snapshot.h5";
  write_example(path);
  std::string bytes = content_of(path);
  std::uint64_t sum = 2;
  for (std::size_t place = 512; place < bytes.size(); place += 8)
  {
    std::uint64_t word = 0;
    std::memcpy(&word, &bytes[place], std::min<std::size_t>(8, bytes.size() - place));
    sum = (sum ^ word) * 0x9e3779b97f4a7c15u;
    sum ^= sum >> 32;
  }
  char hexadecimal[17];
  std::snprintf(hexadecimal, sizeof hexadecimal, "%016llx", static_cast<unsigned long long>(sum));
  bytes.replace(bytes.find("format 1"), 8, "format 2");
  bytes.replace(bytes.find("checksum ") + 9, 16, hexadecimal);
  write_all(path, bytes);
  CHECK_THROWS_WITH(ArchiveReader(path, "test"),
                    Catch::Contains("format 2 is newer") && Catch::Contains("newer Bergamo"));
}

TEST_CASE("what an archive lacks, or holds otherwise, is named")
{
  const TemporaryFolder folder;
  const fs::path path = folder / "snapshot.h5";
  write_example(path);
  const ArchiveReader reader(path, "test");
  CHECK_THROWS_WITH(reader.read_doubles("grains/velocity"),
                    Catch::Contains("snapshot.h5") && Catch::Contains("'grains/velocity'"));
  CHECK_THROWS_AS(reader.read_doubles("grains"), RunError);
  CHECK_THROWS_WITH(reader.read_integers("grains/position"), Catch::Contains("no array of integers"));
  CHECK_THROWS_WITH(reader.read_doubles("grains/id"), Catch::Contains("no array of floating point values"));
  CHECK_THROWS_WITH(reader.read_double("grains/position"), Catch::Contains("no single floating point value"));
  CHECK_THROWS_WITH(reader.read_doubles("time"), Catch::Contains("no array"));
  CHECK_THROWS_WITH(reader.read_text("time"), Catch::Contains("no single text"));

  ArchiveWriter writer(folder / "other.h5", "test");
  writer.write("time", 1.);
  CHECK_THROWS_WITH(writer.write("time", 2.), Catch::Contains("'time' was written before"));
  CHECK_THROWS_AS(writer.write("time/of/day", 2.), RunError);
  CHECK_THROWS_AS(writer.write("", 2.), RunError);
  writer.commit();
  CHECK_THROWS_AS(writer.write("late", 2.), RunError);
  CHECK_THROWS_AS(writer.commit(), RunError);
  CHECK(ArchiveReader(folder / "other.h5", "test").read_double("time") == 1.);
}

TEST_CASE("a folder that cannot be written to is known at once")
{
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(ArchiveWriter(folder / "missing/snapshot.h5", "test"),
                    Catch::Contains("missing/snapshot.h5") && Catch::Contains("No such file or directory") &&
                        Catch::Contains("create the folder"));
  CHECK_THROWS_WITH(ArchiveWriter(folder.path(), "test"), Catch::Contains("Is a directory"));

  // Rights do not bind the superuser: become nobody for a moment.
  const bool superuser = ::geteuid() == 0;
  fs::permissions(folder.path(), fs::perms(0555));
  if (superuser && ::seteuid(65534) != 0)
    WARN("cannot give up the superuser's rights: read-only folder not tried");
  else
    CHECK_THROWS_WITH(ArchiveWriter(folder / "snapshot.h5", "test"),
                      Catch::Contains("Permission denied") && Catch::Contains("may write to"));
  if (superuser)
    REQUIRE(::seteuid(0) == 0);
  fs::permissions(folder.path(), fs::perms(0755));
}

TEST_CASE("a full disk is an error and the older archive survives")
{
  const TemporaryFolder folder;
  const fs::path path = folder / "snapshot.h5";
  const auto write_too_much = [&]
  {
    ArchiveWriter writer(path, "test");
    writer.write("many", many_doubles());
    writer.commit();
  };

  SECTION("limit on the file size")
  {
    write_example(path);
    const std::string before = content_of(path);
    struct rlimit old;
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &old) == 0);
    const auto old_action = std::signal(SIGXFSZ, SIG_IGN);
    const struct rlimit small
    {
      100000, old.rlim_max
    };
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
    const std::string message = message_of(write_too_much);
    ::setrlimit(RLIMIT_FSIZE, &old);
    std::signal(SIGXFSZ, old_action);
    CHECK_THAT(message, Catch::Contains("snapshot.h5") && Catch::Contains("File too large") &&
                            Catch::Contains("another output folder"));
    CHECK(content_of(path) == before);
    CHECK_FALSE(fs::exists(path.string() + ".partial"));
  }
  SECTION("full file system")
  {
    if (::mount("tmpfs", folder.path().c_str(), "tmpfs", 0, "size=128k") != 0)
      WARN("cannot mount a small file system: full disk tried by the file size limit alone");
    else
    {
      write_example(path);
      const std::string before = content_of(path);
      const std::string message = message_of(write_too_much);
      const bool whole = content_of(path) == before, left_over = fs::exists(path.string() + ".partial");
      ::umount(folder.path().c_str());
      CHECK_THAT(message, Catch::Contains("No space left") && Catch::Contains("free some space"));
      CHECK(whole);
      CHECK_FALSE(left_over);
    }
  }
}
