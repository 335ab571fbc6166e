#include "dem/core/archive.h"

#include "dem/core/error.h"
#include "dem/core/whole_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <hdf5.h>
#include <optional>
#include <system_error>
#include <utility>

namespace bergamo
{

namespace
{

static_assert(std::endian::native == std::endian::little, "the checksum reads words in the order of the file");

constexpr unsigned format_version = 1;
constexpr std::size_t seal_size = 512;
constexpr hsize_t chunk_length = 1 << 16; ///< values that share one Fletcher32 sum

/// 64 bit checksum over words. Each step is one to one in the state, so any change within one word changes the result
/// for sure; other changes stay hidden with a chance of about 2^-64.
class Checksum
{
public:
  explicit Checksum(const std::uint64_t seed) : state_(seed) {}

  /// Every call but the last must bring a multiple of 8 bytes.
  void add(const char *bytes, std::size_t size)
  {
    for (; size > 0; bytes += std::min<std::size_t>(size, 8), size -= std::min<std::size_t>(size, 8))
    {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes, std::min<std::size_t>(size, 8));
      state_ = (state_ ^ word) * 0x9e3779b97f4a7c15u;
      state_ ^= state_ >> 32;
    }
  }

  std::uint64_t value() const { return state_; }

private:
  std::uint64_t state_;
};

std::string make_seal(const unsigned version, const std::uint64_t length, const std::uint64_t checksum)
{
  std::array<char, seal_size> text;
  text.fill(' ');
  const int end =
      std::snprintf(text.data(), text.size(), "bergamo archive\nformat %u\nlength %llu\nchecksum %016llx\n", version,
                    static_cast<unsigned long long>(length), static_cast<unsigned long long>(checksum));
  text[end] = ' ';
  text.back() = '\n';
  return {text.data(), text.size()};
}

/// An HDF5 identifier that is closed when it goes out of scope.
class Handle
{
public:
  Handle(const hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Handle(Handle &&other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle &operator=(Handle &&) = delete;
  ~Handle()
  {
    if (valid())
      close_(id_);
  }
  bool valid() const { return id_ >= 0; }
  operator hid_t() const { return id_; }

private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Keeps HDF5 from printing its own errors while in scope.
class Quiet
{
public:
  Quiet()
  {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Quiet() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
  Quiet(const Quiet &) = delete;
  Quiet &operator=(const Quiet &) = delete;

private:
  H5E_auto2_t print_ = nullptr;
  void *data_ = nullptr;
};

Handle text_type(const std::size_t size)
{
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, size);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

bool write_attribute(const hid_t file, const char *name, const hid_t type, const void *value)
{
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  return attribute.valid() && H5Awrite(attribute, type, value) >= 0;
}

} // namespace

struct ArchiveWriter::State
{
  WholeFile file;
  std::optional<Handle> hdf5; ///< in memory: HDF5 cannot end well once a disk is full

  explicit State(const std::filesystem::path &path) : file(path) {}

  [[noreturn]] void fail(const std::string &thing) const
  {
    throw RunError("cannot write " + file.path().string() + ": " + thing);
  }

  /// Rank 1 for an array of `length` values, rank 0 without a length.
  void write(const std::string &name, const hid_t file_type, const hid_t memory_type,
             const std::optional<hsize_t> length, const void *values)
  {
    const Quiet quiet;
    if (!hdf5)
      fail("'" + name + "' comes after the file was committed");
    const Handle space(length ? H5Screate_simple(1, &*length, nullptr) : H5Screate(H5S_SCALAR), H5Sclose);
    const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
    H5Pset_create_intermediate_group(links, 1);
    const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(creation, false); // equal content, equal bytes
    if (length && *length > 0)
    {
      const hsize_t chunk = std::min(*length, chunk_length);
      H5Pset_chunk(creation, 1, &chunk);
      H5Pset_fletcher32(creation);
    }
    if (H5Lexists(*hdf5, name.c_str(), H5P_DEFAULT) > 0)
      fail("'" + name + "' was written before; give each thing its own name");
    const Handle data(H5Dcreate2(*hdf5, name.c_str(), file_type, space, links, creation, H5P_DEFAULT), H5Dclose);
    if (!data.valid())
      fail("no place for '" + name + "'; the name must not be empty nor lead through another array");
    if ((!length || *length > 0) && H5Dwrite(data, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
      fail("no memory left for '" + name + "'; use a machine with more memory");
  }
};

ArchiveWriter::ArchiveWriter(const std::filesystem::path &path, const std::string &kind)
    : state_(std::make_shared<State>(path))
{
  const Quiet quiet;
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access, 1 << 20, false);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  // Never touched on disk, but HDF5 tells its files in memory apart by name.
  char name[64];
  std::snprintf(name, sizeof name, "/bergamo-archive-in-memory/%p", static_cast<void *>(state_.get()));
  Handle file(H5Fcreate(name, H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
  const Handle type = text_type(kind.size() + 1);
  const Handle format = text_type(sizeof "bergamo");
  if (!file.valid() || !write_attribute(file, "format", format, "bergamo") ||
      !write_attribute(file, "format_version", H5T_NATIVE_UINT, &format_version) ||
      !write_attribute(file, "kind", type, kind.c_str()))
    state_->fail("HDF5 cannot make a file in memory; use a machine with more memory");
  state_->hdf5.emplace(std::move(file));
}

ArchiveWriter::~ArchiveWriter()
{
  const Quiet quiet;
  state_.reset();
}

void ArchiveWriter::write(const std::string &name, const std::span<const double> values)
{
  state_->write(name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.size(), values.data());
}

void ArchiveWriter::write(const std::string &name, const std::span<const std::int64_t> values)
{
  state_->write(name, H5T_STD_I64LE, H5T_NATIVE_INT64, values.size(), values.data());
}

void ArchiveWriter::write(const std::string &name, const double value)
{
  state_->write(name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {}, &value);
}

void ArchiveWriter::write_integer(const std::string &name, const std::int64_t value)
{
  state_->write(name, H5T_STD_I64LE, H5T_NATIVE_INT64, {}, &value);
}

void ArchiveWriter::write(const std::string &name, const std::string &text)
{
  const Handle type = text_type(text.size() + 1);
  state_->write(name, type, type, {}, text.c_str());
}

std::function<void()> ArchiveWriter::finish()
{
  const Quiet quiet;
  if (!state_->hdf5)
    state_->fail("it was committed before");
  H5Fflush(*state_->hdf5, H5F_SCOPE_GLOBAL);
  const ssize_t size = H5Fget_file_image(*state_->hdf5, nullptr, 0);
  const auto image = std::make_shared<std::vector<char>>(size > 0 ? size : 0);
  if (size <= 0 || H5Fget_file_image(*state_->hdf5, image->data(), image->size()) != size)
    state_->fail("HDF5 cannot finish the file in memory; use a machine with more memory");
  state_->hdf5.reset();

  return [state = state_, image]
  {
    Checksum checksum(format_version);
    checksum.add(image->data(), image->size());
    state->file.write(make_seal(format_version, image->size(), checksum.value()));
    state->file.write(image->data(), image->size());
    state->file.commit();
  };
}

struct ArchiveReader::State
{
  std::filesystem::path path;
  std::optional<Handle> hdf5;

  [[noreturn]] void fail(const std::string &thing) const
  {
    throw RunError("cannot read " + path.string() + ": " + thing);
  }
  [[noreturn]] void fail_damaged() const { fail("the file is damaged; take an older copy or make it anew"); }

  /// Lets nothing pass to HDF5 but what an ArchiveWriter wrote, to the last bit.
  void check_seal() const
  {
    std::error_code status;
    if (std::filesystem::is_directory(path, status))
      fail("it is a folder; name a file in it");
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file)
      fail(std::system_category().message(errno) + "; look at the path and the right to read it");
    std::string seal(seal_size, '\0');
    file.read(seal.data(), seal.size());
    seal.resize(file.gcount());

    unsigned version = 0;
    unsigned long long length = 0, expected = 0;
    if (!seal.starts_with("bergamo archive\n"))
      fail(seal.starts_with("\x89HDF\r\n\x1a\n")
               ? "an HDF5 file, but no archive of Bergamo; name an archive"
               : "no archive of Bergamo, or its beginning is damaged; name an archive");
    if (std::sscanf(seal.c_str(), "bergamo archive\nformat %u\nlength %llu\nchecksum %llx", &version, &length,
                    &expected) != 3 ||
        seal != make_seal(version, length, expected))
      fail_damaged();

    Checksum checksum(version);
    std::vector<char> block(1 << 20);
    std::uint64_t n_read = 0;
    while (file)
    {
      file.read(block.data(), static_cast<std::streamsize>(block.size()));
      checksum.add(block.data(), file.gcount());
      n_read += file.gcount();
    }
    if (file.bad() || n_read != length || checksum.value() != expected)
      fail_damaged();
    if (version > format_version)
      fail("format " + std::to_string(version) + " is newer than this program, which reads up to format " +
           std::to_string(format_version) + "; use a newer Bergamo");
  }

  std::string attribute(const char *name) const
  {
    const Handle attribute(H5Aopen(*hdf5, name, H5P_DEFAULT), H5Aclose);
    if (!attribute.valid())
      fail_damaged();
    const Handle type(H5Aget_type(attribute), H5Tclose);
    std::string text(H5Tget_size(type), '\0');
    if (H5Tget_class(type) != H5T_STRING || H5Aread(attribute, type, text.data()) < 0)
      fail_damaged();
    text.pop_back();
    return text;
  }

  Handle open(const std::string &name) const
  {
    Handle data(H5Dopen2(*hdf5, name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!data.valid())
      fail("it has no '" + name + "'; take a file that this version of the program wrote");
    return data;
  }

  /// Number of values of the array `data`, 1 of a scalar. Checks that it holds what is asked for.
  std::size_t length(const hid_t data, const std::string &name, const H5T_class_t type_class, const int rank) const
  {
    const Handle type(H5Dget_type(data), H5Tclose);
    const Handle space(H5Dget_space(data), H5Sclose);
    if (H5Tget_class(type) != type_class || H5Sget_simple_extent_ndims(space) != rank)
      fail("'" + name + "' is no " + (rank == 1 ? "array of " : "single ") +
           (type_class == H5T_FLOAT     ? "floating point value"
            : type_class == H5T_INTEGER ? "integer"
                                        : "text") +
           "s; take a file that this version of the program wrote");
    return H5Sget_simple_extent_npoints(space);
  }

  template <class Value>
  static constexpr H5T_class_t class_of = std::same_as<Value, double> ? H5T_FLOAT : H5T_INTEGER;

  template <class Value>
  void read(const hid_t data, const std::span<Value> values) const
  {
    const hid_t type = std::same_as<Value, double> ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT64;
    if (!values.empty() && H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
      fail_damaged();
  }

  template <class Value>
  Value read_scalar(const std::string &name) const
  {
    const Quiet quiet;
    const Handle data = open(name);
    length(data, name, class_of<Value>, 0);
    Value value;
    read(data, std::span<Value>(&value, 1));
    return value;
  }

  template <class Value>
  std::vector<Value> read_array(const std::string &name) const
  {
    const Quiet quiet;
    const Handle data = open(name);
    std::vector<Value> values(length(data, name, class_of<Value>, 1));
    read(data, std::span<Value>(values));
    return values;
  }

  template <class Value>
  void read_array_into(const std::string &name, const std::span<Value> values) const
  {
    const Quiet quiet;
    const Handle data = open(name);
    const std::size_t n = length(data, name, class_of<Value>, 1);
    if (n != values.size())
      fail("'" + name + "' has " + std::to_string(n) + " values where " + std::to_string(values.size()) +
           " belong; take the file that belongs to this run");
    read(data, values);
  }
};

ArchiveReader::ArchiveReader(const std::filesystem::path &path, const std::string &kind)
    : state_(std::make_unique<State>())
{
  state_->path = path;
  state_->check_seal();

  const Quiet quiet;
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_sec2(access);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  H5Pset_file_locking(access, false, true); // archives are replaced whole, never changed in place
  Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose);
  if (!file.valid())
    state_->fail_damaged();
  state_->hdf5.emplace(std::move(file));
  if (state_->attribute("format") != "bergamo")
    state_->fail_damaged();
  if (const std::string found = state_->attribute("kind"); found != kind)
    state_->fail("it holds a '" + found + "' where a '" + kind + "' is asked for; name the right file");
}

ArchiveReader::~ArchiveReader()
{
  const Quiet quiet;
  state_.reset();
}

bool ArchiveReader::has(const std::string &name) const
{
  const Quiet quiet;
  return Handle(H5Dopen2(*state_->hdf5, name.c_str(), H5P_DEFAULT), H5Dclose).valid();
}

std::vector<double> ArchiveReader::read_doubles(const std::string &name) const
{
  return state_->read_array<double>(name);
}

std::vector<std::int64_t> ArchiveReader::read_integers(const std::string &name) const
{
  return state_->read_array<std::int64_t>(name);
}

double ArchiveReader::read_double(const std::string &name) const
{
  return state_->read_scalar<double>(name);
}

std::int64_t ArchiveReader::read_integer(const std::string &name) const
{
  return state_->read_scalar<std::int64_t>(name);
}

std::string ArchiveReader::read_text(const std::string &name) const
{
  const Quiet quiet;
  const Handle data = state_->open(name);
  state_->length(data, name, H5T_STRING, 0);
  const Handle type(H5Dget_type(data), H5Tclose);
  std::string text(H5Tget_size(type), '\0');
  if (H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) < 0)
    state_->fail_damaged();
  text.pop_back();
  return text;
}

void ArchiveReader::read_into(const std::string &name, const std::span<double> values) const
{
  state_->read_array_into(name, values);
}

void ArchiveReader::read_into(const std::string &name, const std::span<std::int64_t> values) const
{
  state_->read_array_into(name, values);
}

} // namespace bergamo
