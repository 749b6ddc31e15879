// SPDX-License-Identifier: Apache-2.0
#include "io/netcdf_library_reader.h"

#include <fmt/format.h>
#include <netcdf.h>
#include <netcdf_mem.h>

#include <array>
#include <limits>
#include <utility>

namespace sonar::netcdf {
namespace {

/// A text is a reference of 16 bytes that hardly shrinks, and takes more than that in memory.
constexpr std::size_t kBytesOfText = 64;

bool is_text(nc_type type) { return type == NC_STRING || type == NC_CHAR; }

template <class T>
int get(int group, int variable, T* values) {
  if constexpr (std::is_same_v<T, double>) return nc_get_var_double(group, variable, values);
  if constexpr (std::is_same_v<T, float>) return nc_get_var_float(group, variable, values);
  if constexpr (std::is_same_v<T, std::int32_t>) return nc_get_var_int(group, variable, values);
  if constexpr (std::is_same_v<T, std::uint8_t>) return nc_get_var_uchar(group, variable, values);
}

}  // namespace

LibraryReader::LibraryReader(std::vector<std::byte> file)
    : lock_(lock()), bytes_(std::move(file)), file_size_(bytes_.size()), bytes_left_(file_size_ * kBytesPerByte) {
  const int status = nc_open_mem("file", NC_NOWRITE, bytes_.size(), bytes_.data(), &file_);
  if (status != NC_NOERR) {
    file_ = -1;
    refuse(ErrorCode::format, fmt::format("is no sound netCDF file ({})", nc_strerror(status)));
  }
}

LibraryReader::~LibraryReader() {
  if (file_ >= 0) nc_close(file_);
}

void LibraryReader::refuse(ErrorCode code, std::string text) {
  if (status_) status_ = fail(code, std::move(text));
}

bool LibraryReader::check(int status, std::string_view what) {
  if (!status_) return false;
  // What lies in another file cannot be read either, for none can be opened.
  const char* more = status == NC_EHDFERR ? ", or kept in another file" : "";
  if (status != NC_NOERR) refuse(ErrorCode::format, fmt::format("'{}': {}{}", what, nc_strerror(status), more));
  return status_.has_value();
}

int LibraryReader::find_group(int parent, const std::string& name) {
  int id = -1;
  if (!status_ || nc_inq_grp_ncid(parent, name.c_str(), &id) != NC_NOERR) return -1;
  return id;
}

bool LibraryReader::has_variable(int group, const std::string& name) {
  int id = -1;
  return status_ && nc_inq_varid(group, name.c_str(), &id) == NC_NOERR;
}

bool LibraryReader::has_attribute(int group, const std::string& name) {
  return status_ && nc_inq_att(group, NC_GLOBAL, name.c_str(), nullptr, nullptr) == NC_NOERR;
}

std::size_t LibraryReader::dimension(int group, const std::string& name) {
  int id = -1;
  std::size_t length = 0;
  if (!status_ || !check(nc_inq_dimid(group, name.c_str(), &id), name)) return 0;
  if (!check(nc_inq_dimlen(group, id, &length), name)) return 0;
  if (length > file_size_ * kBytesPerByte) {
    refuse(ErrorCode::format, fmt::format("dimension '{}' of {} is more than the file can hold", name, length));
    return 0;
  }
  return length;
}

bool LibraryReader::can_hold(std::size_t rows, std::size_t bytes_a_row) {
  if (bytes_a_row == 0 || rows <= bytes_left_ / bytes_a_row) return true;
  refuse(ErrorCode::format, fmt::format("{} values of {} bytes are more than the file can hold", rows, bytes_a_row));
  return false;
}

std::string LibraryReader::text(int group, const std::string& name) {
  nc_type type = NC_NAT;
  std::size_t length = 0;
  if (!status_ || !check(nc_inq_att(group, NC_GLOBAL, name.c_str(), &type, &length), name)) return {};
  if (type == NC_STRING) {
    const std::vector<std::string> all = texts(group, name);
    return all.empty() ? std::string{} : all.front();
  }
  if (type != NC_CHAR || length > file_size_) {
    refuse(ErrorCode::format, fmt::format("attribute '{}' is no text", name));
    return {};
  }
  std::string value(length, '\0');
  if (length > 0) check(nc_get_att_text(group, NC_GLOBAL, name.c_str(), value.data()), name);
  return value;
}

std::int64_t LibraryReader::whole(int group, const std::string& name) {
  nc_type type = NC_NAT;
  std::size_t length = 0;
  if (!status_ || !check(nc_inq_att(group, NC_GLOBAL, name.c_str(), &type, &length), name)) return 0;
  long long value = 0;
  if (is_text(type) || length != 1) {
    refuse(ErrorCode::format, fmt::format("attribute '{}' is no number", name));
  } else {
    check(nc_get_att_longlong(group, NC_GLOBAL, name.c_str(), &value), name);
  }
  return value;
}

std::vector<std::string> LibraryReader::texts(int group, const std::string& name) {
  nc_type type = NC_NAT;
  std::size_t length = 0;
  if (!status_ || !check(nc_inq_att(group, NC_GLOBAL, name.c_str(), &type, &length), name)) return {};
  if (length == 0) return {};
  if (type == NC_CHAR) return {text(group, name)};
  if (type != NC_STRING || length > file_size_) {
    refuse(ErrorCode::format, fmt::format("attribute '{}' is no text", name));
    return {};
  }
  std::vector<char*> pointers(length, nullptr);
  std::vector<std::string> values;
  if (!check(nc_get_att_string(group, NC_GLOBAL, name.c_str(), pointers.data()), name)) return {};
  for (const char* p : pointers) values.emplace_back(p != nullptr ? p : "");
  nc_free_string(length, pointers.data());
  return values;
}

int LibraryReader::find_variable(int group, const std::string& name) {
  int id = -1;
  if (status_) check(nc_inq_varid(group, name.c_str(), &id), name);
  return id;
}

std::vector<std::string> LibraryReader::variables(int group) {
  int count = 0;
  if (!status_ || !check(nc_inq_nvars(group, &count), "variables")) return {};
  std::vector<int> ids(static_cast<std::size_t>(count));
  if (!check(nc_inq_varids(group, &count, ids.data()), "variables")) return {};
  std::vector<std::string> names;
  for (const int id : ids) {
    std::array<char, NC_MAX_NAME + 1> name{};
    if (!check(nc_inq_varname(group, id, name.data()), "variables")) return {};
    names.emplace_back(name.data());
  }
  return names;
}

std::vector<std::string> LibraryReader::dimensions_of(int group, const std::string& variable) {
  const int id = find_variable(group, variable);
  int count = 0;
  std::array<int, NC_MAX_VAR_DIMS> ids{};
  if (!status_ || !check(nc_inq_var(group, id, nullptr, nullptr, &count, ids.data(), nullptr), variable)) return {};
  std::vector<std::string> names;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    std::array<char, NC_MAX_NAME + 1> name{};
    if (!check(nc_inq_dimname(group, ids[i], name.data()), variable)) return {};
    names.emplace_back(name.data());
  }
  return names;
}

