#include "dem/core/error.h"
#include "dem/core/whole_file.h"
#include "drivers/common/history.h"
#include "drivers/common/run_folder.h"
#include "tests/temporary_folder.h"

#include <catch2/catch.hpp>

#include <sys/resource.h>

#include <array>
#include <cmath>
#include <csignal>

using namespace bergamo::driver;
using bergamo::ConfigError;
using bergamo::RunError;
using bergamo::write_whole_file;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace
{

/// While it lives, files cannot grow beyond a size: what a full disk does, for a test.
class FileSizeLimit
{
public:
  explicit FileSizeLimit(const rlim_t bytes)
  {
    old_handler = std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &old_limit);
    const rlimit limit = {bytes, old_limit.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit()
  {
    ::setrlimit(RLIMIT_FSIZE, &old_limit);
    std::signal(SIGXFSZ, old_handler);
  }

private:
  rlimit old_limit = {};
  void (*old_handler)(int) = nullptr;
};

std::size_t n_files(const fs::path &folder)
{
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

const std::vector<std::string> columns = {"time_s", "stress_1_Pa"};

} // namespace

TEST_CASE("an atomic write replaces the file and leaves nothing else")
{
  TemporaryFolder folder;
  write_whole_file(folder / "a.txt", "one");
  write_whole_file(folder / "a.txt", "two\n");
  CHECK(content_of(folder / "a.txt") == "two\n");
  CHECK(n_files(folder.path()) == 1);
}

TEST_CASE("an atomic write that fails leaves the old file, no part, and names the remedy")
{
  TemporaryFolder folder;
  write_whole_file(folder / "a.txt", "old");
  {
    const FileSizeLimit full_disk(100);
    CHECK_THROWS_WITH(write_whole_file(folder / "a.txt", std::string(5000, 'x')),
                      Contains("a.txt: File too large; free some space"));
    CHECK_THROWS_AS(write_whole_file(folder / "a.txt", std::string(5000, 'x')), RunError);
  }
  CHECK(content_of(folder / "a.txt") == "old");
  CHECK(n_files(folder.path()) == 1);
  CHECK_THROWS_WITH(write_whole_file(folder / "missing/a.txt", "x"),
                    Contains("No such file or directory; create the folder first"));
}

TEST_CASE("a new run folder is made only when it is opened")
{
  TemporaryFolder parent;
  RunFolder folder(parent / "a/b", FolderMode::fresh);
  CHECK(n_files(parent.path()) == 0);
  folder.open();
  CHECK(fs::is_directory(parent / "a/b"));
  CHECK(folder.snapshot() == parent / "a/b/snapshot.h5");
}

TEST_CASE("a folder with files in it is refused without --force or --restart")
{
  TemporaryFolder parent;
  put(parent / "run/history.csv", "old");
  CHECK_THROWS_WITH(RunFolder(parent / "run", FolderMode::fresh),
                    Contains("is not empty") && Contains("--force") && Contains("--restart") && Contains("--output"));
  CHECK_THROWS_AS(RunFolder(parent / "run", FolderMode::fresh), ConfigError);
  fs::create_directory(parent / "empty");
  CHECK_NOTHROW(RunFolder(parent / "empty", FolderMode::fresh));
}

TEST_CASE("force moves the earlier run aside, but not before the folder is opened")
{
  TemporaryFolder parent;
  put(parent / "run/history.csv", "old");
  put(parent / "run/grains_0001.vtu", "old");
  put(parent / "run/plots/picture.png", "old");
  put(parent / "run/ensemble.csv", "old");
  put(parent / "run/notes.txt", "mine");
  put(parent / "run/notes.vtu", "mine");
  put(parent / "run/summary.json.partial", "half");
  put(parent / "run/previous_run/history.csv", "older");
  {
    RunFolder folder(parent / "run", FolderMode::force, {"ensemble.csv"});
    CHECK(content_of(parent / "run/history.csv") == "old");
    CHECK(content_of(parent / "run/previous_run/history.csv") == "older");
    folder.open();
  }
  CHECK(content_of(parent / "run/previous_run/history.csv") == "old");
  CHECK(fs::exists(parent / "run/previous_run/grains_0001.vtu"));
  CHECK(fs::exists(parent / "run/previous_run/plots/picture.png"));
  CHECK(fs::exists(parent / "run/previous_run/ensemble.csv"));
  CHECK(content_of(parent / "run/notes.txt") == "mine");
  CHECK(content_of(parent / "run/notes.vtu") == "mine");
  CHECK(n_files(parent / "run") == 3);

  RunFolder(parent / "run", FolderMode::force).open(); // nothing of a run there: what was moved aside stays
  CHECK(content_of(parent / "run/previous_run/history.csv") == "old");
}

TEST_CASE("restart needs a snapshot and keeps the files")
{
  TemporaryFolder parent;
  put(parent / "run/history.csv", "old");
  CHECK_THROWS_WITH(RunFolder(parent / "run", FolderMode::restart), Contains("finds no snapshot.h5"));
  CHECK_THROWS_AS(RunFolder(parent / "nowhere", FolderMode::restart), ConfigError);
  put(parent / "run/snapshot.h5", "state");
  RunFolder(parent / "run", FolderMode::restart).open();
  CHECK(content_of(parent / "run/history.csv") == "old");
  CHECK(content_of(parent / "run/snapshot.h5") == "state");
}

TEST_CASE("a run folder that cannot be made is refused before the run")
{
  TemporaryFolder parent;
  put(parent / "file", "x");
  CHECK_THROWS_WITH(RunFolder(parent / "file", FolderMode::force), Contains("is a file"));
  CHECK_THROWS_WITH(RunFolder(parent / "file/run", FolderMode::fresh), Contains("is a file"));
  CHECK_THROWS_WITH(RunFolder("/proc/bergamo/run", FolderMode::fresh), // not writable for anybody
                    Contains("cannot make output folder /proc/bergamo/run"));
}

TEST_CASE("two runs cannot write to one folder at a time")
{
  TemporaryFolder parent;
  const FolderMode mode = GENERATE(FolderMode::fresh, FolderMode::force, FolderMode::restart);
  RunFolder early(parent / "run", FolderMode::fresh); // before the folder is there
  RunFolder first(parent / "run", FolderMode::fresh);
  first.open();
  put(parent / "run/snapshot.h5", "state");
  CHECK_THROWS_WITH(early.open(), Contains("another run is writing"));
  CHECK_THROWS_WITH(RunFolder(parent / "run", mode), Contains("another run is writing"));
  CHECK(content_of(parent / "run/snapshot.h5") == "state");
}

TEST_CASE("of two runs begun at once in a fresh folder, the slower one leaves what the other has written")
{
  TemporaryFolder parent;
  RunFolder slow(parent / "run", FolderMode::fresh);
  {
    RunFolder fast(parent / "run", FolderMode::fresh);
    fast.open();
    put(fast.history(), "finished");
  }
  CHECK_THROWS_WITH(slow.open(), Contains("is not empty") && Contains("--output"));
  CHECK(content_of(parent / "run/history.csv") == "finished");
}

TEST_CASE("a run keeps others out from the moment it has looked at a folder that is there")
{
  TemporaryFolder parent;
  put(parent / "run/snapshot.h5", "state");
  const RunFolder goes_on(parent / "run", FolderMode::restart); // it reads the snapshot before it opens the folder
  CHECK_THROWS_WITH(RunFolder(parent / "run", FolderMode::force), Contains("another run is writing"));
}

TEST_CASE("a history has a header and exact rows")
{
  TemporaryFolder folder;
  const double third = 1.0 / 3.0;
  {
    History history(folder / "history.csv", columns);
    history.append(std::array{0.0, -1e5});
    CHECK(content_of(folder / "history.csv") == "time_s,stress_1_Pa\n0,-1e+05\n"); // there at once
    history.append(std::array{third, std::nextafter(1.0, 2.0)});
    CHECK_THROWS_AS(history.append(std::array{1.0}), std::logic_error);
  }
  const std::string text = content_of(folder / "history.csv");
  const std::string row = text.substr(text.rfind('\n', text.size() - 2) + 1);
  CHECK(std::stod(row) == third);
  CHECK(std::stod(row.substr(row.find(',') + 1)) == std::nextafter(1.0, 2.0));
}

TEST_CASE("a history refuses bad column names")
{
  TemporaryFolder folder;
  CHECK_THROWS_AS(History(folder / "h.csv", {}), std::logic_error);
  CHECK_THROWS_AS(History(folder / "h.csv", {"t"}), std::logic_error);
  CHECK_THROWS_AS(History(folder / "h.csv", {"time_s", "a,b"}), std::logic_error);
  CHECK_THROWS_AS(History(folder / "h.csv", {"time_s", "a", "a"}), std::logic_error);
}

TEST_CASE("a history continued after a kill equals one that was never stopped")
{
  TemporaryFolder folder;
  const auto row = [](const int i) { return std::array{i * 0.1, std::sqrt(static_cast<double>(i))}; };
  {
    History whole(folder / "whole.csv", columns);
    for (int i = 0; i < 10; ++i)
      whole.append(row(i));
    History killed(folder / "killed.csv", columns);
    for (int i = 0; i < 7; ++i)
      killed.append(row(i));
  }
  std::ofstream(folder / "killed.csv", std::ios::app) << "0.70000000000000"; // the row that the kill cut
  const double snapshot_time = 4 * 0.1;
  {
    History history = History::continued(folder / "killed.csv", columns, snapshot_time);
    for (int i = 5; i < 10; ++i)
      history.append(row(i));
  }
  CHECK(content_of(folder / "killed.csv") == content_of(folder / "whole.csv"));
  CHECK(n_files(folder.path()) == 2);
}

TEST_CASE("a history is cut at every snapshot time")
{
  TemporaryFolder folder;
  for (int last = -1; last <= 3; ++last)
  {
    put(folder / "h.csv", "time_s,stress_1_Pa\n0,1\n1,2\n2,3\n");
    History::continued(folder / "h.csv", columns, last);
    const std::string text = content_of(folder / "h.csv");
    CHECK(std::count(text.begin(), text.end(), '\n') == 1 + std::min(last + 1, 3));
  }
}

TEST_CASE("a history that cannot be continued is explained and left as it is")
{
  TemporaryFolder folder;
  CHECK_THROWS_AS(History::continued(folder / "h.csv", columns, 1), ConfigError);
  put(folder / "h.csv", "time_s,other\n0,1\n");
  CHECK_THROWS_WITH(History::continued(folder / "h.csv", columns, 1), Contains("has other columns"));
  put(folder / "h.csv", "time_s,stress_1_Pa\n0,1\nrubbish\n2,3\n");
  CHECK_THROWS_WITH(History::continued(folder / "h.csv", columns, 1), Contains("damaged in line 3"));
  CHECK(content_of(folder / "h.csv") == "time_s,stress_1_Pa\n0,1\nrubbish\n2,3\n");
}

TEST_CASE("a history says when the disk is full")
{
  TemporaryFolder folder;
  History history(folder / "h.csv", columns);
  const FileSizeLimit full_disk(40);
  const auto fill = [&]
  {
    for (int i = 0; i < 100; ++i)
      history.append(std::array{0.1 * i, 1.0});
  };
  CHECK_THROWS_WITH(fill(), Contains("h.csv") && Contains("free some space"));
}
