#include "benchmarks/peers/track.h"

#include "dem/core/error.h"

#include <fstream>
#include <string>

namespace bergamo::benchmark
{

Track read_track(const std::filesystem::path &path, const double time_step, const std::int64_t first_id)
{
  std::ifstream file(path);
  const auto reject_file = [&](const std::string &why)
  { throw RunError("the track " + path.string() + ' ' + why + ": the program that wrote it must have stopped early"); };
  Track track;
  std::size_t n_beads = 0;
  for (std::string line; std::getline(file, line);)
    if (line == "ITEM: TIMESTEP")
    {
      std::int64_t step = 0;
      file >> step;
      track.emplace_back();
      track.back().time = static_cast<double>(step) * time_step;
    }
    else if (line == "ITEM: NUMBER OF ATOMS")
      file >> n_beads;
    else if (line.starts_with("ITEM: ATOMS id x y z"))
      for (std::size_t i = 0; i < n_beads && !track.empty(); ++i)
      {
        std::int64_t id = 0;
        Vec3 x;
        if (!(file >> id >> x.x() >> x.y() >> x.z()))
          reject_file("ends within a moment");
        track.back().id.push_back(id - first_id);
        track.back().position.push_back(x);
      }
  if (track.empty())
    reject_file("is missing or holds nothing");
  return track;
}

} // namespace bergamo::benchmark
