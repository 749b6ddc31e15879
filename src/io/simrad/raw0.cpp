// SPDX-License-Identifier: Apache-2.0
#include "io/simrad/raw0.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string_view>

#include "io/simrad/fields.h"

namespace sonar::simrad {
namespace {

static_assert(kMaxSamples == 1048576, "as a message says");

// A quarter of the shortest and of the longest pulse of any echo sounder, with room; and sound in water, with room.
constexpr double kLeastInterval_s = 1e-6;
constexpr double kMostInterval_s = 0.02;
constexpr double kLeastSpeed_mps = 1000.0;
constexpr double kMostSpeed_mps = 2000.0;

Raw0 unusable(Raw0 raw, const char* problem, DiagnosticCode code) {
  raw.problem = problem;
  raw.code = code;
  raw.power = {};
  return raw;
}

/// No sea is so deep and no sonar sees so far.
constexpr double kLargestSeabed_m = 1e6;

/// Bytes that mode and count promise after the header.
std::int64_t promised_bytes(int mode, std::int64_t count) {
  std::int64_t bytes = 0;
  if ((mode & 1) != 0) bytes += 2 * count;
  if ((mode & 2) != 0) bytes += 2 * count;
  if ((mode & 8) != 0) bytes += 8 * count * ((mode >> 8) & 7);
  return bytes;
}

bool begins_with(std::span<const std::byte> bytes, std::string_view mark) {
  const std::span wanted = std::as_bytes(std::span(mark));
  return bytes.size() >= wanted.size() && std::equal(wanted.begin(), wanted.end(), bytes.begin());
}

ReducedRow reduced_row_at(std::span<const std::byte> bytes, std::size_t at, bool with_open) {
  ReducedRow row;
  row.background_db = number_at<float>(bytes, at);
  row.seabed_sample = std::clamp(number_at<std::int32_t>(bytes, at + 4), 0, kMaxSamples);
  row.recorded_samples = std::clamp(number_at<std::int32_t>(bytes, at + 8), 0, kMaxSamples);
  if (!with_open) return row;
  row.open_first = std::clamp(number_at<std::int32_t>(bytes, at + 12), 0, kMaxSamples);
  row.open_end = std::clamp(number_at<std::int32_t>(bytes, at + 16), 0, kMaxSamples);
  return row;
}

/// What of a whole beam stands first in the extension of reduced files; rest goes on behind it.
std::optional<ReducedRow> parse_reduced_row(std::span<const std::byte>& rest) {
  const bool earlier = begins_with(rest, kReducedMark1);
  const std::size_t bytes = kReducedBytes - (earlier ? kOpenBytes : 0);
  if (rest.size() < bytes || !(earlier || begins_with(rest, kReducedMark))) return std::nullopt;
  const ReducedRow row = reduced_row_at(rest, 4, !earlier);
  rest = rest.subspan(bytes);
  return row;
}

/// Bytes of the water's levels, head included; 0 where there are none. Levels of earlier files are passed over.
std::size_t reduced_water_bytes(std::span<const std::byte> rest) {
  const auto number = [&](std::size_t at) {
    return static_cast<std::size_t>(std::clamp(number_at<std::int32_t>(rest, at), 0, kMaxSamples));
  };
  std::size_t bytes = 0;
  if (rest.size() >= kReducedWaterHeadBytes && begins_with(rest, kReducedWaterMark)) {
    bytes = kReducedWaterHeadBytes + 4 * number(16) + 4 * number(20) + 12 * number(24) + number(28);
  } else if (rest.size() >= kReducedWaterHeadBytes3 && begins_with(rest, kReducedWaterMark3)) {
    bytes = kReducedWaterHeadBytes3 + 4 * number(12) + 4 * number(16) + 12 * number(20) + number(24);
  } else if (rest.size() >= kReducedWaterHeadBytes2 && begins_with(rest, kReducedWaterMark2)) {
    bytes = kReducedWaterHeadBytes2 + 4 * number(12) + 4 * number(16) + 12 * number(20);
  } else if (rest.size() >= kReducedWaterHeadBytes1 && begins_with(rest, kReducedWaterMark1)) {
    bytes = kReducedWaterHeadBytes1 + 2 * number(8);
  }
  return std::min(bytes, rest.size());
}

/// The water's levels; none where they are not there whole.
std::optional<WaterLevels> parse_reduced_water(std::span<const std::byte> rest) {
  if (!begins_with(rest, kReducedWaterMark) || rest.size() < kReducedWaterHeadBytes) return std::nullopt;
  const auto number = [&](std::size_t at) { return number_at<std::int32_t>(rest, at); };
  const std::array<std::int32_t, 4> counts{number(16), number(20), number(24), number(28)};
  for (const std::int32_t count : counts) {
    if (count < 0 || count > kMaxSamples) return std::nullopt;
  }
  WaterLevels water;
  water.block_samples = number(4);
  water.blocks = number(8);
  water.places = number(12);
  water.stretch.resize(static_cast<std::size_t>(counts[0]));
  water.level.resize(static_cast<std::size_t>(counts[1]));
  water.reach.resize(water.level.size());
  water.cells.resize(static_cast<std::size_t>(counts[2]));
  water.patch.resize(static_cast<std::size_t>(counts[3]));
  const std::size_t wanted = kReducedWaterHeadBytes + 4 * water.stretch.size() + 4 * water.level.size() +
                             12 * water.cells.size() + water.patch.size();
  if (rest.size() < wanted) return std::nullopt;
  std::size_t at = kReducedWaterHeadBytes;
  const auto next = [&]<class T>(T& value) {
    value = number_at<T>(rest, at);
    at += sizeof(T);
  };
  for (float& stretch : water.stretch) next(stretch);
  for (std::int16_t& count : water.level) next(count);
  for (std::int16_t& count : water.reach) next(count);
  for (EchoCell& cell : water.cells) {
    next(cell.row);
    next(cell.block);
    next(cell.evidence);
  }
  for (std::int8_t& steps : water.patch) next(steps);
  return water;
}

/// The beams that were left out and end early, as far as they are there.
std::vector<ReducedChannel> parse_reduced_short(std::span<const std::byte> rest) {
  std::vector<ReducedChannel> out;
  const bool earlier = begins_with(rest, kReducedShortMark1);
  const std::size_t bytes = kReducedShortBytes - (earlier ? kOpenBytes : 0);
  if (rest.size() < kReducedShortHeadBytes || !(earlier || begins_with(rest, kReducedShortMark))) return out;
  const auto told = static_cast<std::size_t>(std::max(number_at<std::int32_t>(rest, 4), 0));
  rest = rest.subspan(kReducedShortHeadBytes);
  const std::size_t count = std::min(told, rest.size() / bytes);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = i * bytes;
    const auto number = number_at<std::int32_t>(rest, at);
    // RAW0 itself can name no other.
    if (number < 1 || number > std::numeric_limits<std::int16_t>::max()) continue;
    out.push_back({number - 1, reduced_row_at(rest, at + 4, !earlier)});
  }
  return out;
}

/// The plane, where it makes sense.
std::optional<ReducedSeabed> parse_reduced_seabed(std::span<const std::byte> rest) {
  if (rest.size() < kReducedSeabedBytes || !begins_with(rest, kReducedSeabedMark)) return std::nullopt;
  std::array<double, 7> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = number_at<double>(rest, 4 + 8 * i);
    if (!(std::abs(values[i]) < kLargestSeabed_m)) return std::nullopt;
  }
  return ReducedSeabed{values[0], values[1], values[2], values[3], values[4], values[5], values[6]};
}

