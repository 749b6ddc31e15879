// SPDX-License-Identifier: Apache-2.0
#include "io/simrad/raw_format.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <set>
#include <span>
#include <string>

#include "io/simrad/datagram.h"
#include "io/simrad/fields.h"
#include "io/simrad/scanner.h"

namespace sonar::simrad {
namespace {

bool is_netcdf(std::span<const std::byte> head) {
  constexpr std::array<unsigned char, 4> hdf5{0x89, 'H', 'D', 'F'};
  return head.size() >= 4 && (std::memcmp(head.data(), hdf5.data(), 4) == 0 ||
                              (std::memcmp(head.data(), "CDF", 3) == 0 && number_at<std::uint8_t>(head, 3) <= 5));
}

Result<RawFormat> which_netcdf(const ByteSource& source) {
  constexpr std::size_t kLooked = std::size_t{1} << 20U;
  std::string bytes(kLooked, '\0');
  const auto got = source.read(0, std::as_writable_bytes(std::span(bytes)));
  if (!got) return pass_on(got);
  bytes.resize(*got);
  const bool says_so =
      bytes.find("SONAR-netCDF4") != std::string::npos || bytes.find("sonar_convention") != std::string::npos;
  return says_so ? RawFormat::sonar_netcdf4 : RawFormat::other_netcdf;
}

}  // namespace

Result<RawFormat> detect_format(const ByteSource& source) {
  std::array<std::byte, kHeadBytes> head{};
  const auto got = source.read(0, head);
  if (!got) return pass_on(got);
  const auto bytes = std::span<const std::byte>(head).first(*got);
  if (is_netcdf(bytes)) return which_netcdf(source);
  if (inspect_head(bytes) != Frame::sound) return RawFormat::unknown;
  return std::memcmp(head.data() + 4, "XML0", 4) == 0 ? RawFormat::ek80 : RawFormat::simrad;
}

std::string_view why_not_read(RawFormat format) {
  if (format == RawFormat::sonar_netcdf4) return "a netCDF file (SONAR-netCDF4); this version does not read it";
  if (format == RawFormat::other_netcdf)
    return "a netCDF file, but no recording: it does not say that it is SONAR-netCDF4";
  return {};
}

Result<std::int64_t> ek80_channels(const ByteSource& source) {
  constexpr std::size_t kNameBytes = 128;
  constexpr std::size_t kMostChannels = 1000;
  std::set<std::string> names;
  const auto take_in = [&](const Datagram& datagram) {
    if (datagram.type != "RAW3" || datagram.body.size() < kNameBytes || names.size() >= kMostChannels) return;
    names.insert(text_at(datagram.body, 0, kNameBytes));
  };
  Scanner scanner;
  Notes notes;  // the index has told them
  if (auto scanned = scanner.scan(source, take_in, notes); !scanned) return pass_on(scanned);
  if (auto scanned = scanner.finish(source, take_in, notes); !scanned) return pass_on(scanned);
  return static_cast<std::int64_t>(names.size());
}

}  // namespace sonar::simrad
