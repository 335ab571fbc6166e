#pragma once

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

/// Arrays of a VTU file as deal.II writes it: base64 of a header of four numbers, then of one block that zlib packed.
class VtuReader
{
public:
  explicit VtuReader(const std::filesystem::path &path)
  {
    std::stringstream content;
    content << std::ifstream(path).rdbuf();
    text_ = content.str();
  }

  /// The values of an array, one component after the other within a point; throws where there is none.
  std::vector<double> array(const std::string &name) const
  {
    const std::size_t place = text_.find("Name=\"" + name + "\"");
    if (place == std::string::npos)
      throw std::runtime_error("no array " + name);
    return decode(text_.rfind("<DataArray", place));
  }

  /// Places of the points, three numbers each.
  std::vector<double> points() const { return decode(text_.find("<DataArray", text_.find("<Points>"))); }

private:
  std::vector<double> decode(const std::size_t tag) const
  {
    const std::size_t end_of_tag = text_.find('>', tag);
    const std::string head = text_.substr(tag, end_of_tag - tag);
    std::string body;
    for (std::size_t k = end_of_tag + 1; text_[k] != '<'; ++k)
      if (!std::isspace(static_cast<unsigned char>(text_[k])))
        body += text_[k];
    if (head.find("ascii") != std::string::npos)
      throw std::runtime_error("an array of text");
    constexpr std::size_t header_length = 24; // base64 of 16 bytes
    const std::vector<unsigned char> header = bytes(body.substr(0, header_length));
    std::uint32_t sizes[4];
    std::memcpy(sizes, header.data(), sizeof sizes);
    const std::vector<unsigned char> packed = bytes(body.substr(header_length));
    std::vector<unsigned char> raw(sizes[1]);
    uLongf n = raw.size();
    if (sizes[0] != 1 || uncompress(raw.data(), &n, packed.data(), sizes[3]) != Z_OK)
      throw std::runtime_error("an array that zlib did not pack");
    for (const char *type : {"Float32", "Float64", "Int32", "UInt8"})
      if (head.find(type) != std::string::npos)
        return numbers(raw, type);
    throw std::runtime_error("an array of another type: " + head);
  }

  static std::vector<double> numbers(const std::vector<unsigned char> &raw, const std::string &type)
  {
    if (type == "Float32")
      return as<float>(raw);
    if (type == "Float64")
      return as<double>(raw);
    return type == "Int32" ? as<std::int32_t>(raw) : as<std::uint8_t>(raw);
  }

  template <class Number>
  static std::vector<double> as(const std::vector<unsigned char> &raw)
  {
    std::vector<Number> values(raw.size() / sizeof(Number));
    std::memcpy(values.data(), raw.data(), values.size() * sizeof(Number));
    return {values.begin(), values.end()};
  }

  static std::vector<unsigned char> bytes(const std::string &base64)
  {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<unsigned char> result;
    std::uint32_t bits = 0;
    int n_bits = 0;
    for (const char c : base64)
    {
      if (c == '=')
        break;
      bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
      if ((n_bits += 6) >= 8)
        result.push_back(static_cast<unsigned char>(bits >> (n_bits -= 8)));
    }
    return result;
  }

  std::string text_;
};
