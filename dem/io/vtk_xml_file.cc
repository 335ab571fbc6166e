#include "dem/io/vtk_xml_file.h"

#include "dem/io/triangle_soup.h"

#include <boost/archive/iterators/binary_from_base64.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <sstream>
#include <utility>

namespace bergamo::dem
{
namespace
{

bool is_space(const char c)
{
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

std::string without_spaces(std::string text)
{
  std::erase_if(text, is_space);
  return text;
}

/// The first bytes of base64, or all where there are fewer. It may be several pieces, each with its padding.
std::string decoded(std::string_view text, const std::size_t n_bytes)
{
  using Bytes = boost::archive::iterators::transform_width<
      boost::archive::iterators::binary_from_base64<std::string_view::const_iterator>, 8, 6>;
  std::string bytes;
  while (!text.empty() && bytes.size() < n_bytes)
  {
    const std::size_t n_letters = std::min(text.find('='), text.size());
    const std::size_t n = std::min(n_letters * 6 / 8, n_bytes - bytes.size());
    std::copy_n(Bytes(text.begin()), n, std::back_inserter(bytes));
    text.remove_prefix(n_letters);
    text.remove_prefix(std::min(text.find_first_not_of('='), text.size()));
  }
  return bytes;
}

template <class Number>
std::vector<double> as(const std::string &bytes)
{
  std::vector<double> numbers(bytes.size() / sizeof(Number));
  for (std::size_t k = 0; k < numbers.size(); ++k)
  {
    Number number;
    std::memcpy(&number, bytes.data() + k * sizeof number, sizeof number);
    numbers[k] = static_cast<double>(number);
  }
  return numbers;
}

struct NumberType
{
  const char *name;
  std::size_t size;
  std::vector<double> (*read)(const std::string &bytes);
};

constexpr NumberType number_types[] = {
    {"Float32", 4, as<float>},        {"Float64", 8, as<double>},       {"Int8", 1, as<std::int8_t>},
    {"Int16", 2, as<std::int16_t>},   {"Int32", 4, as<std::int32_t>},   {"Int64", 8, as<std::int64_t>},
    {"UInt8", 1, as<std::uint8_t>},   {"UInt16", 2, as<std::uint16_t>}, {"UInt32", 4, as<std::uint32_t>},
    {"UInt64", 8, as<std::uint64_t>},
};

} // namespace

VtkXmlFile::VtkXmlFile(const std::filesystem::path &path, const std::string_view type) : path(path), type(type)
{
  std::string content = surface_file_content(path);
  if (const std::size_t start = content.find("<AppendedData"); start != std::string::npos)
  {
    const std::size_t end_of_tag = content.find('>', start), mark = content.find('_', end_of_tag),
                      end = content.rfind("</AppendedData>");
    if (mark == std::string::npos || end == std::string::npos || end < mark ||
        content.find("</VTKFile>", end) == std::string::npos)
      reject_surface_file(path, "its AppendedData has no end after ", content.size(),
                          " bytes: it is truncated; write it again");
    appended = content.substr(mark + 1, end - mark - 1);
    content = content.substr(0, end_of_tag + 1) + "</AppendedData></VTKFile>";
  }
  try
  {
    std::istringstream stream(content);
    boost::property_tree::read_xml(stream, tree);
  }
  catch (const boost::property_tree::xml_parser_error &error)
  {
    reject_surface_file(path, "it is no whole XML: ", error.message(), " in line ", error.line(),
                        "; write it again, by ParaView or meshio");
  }
  const auto file = tree.get_child_optional("VTKFile");
  if (!file)
    reject_surface_file(path, "it is XML, but no file of VTK; write it by ParaView or meshio");
  if (const std::string given = attribute(*file, "type"); given != type)
    reject_surface_file(path, "it holds a data set of type ", given, "; save it as ", type, " (.vtu)");
  if (!file->get_child_optional(this->type))
    reject_surface_file(path, "it has no element ", type, "; write it again");
  const std::string order = file->get("<xmlattr>.byte_order", "LittleEndian");
  if ((order == "LittleEndian") != (std::endian::native == std::endian::little))
    reject_surface_file(path, "its byte_order is ", order, ", not this machine's; write it again on one of its kind");
  compressor = file->get("<xmlattr>.compressor", "");
  if (file->get("<xmlattr>.header_type", "UInt32") == "UInt64")
    word_size = 8;
  if (const auto data = file->get_child_optional("AppendedData"))
  {
    appended_is_base64 = data->get("<xmlattr>.encoding", "base64") == "base64";
    if (appended_is_base64)
      appended = without_spaces(std::move(appended));
  }
}

std::string VtkXmlFile::attribute(const Element &element, const std::string &name) const
{
  const auto value = element.get_optional<std::string>("<xmlattr>." + name);
  if (!value)
    reject_surface_file(path, "an element lacks its attribute ", name, "; write it again");
  return *value;
}

std::size_t VtkXmlFile::count(const Element &element, const std::string &name) const
{
  const std::string text = attribute(element, name);
  std::size_t n = 0;
  const char *const end = text.data() + text.size();
  if (const auto [stop, error] = std::from_chars(text.data(), end, n); error != std::errc() || stop != end)
    reject_surface_file(path, "an element's ", name, " is \"", text, "\", which is no number; write it again");
  return n;
}

std::string VtkXmlFile::unpacked(const std::string_view source, const bool is_base64, const std::string &name) const
{
  const auto damaged = [&](const auto &...reason)
  { reject_surface_file(path, "its array ", name, " is damaged: ", reason..., "; write it again"); };
  const auto first = [&](const std::size_t n)
  {
    std::string bytes = is_base64 ? decoded(source, n) : std::string(source.substr(0, n));
    if (bytes.size() < n)
      damaged("it has ", bytes.size(), " of ", n, " bytes");
    return bytes;
  };
  const auto word = [&](const std::string &bytes, const std::size_t k)
  {
    std::uint64_t value = 0;
    std::memcpy(&value, bytes.data() + k * word_size, word_size); // little-endian, or of the right size
    return value;
  };
  // Data packed by zlib are at most 1032 times larger than what they are packed in.
  const std::uint64_t largest = 1032 * (source.size() + 1);
  if (compressor.empty())
  {
    const std::uint64_t size = word(first(word_size), 0);
    if (size > largest)
      damaged("it claims ", size, " bytes");
    return first(word_size + size).substr(word_size);
  }
  if (compressor != "vtkZLibDataCompressor")
    reject_surface_file(path, "it is compressed by ", compressor,
                        "; write it without compression or by ZLib (vtkZLibDataCompressor)");
  const std::uint64_t n_blocks = word(first(word_size), 0);
  if (n_blocks == 0)
    return {};
  if (n_blocks > source.size())
    damaged("it claims ", n_blocks, " blocks");
  constexpr std::size_t own_words = 3; // before the sizes of the blocks
  const std::size_t head = (own_words + n_blocks) * word_size;
  const std::string sizes = first(head);
  const std::uint64_t block_size = word(sizes, 1), rest = word(sizes, 2);
  std::size_t packed_size = 0;
  for (std::size_t b = 0; b < n_blocks; ++b)
    packed_size += std::min(word(sizes, own_words + b), largest);
  const std::uint64_t last_size = rest > 0 ? rest : block_size;
  if (last_size > std::min(largest, block_size) || packed_size > source.size() ||
      (n_blocks > 1 && block_size > largest / (n_blocks - 1)))
    damaged("its ", n_blocks, " blocks claim ", block_size, " bytes each, packed in ", packed_size);
  const std::string packed = first(head + packed_size);
  std::string bytes;
  std::size_t at = head;
  for (std::size_t b = 0; b < n_blocks; ++b)
  {
    uLongf size = b + 1 == n_blocks ? last_size : block_size;
    const std::uint64_t size_in_file = word(sizes, own_words + b);
    std::string block(size, '\0');
    if (uncompress(reinterpret_cast<Bytef *>(block.data()), &size, reinterpret_cast<const Bytef *>(packed.data() + at),
                   size_in_file) != Z_OK ||
        size != block.size())
      damaged("zlib cannot unpack its block ", b);
    bytes += block;
    at += size_in_file;
  }
  return bytes;
}

std::vector<double> VtkXmlFile::numbers_of_text(const Element &array, const std::string &name) const
{
  std::vector<double> numbers;
  const std::string &text = array.data();
  const char *at = text.data(), *const end = at + text.size();
  while ((at = std::find_if_not(at, end, is_space)) != end)
  {
    const auto [stop, error] = std::from_chars(at, end, numbers.emplace_back());
    if (error != std::errc())
      reject_surface_file(path, "entry ", numbers.size() - 1, " of its array ", name, " is no number; write it again");
    at = stop;
  }
  return numbers;
}

std::string VtkXmlFile::bytes_of(const Element &array, const std::string &name) const
{
  try
  {
    if (array.get("<xmlattr>.format", "") != "appended")
      return unpacked(without_spaces(array.data()), true, name);
    const std::size_t offset = count(array, "offset");
    if (offset >= appended.size())
      reject_surface_file(path, "its array ", name, " begins at byte ", offset, " of ", appended.size(),
                          ": it is truncated; write it again");
    return unpacked(std::string_view(appended).substr(offset), appended_is_base64, name);
  }
  catch (const boost::archive::iterators::dataflow_exception &)
  {
    reject_surface_file(path, "its array ", name, " is no base64; write it again");
  }
}

std::vector<double> VtkXmlFile::numbers(const Element &array) const
{
  const std::string name = array.get("<xmlattr>.Name", "Points");
  if (array.get("<xmlattr>.format", "ascii") == "ascii")
    return numbers_of_text(array, name);
  const std::string type_name = attribute(array, "type");
  const auto number_type = std::find_if(std::begin(number_types), std::end(number_types),
                                        [&](const NumberType &t) { return t.name == type_name; });
  if (number_type == std::end(number_types))
    reject_surface_file(path, "its array ", name, " has numbers of type ", type_name,
                        ", which is not known; write them as Float64 or Int64");
  const std::string bytes = bytes_of(array, name);
  if (bytes.size() % number_type->size != 0)
    reject_surface_file(path, "its array ", name, " has ", bytes.size(), " bytes, no whole number of ", type_name,
                        "; write it again");
  return number_type->read(bytes);
}

} // namespace bergamo::dem