std::string LibraryReader::text_of(int group, const std::string& variable, const std::string& name) {
  const int id = find_variable(group, variable);
  nc_type type = NC_NAT;
  std::size_t length = 0;
  if (!status_ || nc_inq_att(group, id, name.c_str(), &type, &length) != NC_NOERR) return {};
  if (type == NC_CHAR && length <= file_size_) {
    std::string value(length, '\0');
    if (length > 0) check(nc_get_att_text(group, id, name.c_str(), value.data()), name);
    return value;
  }
  if (type != NC_STRING || length != 1) return {};
  char* pointer = nullptr;
  if (!check(nc_get_att_string(group, id, name.c_str(), &pointer), name)) return {};
  std::string value(pointer != nullptr ? pointer : "");
  nc_free_string(1, &pointer);
  return value;
}

double LibraryReader::number_of(int group, const std::string& variable, const std::string& name) {
  const int id = find_variable(group, variable);
  nc_type type = NC_NAT;
  std::size_t length = 0;
  double value = std::numeric_limits<double>::quiet_NaN();
  if (!status_ || nc_inq_att(group, id, name.c_str(), &type, &length) != NC_NOERR) return value;
  if (is_text(type) || type > NC_STRING || length != 1) return value;
  check(nc_get_att_double(group, id, name.c_str(), &value), name);
  return value;
}

