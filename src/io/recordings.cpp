// SPDX-License-Identifier: Apache-2.0
#include "io/recordings.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <system_error>

#include "io/byte_source.h"
#include "io/simrad/raw_format.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

RawFormat format_of(const fs::path& file) {
  const auto source = open_file(file);
  return source ? simrad::detect_format(**source).value_or(RawFormat::unknown) : RawFormat::unknown;
}

bool begins_as_recording(const fs::path& file) {
  const RawFormat format = format_of(file);
  return format != RawFormat::unknown && format != RawFormat::other_netcdf;
}

}  // namespace

bool has_ending(const fs::path& file, std::string_view ending) {
  const std::string own = file.extension().string();
  return std::equal(own.begin(), own.end(), ending.begin(), ending.end(),
                    [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; });
}

bool is_named_raw(const fs::path& file) { return has_ending(file, ".raw"); }

bool is_named_recording(const fs::path& file) {
  return is_named_raw(file) || (has_ending(file, ".nc") && format_of(file) == RawFormat::sonar_netcdf4);
}

bool is_recording(const fs::path& file) {
  std::error_code absent;
  const auto size = fs::file_size(file, absent);
  return !absent && size > 0 && (is_named_raw(file) || begins_as_recording(file));
}

bool holds_recordings(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (is_named_raw(it->path()) && begins_as_recording(it->path())) return true;
  }
  return false;
}

}  // namespace sonar