/// The extension of reduced files, where there is one.
std::optional<ReducedRecord> parse_reduced(std::span<const std::byte> rest) {
  const auto row = parse_reduced_row(rest);
  if (!row) return std::nullopt;
  ReducedRecord record{*row};
  if (begins_with(rest, kReducedSeabedMark)) {
    record.seabed = parse_reduced_seabed(rest);
    rest = rest.subspan(std::min(rest.size(), kReducedSeabedBytes));
  }
  record.water = parse_reduced_water(rest);
  rest = rest.subspan(reduced_water_bytes(rest));
  record.short_beams = parse_reduced_short(rest);
  return record;
}

}  // namespace

Raw0 parse_raw0(std::span<const std::byte> body) {
  Raw0 raw;
  if (body.size() < kRaw0HeadBytes) {
    return unusable(raw, "RAW0 body is shorter than its 72-byte header", DiagnosticCode::bad_sample_counts);
  }
  ChannelPing& head = raw.head;
  head.channel = number_at<std::int16_t>(body, 0) - 1;
  head.mode = number_at<std::int16_t>(body, 2);
  head.transducer_depth_m = float_at(body, 4);
  head.frequency_hz = float_at(body, 8);
  head.transmit_power_w = float_at(body, 12);
  head.pulse_length_s = float_at(body, 16);
  head.bandwidth_hz = float_at(body, 20);
  head.sample_interval_s = float_at(body, 24);
  head.sound_speed_mps = float_at(body, 28);
  head.absorption_db_per_m = float_at(body, 32);
  head.heave_m = float_at(body, 36);
  head.roll_deg = float_at(body, 40);
  head.pitch_deg = float_at(body, 44);
  head.temperature_c = float_at(body, 48);
  head.heading_deg = float_at(body, 52);
  const auto transmit_mode = number_at<std::int16_t>(body, 56);
  head.offset = number_at<std::int32_t>(body, 64);
  const auto count = number_at<std::int32_t>(body, 68);
  head.transmit_mode = transmit_mode;
  // Old files have trawl data in these bytes; two flags of 0 or 1 make a heading that is 0 or next to it.
  const bool trawl =
      head.heading_deg != 0.0 && head.heading_deg < static_cast<double>(std::numeric_limits<float>::min());
  if (trawl || !(head.heading_deg >= 0.0 && head.heading_deg < 360.0) || transmit_mode < -1 || transmit_mode > 2) {
    head.heading_deg = 0.0;
    head.transmit_mode = -1;
  }
  for (double* value : {&head.heave_m, &head.roll_deg, &head.pitch_deg, &head.transducer_depth_m}) {
    if (std::isnan(*value) || std::abs(*value) > 1000.0) {
      *value = 0.0;
      raw.bad_attitude = true;
    }
  }
  if (head.offset > kMaxSamples || count > kMaxSamples - std::max(head.offset, 0)) {
    return unusable(raw, "more samples than the 1048576 that are read of a channel", DiagnosticCode::bad_sample_counts);
  }
  if (head.offset < 0 || count < 0 ||
      promised_bytes(head.mode, count) > static_cast<std::int64_t>(body.size() - kRaw0HeadBytes)) {
    return unusable(raw, "offset and count do not fit the body", DiagnosticCode::bad_sample_counts);
  }
  if (!(head.sample_interval_s >= kLeastInterval_s && head.sample_interval_s <= kMostInterval_s)) {
    return unusable(raw, "the sample interval is impossible, 1e-6 to 0.02 s were expected", DiagnosticCode::bad_value);
  }
  if (!(head.sound_speed_mps >= kLeastSpeed_mps && head.sound_speed_mps <= kMostSpeed_mps)) {
    return unusable(raw, "the sound speed is impossible, 1000 to 2000 m/s were expected", DiagnosticCode::bad_value);
  }
  if ((head.mode & 1) == 0) return unusable(raw, "no power samples in this mode", DiagnosticCode::no_power);
  raw.power = body.subspan(kRaw0HeadBytes, static_cast<std::size_t>(count) * 2);
  head.reduced =
      parse_reduced(body.subspan(kRaw0HeadBytes + static_cast<std::size_t>(promised_bytes(head.mode, count))));
  return raw;
}

}  // namespace sonar::simrad