std::size_t LibraryReader::size(int group, const std::string& name) {
  const int id = find_variable(group, name);
  int count = 0;
  std::array<int, NC_MAX_VAR_DIMS> ids{};
  if (!status_ || !check(nc_inq_var(group, id, nullptr, nullptr, &count, ids.data(), nullptr), name)) return 0;
  std::uint64_t product = 1;
  for (int i = 0; i < count; ++i) {
    std::size_t length = 0;
    if (!check(nc_inq_dimlen(group, ids[static_cast<std::size_t>(i)], &length), name)) return 0;
    if (length != 0 && product > file_size_ * kBytesPerByte / length) {
      refuse(ErrorCode::format, fmt::format("'{}' has more values than the file can hold", name));
      return 0;
    }
    product *= length;
  }
  return product;
}

template <class T>
std::vector<T> LibraryReader::values(int group, const std::string& name, std::size_t expected) {
  const int id = find_variable(group, name);
  const std::size_t found = size(group, name);
  nc_type type = NC_NAT;
  if (!status_ || !check(nc_inq_vartype(group, id, &type), name)) return {};
  if (found != expected) {
    refuse(ErrorCode::format, fmt::format("'{}' has {} values where {} were expected", name, found, expected));
    return {};
  }
  constexpr bool kWantsText = std::is_same_v<T, std::string>;
  if (type > NC_STRING || (type == NC_STRING) != kWantsText || type == NC_CHAR) {
    refuse(ErrorCode::format, fmt::format("'{}' has another type than expected", name));
    return {};
  }
  if (expected == 0) return {};
  std::size_t width = 0;
  if (!check(nc_inq_type(group, type, nullptr, &width), name)) return {};
  if (kWantsText) width = kBytesOfText;
  if (!can_hold(expected, width)) return {};
  bytes_left_ -= expected * width;
  std::vector<T> out(expected);
  if constexpr (kWantsText) {
    std::vector<char*> pointers(expected, nullptr);
    if (!check(nc_get_var_string(group, id, pointers.data()), name)) return {};
    for (std::size_t i = 0; i < expected; ++i) out[i] = pointers[i] != nullptr ? pointers[i] : "";
    nc_free_string(expected, pointers.data());
  } else if constexpr (std::is_same_v<T, std::int64_t>) {
    std::vector<long long> wide(expected);
    if (!check(nc_get_var_longlong(group, id, wide.data()), name)) return {};
    out.assign(wide.begin(), wide.end());
  } else {
    if (!check(get(group, id, out.data()), name)) return {};
  }
  return out;
}

template std::vector<double> LibraryReader::values(int, const std::string&, std::size_t);
template std::vector<float> LibraryReader::values(int, const std::string&, std::size_t);
template std::vector<std::int64_t> LibraryReader::values(int, const std::string&, std::size_t);
template std::vector<std::int32_t> LibraryReader::values(int, const std::string&, std::size_t);
template std::vector<std::uint8_t> LibraryReader::values(int, const std::string&, std::size_t);
template std::vector<std::string> LibraryReader::values(int, const std::string&, std::size_t);

}  // namespace sonar::netcdf
