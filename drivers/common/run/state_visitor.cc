#include "drivers/common/run/state_visitor.h"

namespace bergamo::driver
{

void StateVisitor::operator()(const std::string &name, double &value)
{
  if (reader_)
    value = reader_->read_double(name);
  else
    writer_->write(name, value);
}

void StateVisitor::operator()(const std::string &name, std::int64_t &value)
{
  if (reader_)
    value = reader_->read_integer(name);
  else
    writer_->write(name, value);
}

void StateVisitor::operator()(const std::string &name, Vec3 &value)
{
  (*this)(name, std::span<double>(value.data(), 3));
}

void StateVisitor::operator()(const std::string &name, std::vector<double> &values)
{
  if (reader_)
    values = reader_->read_doubles(name);
  else
    writer_->write(name, std::span<const double>(values));
}

void StateVisitor::operator()(const std::string &name, std::vector<Vec3> &values)
{
  if (reader_)
    values.resize(reader_->read_doubles(name).size() / 3);
  (*this)(name, std::span<double>(values.empty() ? nullptr : values.front().data(), 3 * values.size()));
}

void StateVisitor::operator()(const std::string &name, const std::span<double> values)
{
  if (reader_)
    reader_->read_into(name, values);
  else
    writer_->write(name, std::span<const double>(values));
}

} // namespace bergamo::driver
