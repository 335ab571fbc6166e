#pragma once

#include <boost/property_tree/ptree.hpp>

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace bergamo::dem
{

/// An XML file of VTK: elements, and what their arrays hold as text, as base64 or as raw bytes behind the elements,
/// which is no XML; plain or compressed by zlib. The XML is read by Boost.PropertyTree.
class VtkXmlFile
{
public:
  using Element = boost::property_tree::ptree;

  /// Throws ConfigError for a file that is missing, empty, truncated, no file of VTK in XML, or of the other byte
  /// order. @param type of the data set, such as "UnstructuredGrid"
  VtkXmlFile(const std::filesystem::path &path, std::string_view type);

  const Element &data_set() const { return tree.get_child("VTKFile." + type); }

  /// Attribute that must be there.
  std::string attribute(const Element &element, const std::string &name) const;
  std::size_t count(const Element &element, const std::string &name) const;

  /// All numbers of a DataArray. Throws ConfigError for one that is damaged or compressed otherwise.
  std::vector<double> numbers(const Element &array) const;

private:
  std::vector<double> numbers_of_text(const Element &array, const std::string &name) const;
  std::string bytes_of(const Element &array, const std::string &name) const;
  std::string unpacked(std::string_view source, bool is_base64, const std::string &name) const;

  std::filesystem::path path;
  std::string type;
  Element tree;
  std::string appended; // what stands behind the mark "_"
  bool appended_is_base64 = false;
  std::string compressor;    // none if empty
  std::size_t word_size = 4; // of the sizes before an array [bytes]
};

} // namespace bergamo::dem
