#include "benchmarks/liggghts_text.h"

#include <limits>
#include <sstream>

namespace bergamo::benchmark
{

std::string liggghts_begin(const std::string &data_file, const double skin)
{
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::max_digits10);
  text << "atom_style granular\n"
          "atom_modify map array\n"
          "boundary f f f\n"
          "newton off\n"
          "communicate single vel yes\n"
          "hard_particles yes\n" // it asks to confirm moduli above 1 GPa
          "soft_particles yes\n" // and below 5 MPa
          "units si\n"
          "read_data "
       << data_file << "\nneighbor " << skin << " bin\n"
       << "neigh_modify delay 0\n"; // its own recommendation for granular runs
  return text.str();
}

std::string liggghts_property(const std::string &name, const std::string &kind, const std::vector<double> &values)
{
  std::ostringstream line;
  line.precision(std::numeric_limits<double>::max_digits10);
  line << "fix " << name << " all property/global " << name << ' ' << kind;
  for (const double value : values)
    line << ' ' << value;
  return line.str() + '\n';
}

} // namespace bergamo::benchmark
