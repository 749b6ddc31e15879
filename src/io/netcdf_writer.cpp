// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <hdf5.h>
#include <netcdf.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "base/hash.h"
#include "io/hdf5_image.h"
#include "io/netcdf_file.h"

namespace sonar::netcdf {
namespace {

/// About how many bytes of values make a chunk: enough for deflate to work on, small against memory.
constexpr std::size_t kChunkBytes = 1 << 18;

template <class T>
constexpr int nc_type_of() {
  if constexpr (std::is_same_v<T, double>) return NC_DOUBLE;
  if constexpr (std::is_same_v<T, float>) return NC_FLOAT;
  if constexpr (std::is_same_v<T, std::int64_t>) return NC_INT64;
  if constexpr (std::is_same_v<T, std::int32_t>) return NC_INT;
  if constexpr (std::is_same_v<T, std::int16_t>) return NC_SHORT;
  if constexpr (std::is_same_v<T, std::uint8_t>) return NC_UBYTE;
  return NC_STRING;
}

/// Whole rows of the trailing dimensions, as many as fit a chunk.
std::vector<std::size_t> chunk_shape(const std::vector<Dimension>& dimensions, std::size_t value_size) {
  std::vector<std::size_t> shape;
  std::size_t row = value_size;
  for (const Dimension& d : dimensions) shape.push_back(std::max<std::size_t>(1, d.length));
  for (std::size_t i = 1; i < shape.size(); ++i) row *= shape[i];
  if (!shape.empty()) shape[0] = std::clamp<std::size_t>(kChunkBytes / row, 1, shape[0]);
  return shape;
}

}  // namespace

std::unique_lock<std::mutex> lock() {
  static std::mutex mutex;
  std::unique_lock held(mutex);
  // HDF5 keeps files that it could not finish on a full disk, and breaks on them when it tidies up at the program's end.
  // Every sound file is closed by then.
  [[maybe_unused]] static const auto no_tidying = H5dont_atexit();
  // HDF5 prints its inner errors on standard error, thread by thread, unless told not to.
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  // Once here, not in each child that reads.
  [[maybe_unused]] static const auto begun = nc_initialize();
  return held;
}

Writer::Writer(std::string named) : lock_(lock()), named_(std::move(named)) {
  if (!check(nc_create(named_.c_str(), NC_NETCDF4 | NC_CLOBBER | NC_DISKLESS, &file_), "cannot create")) file_ = -1;
  if (file_ >= 0) {
    int old_mode = 0;
    check(nc_set_fill(file_, NC_NOFILL, &old_mode), "fill mode");
  }
}

Writer::~Writer() {
  if (file_ >= 0) nc_close(file_);
}

bool Writer::check(int status, std::string_view what) {
  if (status_ && status != NC_NOERR) {
    status_ = fail(ErrorCode::io, fmt::format("netCDF, {}: {}", what, nc_strerror(status)), {.file = named_});
  }
  return status_.has_value();
}

void Writer::refuse(Error error) {
  if (status_) status_ = tl::unexpected<Error>(std::move(error));
}

int Writer::group(int parent, const std::string& name) {
  int id = -1;
  if (status_) check(nc_def_grp(parent, name.c_str(), &id), name);
  return id;
}

Dimension Writer::dimension(int group, const std::string& name, std::size_t length) {
  Dimension d{-1, length};
  // A length of 0 means "unlimited" to netCDF, and then holds nothing: just what is meant.
  if (status_) check(nc_def_dim(group, name.c_str(), length, &d.id), name);
  return d;
}

void Writer::attribute(int group, int variable, const std::string& name, std::string_view text) {
  if (status_) check(nc_put_att_text(group, variable, name.c_str(), text.size(), text.data()), name);
}

void Writer::attribute(int group, int variable, const std::string& name, double value) {
  if (status_) check(nc_put_att_double(group, variable, name.c_str(), NC_DOUBLE, 1, &value), name);
}

void Writer::attribute(int group, int variable, const std::string& name, std::int64_t value) {
  const long long wide = value;
  if (status_) check(nc_put_att_longlong(group, variable, name.c_str(), NC_INT64, 1, &wide), name);
}

void Writer::attribute(int group, int variable, const std::string& name, const std::vector<std::string>& texts) {
  std::vector<const char*> pointers;
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  if (texts.empty()) {
    attribute(group, variable, name, std::string_view{});
  } else if (status_) {
    check(nc_put_att_string(group, variable, name.c_str(), pointers.size(), pointers.data()), name);
  }
}

int Writer::define(int group, const std::string& name, std::string_view unit, const std::vector<Dimension>& dimensions,
                   int type, std::size_t value_size, Storage storage) {
  int id = -1;
  if (!status_) return id;
  std::vector<int> ids;
  for (const Dimension& d : dimensions) ids.push_back(d.id);
  if (!check(nc_def_var(group, name.c_str(), type, static_cast<int>(ids.size()), ids.data(), &id), name)) return id;
  const bool empty =
      std::any_of(dimensions.begin(), dimensions.end(), [](const Dimension& d) { return d.length == 0; });
  if (empty) {
    // netCDF's own choice of chunks for an unlimited dimension is a megabyte of nothing.
    const std::vector<std::size_t> ones(dimensions.size(), 1);
    check(nc_def_var_chunking(group, id, NC_CHUNKED, ones.data()), name);
  } else if (storage == Storage::packed) {
    check(nc_def_var_chunking(group, id, NC_CHUNKED, chunk_shape(dimensions, value_size).data()), name);
    check(nc_def_var_deflate(group, id, value_size > 1 ? 1 : 0, 1, 1), name);
  }
  if (!unit.empty()) attribute(group, id, "units", unit);
  return id;
}

template <class T>
void Writer::numbers(int group, int variable, const std::string& name, const std::vector<T>& values) {
  if (status_) check(nc_put_att(group, variable, name.c_str(), nc_type_of<T>(), values.size(), values.data()), name);
}

template void Writer::numbers(int, int, const std::string&, const std::vector<std::int64_t>&);
template void Writer::numbers(int, int, const std::string&, const std::vector<std::uint8_t>&);

template <class T>
int Writer::variable(int group, const std::string& name, std::string_view unit,
                     const std::vector<Dimension>& dimensions, const std::vector<T>& values, Storage storage,
                     const T* missing) {
  const int id = define(group, name, unit, dimensions, nc_type_of<T>(), sizeof(T), storage);
  if (status_ && missing != nullptr) check(nc_def_var_fill(group, id, NC_FILL, missing), name);
  if (!status_ || values.empty()) return id;
  const std::vector<std::size_t> start(dimensions.size(), 0);
  std::vector<std::size_t> count;
  for (const Dimension& d : dimensions) count.push_back(d.length);
  if constexpr (std::is_same_v<T, std::string>) {
    std::vector<const char*> pointers;
    pointers.reserve(values.size());
    for (const std::string& text : values) pointers.push_back(text.c_str());
    check(nc_put_vara(group, id, start.data(), count.data(), pointers.data()), name);
  } else {
    check(nc_put_vara(group, id, start.data(), count.data(), values.data()), name);
  }
  return id;
}

template int Writer::variable(int, const std::string&, std::string_view, const std::vector<Dimension>&,
                              const std::vector<double>&, Storage, const double*);
template int Writer::variable(int, const std::string&, std::string_view, const std::vector<Dimension>&,
                              const std::vector<float>&, Storage, const float*);
template int Writer::variable(int, const std::string&, std::string_view, const std::vector<Dimension>&,
                              const std::vector<std::int64_t>&, Storage, const std::int64_t*);
template int Writer::variable(int, const std::string&, std::string_view, const std::vector<Dimension>&,
                              const std::vector<std::int32_t>&, Storage, const std::int32_t*);
template int Writer::variable(int, const std::string&, std::string_view, const std::vector<Dimension>&,
                              const std::vector<std::int16_t>&, Storage, const std::int16_t*);
template int Writer::variable(int, const std::string&, std::string_view, const std::vector<Dimension>&,
                              const std::vector<std::uint8_t>&, Storage, const std::uint8_t*);
template int Writer::variable(int, const std::string&, std::string_view, const std::vector<Dimension>&,
                              const std::vector<std::string>&, Storage, const std::string*);

template <class T>
int Writer::sliced_variable(int group, const std::string& name, std::string_view unit,
                            const std::vector<Dimension>& dimensions, const T* missing) {
  const int id = define(group, name, unit, dimensions, nc_type_of<T>(), sizeof(T), Storage::plain);
  if (!status_) return id;
  std::vector<std::size_t> chunk;
  for (const Dimension& d : dimensions) chunk.push_back(std::max<std::size_t>(1, d.length));
  chunk.front() = 1;
  check(nc_def_var_chunking(group, id, NC_CHUNKED, chunk.data()), name);
  check(nc_def_var_deflate(group, id, sizeof(T) > 1 ? 1 : 0, 1, 1), name);
  if (missing != nullptr) check(nc_def_var_fill(group, id, NC_FILL, missing), name);
  return id;
}

template <class T>
void Writer::slice(int group, int variable, std::size_t index, const std::vector<Dimension>& dimensions,
                   const std::vector<T>& values) {
  if (!status_) return;
  std::vector<std::size_t> start(dimensions.size(), 0);
  std::vector<std::size_t> count;
  for (const Dimension& d : dimensions) count.push_back(d.length);
  start.front() = index;
  count.front() = 1;
  check(nc_put_vara(group, variable, start.data(), count.data(), values.data()), "slice");
}

template int Writer::sliced_variable(int, const std::string&, std::string_view, const std::vector<Dimension>&,
                                     const std::int32_t*);
template void Writer::slice(int, int, std::size_t, const std::vector<Dimension>&, const std::vector<std::int32_t>&);
template int Writer::sliced_variable(int, const std::string&, std::string_view, const std::vector<Dimension>&,
                                     const std::int16_t*);
template void Writer::slice(int, int, std::size_t, const std::vector<Dimension>&, const std::vector<std::int16_t>&);
template int Writer::sliced_variable(int, const std::string&, std::string_view, const std::vector<Dimension>&,
                                     const std::uint8_t*);
template void Writer::slice(int, int, std::size_t, const std::vector<Dimension>&, const std::vector<std::uint8_t>&);

/// The bytes of the one file that HDF5 has open while we hold the lock.
Result<std::vector<std::byte>> Writer::image() {
  if (file_ >= 0) check(nc_sync(file_), "close");
  if (!status_) return pass_on(status_);
  hid_t open = H5I_INVALID_HID;
  const bool found = H5Fget_obj_ids(static_cast<hid_t>(H5F_OBJ_ALL), H5F_OBJ_FILE, 1, &open) == 1;
  const ssize_t size = found && H5Fflush(open, H5F_SCOPE_LOCAL) >= 0 ? H5Fget_file_image(open, nullptr, 0) : -1;
  std::vector<std::byte> bytes(static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
  if (size <= 0 || H5Fget_file_image(open, bytes.data(), bytes.size()) != size || !seal_superblock(bytes)) {
    return fail(ErrorCode::io, "netCDF, close: HDF5 does not give the file", {.file = named_});
  }
  return bytes;
}

Result<std::string> Writer::close_into(AtomicFile& file) {
  const auto bytes = image();
  if (!bytes) return pass_on(bytes);
  if (auto written = file.write({reinterpret_cast<const char*>(bytes->data()), bytes->size()}); !written) {
    return pass_on(written);
  }
  Hasher hasher;
  hasher.add(*bytes);
  return to_hex(hasher.value());
}

}  // namespace sonar::netcdf
