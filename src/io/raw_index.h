// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "base/result.h"
#include "base/shared_value.h"
#include "base/time.h"
#include "io/byte_source.h"
#include "io/nav_series.h"
#include "model/sounder.h"

namespace sonar {

/// Raised whenever RawIndex or what stands in it changes; an index of another version is made again.
inline constexpr int kIndexVersion = 8;

/// What a file's first bytes say it is.
enum class RawFormat : std::uint8_t {
  simrad,         ///< CON0/RAW0/NME0 ...: EK60, ME70, MS70; read
  ek80,           ///< XML0/RAW3: recognised, framing counted, samples not read
  sonar_netcdf4,  ///< HDF5 or classic netCDF that says so: recognised, not read
  other_netcdf,   ///< or another: a product, a depth raster
  unknown,
};
inline constexpr std::array<std::string_view, 5> kRawFormatNames{"simrad-raw", "simrad-ek80", "sonar-netcdf4", "netcdf",
                                                                 "unknown"};
[[nodiscard]] inline std::string_view name(RawFormat format) {
  return kRawFormatNames[static_cast<std::size_t>(format)];
}

/// How one channel was sent and sampled; a number that the file has not is 0.
struct ChannelTransmit {
  double frequency_hz = std::numeric_limits<double>::quiet_NaN();  ///< NaN = this channel was not seen
  double transmit_power_w = 0.0;
  double pulse_length_s = 0.0;
  double sample_interval_s = 0.0;
  double sound_speed_mps = 0.0;
  double absorption_db_per_m = 0.0;
  std::int32_t max_samples = 0;  ///< most samples of this channel while the setting held, offset included

  [[nodiscard]] bool seen() const { return frequency_hz == frequency_hz; }
};

/// Settings of all channels over a run of pings, [channel]; a change of frequency, power, pulse, sample interval or
/// (by more than 1e-4) sound speed begins another. Absorption is that of the channel's first ping in the run.
using TransmitSet = std::vector<ChannelTransmit>;

/// Where a ping lies and what its first channel says of the ship. Under 100 bytes.
struct PingEntry {
  TimeNs time = 0;
  std::uint64_t offset = 0;  ///< of its first RAW0
  std::uint64_t end = 0;     ///< after its last RAW0
  float roll_deg = 0.0F;     ///< positive port up
  float pitch_deg = 0.0F;    ///< positive bow up
  float heave_m = 0.0F;      ///< as recorded, positive down
  float heading_deg = 0.0F;  ///< 0 = absent
  float transducer_depth_m = 0.0F;
  std::int32_t min_samples = 0;  ///< over its channels, stored samples
  std::int32_t max_samples = 0;
  std::uint16_t channels = 0;         ///< how many channels it has
  std::uint16_t silent_channels = 0;  ///< how many of them did not transmit, or a test signal
  std::uint16_t odd_channels = 0;     ///< how many more were left out (odd_channels.h)
  std::uint16_t clock_run = 0;        ///< how often pings before it in the file went back in time
  bool reduced = false;               ///< a reduced file's: channels are left out on purpose
  bool all_beams = false;             ///< it has (nearly) all beams of its configuration
  std::uint16_t config = 0;           ///< index in RawIndex::configs
  std::uint16_t transmit = 0;         ///< index in RawIndex::transmits
};
static_assert(sizeof(PingEntry) < 100);

/// Everything about a raw file but its samples.
struct RawIndex {
  std::string name;  ///< path as the user named it
  std::uint64_t size = 0;
  /// Hexadecimal XXH3-128 of all bytes: the same under any name, another after any change.
  std::string hash;
  RawFormat format = RawFormat::unknown;
  std::map<std::string, std::int64_t> datagrams;  ///< sound datagrams by type, skipped ones included
  TimeNs first_datagram_time = 0;                 ///< 0 = no datagram
  TimeNs last_datagram_time = 0;
  /// Usually one; an empty one where samples came before any CON0. Files of one survey share theirs.
  std::vector<SharedValue<SounderConfig>> configs;
  std::vector<SharedValue<TransmitSet>> transmits;
  std::vector<PingEntry> pings;       ///< in file order
  std::vector<NavSeries> navigation;  ///< by quantity, talker and sentence, in order of appearance
  Diagnostics diagnostics;

  /// Whether anything of the file could be read.
  [[nodiscard]] bool readable() const { return format == RawFormat::simrad || format == RawFormat::ek80; }
  /// Whether its format's samples are read by this version.
  [[nodiscard]] bool gives_samples() const { return format == RawFormat::simrad; }
};

}  // namespace sonar
