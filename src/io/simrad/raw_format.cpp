// SPDX-License-Identifier: Apache-2.0
#include "io/simrad/raw_format.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

#include "io/simrad/datagram.h"
#include "io/simrad/fields.h"

namespace sonar::simrad {
namespace {

bool is_netcdf(std::span<const std::byte> head) {
  constexpr std::array<unsigned char, 4> hdf5{0x89, 'H', 'D', 'F'};
  return head.size() >= 4 && (std::memcmp(head.data(), hdf5.data(), 4) == 0 ||
                              (std::memcmp(head.data(), "CDF", 3) == 0 && number_at<std::uint8_t>(head, 3) <= 5));
}

}  // namespace

Result<RawFormat> detect_format(const ByteSource& source) {
  std::array<std::byte, kHeadBytes> head{};
  const auto got = source.read(0, head);
  if (!got) return pass_on(got);
  const auto bytes = std::span<const std::byte>(head).first(*got);
  if (is_netcdf(bytes)) return RawFormat::sonar_netcdf4;
  if (inspect_head(bytes) != Frame::sound) return RawFormat::unknown;
  return std::memcmp(head.data() + 4, "XML0", 4) == 0 ? RawFormat::ek80 : RawFormat::simrad;
}

Result<bool> is_sonar_netcdf4(const ByteSource& source) {
  constexpr std::size_t kLooked = std::size_t{1} << 20U;
  const auto format = detect_format(source);
  if (!format) return pass_on(format);
  if (*format != RawFormat::sonar_netcdf4) return false;
  std::string bytes(kLooked, '\0');
  const auto got = source.read(0, std::as_writable_bytes(std::span(bytes)));
  if (!got) return pass_on(got);
  bytes.resize(*got);
  return bytes.find("SONAR-netCDF4") != std::string::npos || bytes.find("sonar_convention") != std::string::npos;
}

}  // namespace sonar::simrad
