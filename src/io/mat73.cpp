#include "io/mat73.hpp"

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "io/fence.hpp"
#include "io/mat_pipe.hpp"
#include "io/text.hpp"

namespace hysteron {
namespace {

constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";
// The file is followed by so many bytes of a pattern: reading past its end gives something else each time.
constexpr std::size_t behind_the_end = 1U << 16U;
// Of one variable. Far above any recording.
constexpr hsize_t largest_variable = hsize_t{2} << 30U;

struct Unreadable {};  // of one variable

// An identifier of the library, closed at the end of its life; one that is none is Unreadable.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {
    if (id_ < 0) throw Unreadable{};
  }
  ~Handle() { close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): it stands for the identifier

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void expect(bool good) {
  if (!good) throw Unreadable{};
}

// A text attribute of fixed or variable length, however it is padded; nothing when it is not there.
std::optional<std::string> text_attribute(hid_t object, const char* name) {
  const htri_t there = H5Aexists(object, name);
  expect(there >= 0);
  if (there == 0) return std::nullopt;
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute), H5Tclose);
  expect(H5Tget_class(type) == H5T_STRING);
  const Handle space(H5Aget_space(attribute), H5Sclose);
  expect(H5Sget_simple_extent_npoints(space) == 1);
  std::string text;
  if (H5Tis_variable_str(type) > 0) {
    char* value = nullptr;
    expect(H5Aread(attribute, type, static_cast<void*>(&value)) >= 0);
    if (value != nullptr) text = value;
    H5free_memory(value);
  } else {
    const std::size_t size = H5Tget_size(type);
    expect(size > 0 && size < 4096);
    text.resize(size);
    expect(H5Aread(attribute, type, text.data()) >= 0);
  }
  text.resize(std::min(text.size(), text.find('\0')));
  return std::string(trimmed(text));
}

bool has_attribute(hid_t object, const char* name) {
  const htri_t there = H5Aexists(object, name);
  expect(there >= 0);
  return there > 0;
}

// The layout names bytes of this file only, all of them written and none behind its end.
void check_storage(hid_t dataset, hid_t type, hsize_t count, std::size_t file_size) {
  const Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  expect(H5Pget_external_count(creation) == 0);
  const hsize_t bytes = count * H5Tget_size(type);
  const H5D_layout_t layout = H5Pget_layout(creation);
  if (layout == H5D_COMPACT) return;
  if (layout == H5D_CONTIGUOUS) {
    const haddr_t at = H5Dget_offset(dataset);
    expect(at != HADDR_UNDEF && at <= file_size && H5Dget_storage_size(dataset) == bytes && bytes <= file_size - at);
    return;
  }
  expect(layout == H5D_CHUNKED);
  const Handle space(H5Dget_space(dataset), H5Sclose);
  std::array<hsize_t, 2> size{1, 1};
  std::array<hsize_t, 2> chunk{1, 1};
  const int rank = H5Sget_simple_extent_ndims(space);
  expect(rank >= 1 && rank <= 2 && H5Sget_simple_extent_dims(space, size.data(), nullptr) == rank);
  expect(H5Pget_chunk(creation, rank, chunk.data()) == rank && chunk[0] > 0 && chunk[1] > 0);
  // What is not stored would read as a fill value.
  hsize_t chunks = 0;
  expect(H5Dget_num_chunks(dataset, space, &chunks) >= 0);
  expect(chunks == (1 + (size[0] - 1) / chunk[0]) * (1 + (size[1] - 1) / chunk[1]));
  for (hsize_t k = 0; k < chunks; ++k) {
    std::array<hsize_t, 2> offset{};
    unsigned filters = 0;
    haddr_t at = HADDR_UNDEF;
    hsize_t length = 0;
    expect(H5Dget_chunk_info(dataset, space, k, offset.data(), &filters, &at, &length) >= 0);
    expect(at != HADDR_UNDEF && at <= file_size && length <= file_size - at);
  }
}

// Numbers, or the units of a text.
void read_dataset(hid_t dataset, MatVariable& variable, std::size_t file_size) {
  const std::string array_class = text_attribute(dataset, "MATLAB_class").value_or("");
  const Handle type(H5Dget_type(dataset), H5Tclose);
  const Handle space(H5Dget_space(dataset), H5Sclose);
  const H5T_class_t number = H5Tget_class(type);
  const int rank = H5Sget_simple_extent_ndims(space);
  variable.complex = number == H5T_COMPOUND;
  if (array_class == "cell" || array_class == "function_handle" || array_class == "struct") return;
  if (number != H5T_INTEGER && number != H5T_FLOAT && !variable.complex) return;
  if (rank < 1 || rank > 2) return;
  std::array<hsize_t, 2> size{1, 1};
  expect(H5Sget_simple_extent_dims(space, rank == 1 ? size.data() + 1 : size.data(), nullptr) == rank);
  variable.kind = array_class == "char" ? MatVariable::Kind::text : MatVariable::Kind::numbers;
  // An empty array is stored as its size.
  const bool empty = has_attribute(dataset, "MATLAB_empty");
  if (empty || variable.complex) return;
  // HDF5 counts by rows, MATLAB by columns.
  variable.columns = size[0];
  variable.rows = size[1];
  expect(size[0] == 0 || size[1] <= largest_variable / sizeof(double) / size[0]);
  const hsize_t count = size[0] * size[1];
  if (count == 0) return;
  check_storage(dataset, type, count, file_size);
  variable.values.assign(count, std::numeric_limits<double>::quiet_NaN());
  expect(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, variable.values.data()) >= 0);
  if (variable.kind == MatVariable::Kind::text) {
    std::vector<std::uint32_t> units;
    for (const double value : variable.values) {
      expect(value >= 0 && value <= 65535);
      units.push_back(static_cast<std::uint32_t>(value));
    }
    const std::string text = utf8_of_utf16(units);
    variable.text = trimmed(std::string_view(text).substr(0, text.find('\0')));
    variable.values.clear();
    variable.rows = variable.columns = 0;
  }
}

extern "C" herr_t take_name(hid_t /*group*/, const char* name, const H5L_info_t* info, void* names) {
  // Soft and external links lead elsewhere, also to other files.
  if (info->type == H5L_TYPE_HARD) static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

std::vector<std::string> names_in(hid_t group) {
  std::vector<std::string> names;
  hsize_t at = 0;
  expect(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, &at, take_name, &names) >= 0);
  return names;
}

void read_object(hid_t group, const std::string& name, MatVariable& variable, std::size_t file_size, bool with_fields) {
  const Handle object(H5Oopen(group, name.c_str(), H5P_DEFAULT), H5Oclose);
  const H5I_type_t what = H5Iget_type(object);
  if (what == H5I_DATASET) {
    read_dataset(object, variable, file_size);
  } else if (what == H5I_GROUP && with_fields) {
    variable.kind = MatVariable::Kind::texts;
    if (lower_case(name) != "units" && lower_case(name) != "unit") return;
    for (const std::string& field_name : names_in(object)) {
      MatVariable field;
      read_object(object, field_name, field, file_size, false);
      variable.fields.emplace_back(field_name,
                                   field.kind == MatVariable::Kind::text ? std::optional(field.text) : std::nullopt);
    }
  }
}

// A copy of the bytes as a file.
hid_t open_image(std::string_view bytes) {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  expect(H5Pset_fapl_core(access, 1U << 20U, 0) >= 0);
  expect(H5Pset_file_image(access, const_cast<char*>(bytes.data()), bytes.size()) >= 0);
  return H5Fopen("recording.mat", H5F_ACC_RDONLY, access);
}

std::string read_all(std::string_view bytes, char pattern) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  // No library a file names as its filter is loaded, and no buffer is used again with what was in it.
  H5PLset_loading_state(0);
  H5set_free_list_limits(0, 0, 0, 0, 0, 0);
  std::string piped;
  try {
    // As it is, for the library's own check of the file's length.
    { const Handle file(open_image(bytes), H5Fclose); }
    std::string longer(bytes);
    longer.append(behind_the_end, pattern);
    const Handle file(open_image(longer), H5Fclose);
    for (const std::string& name : names_in(file)) {
      if (name.starts_with('#')) continue;  // what variables refer to
      MatVariable variable;
      try {
        read_object(file, name, variable, bytes.size(), true);
      } catch (const Unreadable&) {
        variable = {};
        variable.damaged = true;
      }
      variable.name = name;
      append_piped(piped, variable);
    }
  } catch (const Unreadable&) {
    throw MatDamage("");  // leaves the process with a failure
  }
  return piped;
}

}  // namespace

bool is_mat73(std::string_view bytes) {
  for (std::size_t at = 0; at + signature.size() <= bytes.size(); at = at == 0 ? 512 : 2 * at) {
    if (bytes.substr(at, signature.size()) == signature) return true;
  }
  return false;
}

std::vector<MatVariable> read_mat73(std::string_view bytes) {
  FenceLimits limits;
  limits.memory += 4 * bytes.size();
  const auto first = behind_fence([&] { return read_all(bytes, '\x00'); }, limits, 0x5A);
  if (!first) throw MatDamage("the file cannot be read, it is cut off or damaged");
  const auto second = behind_fence([&] { return read_all(bytes, '\xFF'); }, limits, 0xA5);
  if (first != second) throw MatDamage("values are named that are not in the file, it is cut off or damaged");
  return read_piped(*first);
}

}  // namespace hysteron
