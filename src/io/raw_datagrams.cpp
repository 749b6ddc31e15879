// SPDX-License-Identifier: Apache-2.0
#include "io/raw_datagrams.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include "base/number_text.h"
#include "io/simrad/raw0.h"

namespace sonar {
namespace {

template <class T>
void put(RawBytes& out, T value) {
  using Words = std::conditional_t<sizeof(T) == 8, std::uint64_t, std::uint32_t>;
  using Bits = std::conditional_t<sizeof(T) == 2, std::uint16_t, Words>;
  static_assert(sizeof(T) == sizeof(Bits));
  const auto bits = std::bit_cast<Bits>(value);
  for (std::size_t i = 0; i < sizeof(T); ++i) out.push_back(static_cast<std::byte>((bits >> (8 * i)) & 0xFFU));
}

void put_f32(RawBytes& out, double value) { put(out, static_cast<float>(value)); }

template <class Values>
void put_f32s(RawBytes& out, const Values& values) {
  for (const double value : values) put_f32(out, value);
}

void zeros(RawBytes& out, std::size_t count) { out.resize(out.size() + count, std::byte{0}); }

/// The last byte of a field stays NUL.
void put_text(RawBytes& out, std::string_view text, std::size_t field) {
  const std::size_t n = std::min(text.size(), field - 1);
  for (std::size_t i = 0; i < n; ++i) out.push_back(static_cast<std::byte>(text[i]));
  zeros(out, field - n);
}

/// Writes the head of a datagram; the first length word is set by close().
std::size_t open(RawBytes& out, TimeNs time, std::string_view type) {
  const std::size_t start = out.size();
  put(out, std::int32_t{0});
  for (const char c : type) out.push_back(static_cast<std::byte>(c));
  const std::uint64_t filetime = filetime_from_time(time);
  put(out, static_cast<std::uint32_t>(filetime));
  put(out, static_cast<std::uint32_t>(filetime >> 32U));
  return start;
}

void close(RawBytes& out, std::size_t start) {
  const auto length = static_cast<std::uint32_t>(out.size() - start - 4);
  for (std::size_t i = 0; i < 4; ++i) out[start + i] = static_cast<std::byte>((length >> (8 * i)) & 0xFFU);
  put(out, length);
}

void append_padded_text(RawBytes& out, TimeNs time, std::string_view type, std::string_view text) {
  const std::size_t start = open(out, time, type);
  for (const char c : text) out.push_back(static_cast<std::byte>(c));
  zeros(out, (4 - text.size() % 4) % 4);
  close(out, start);
}

void put_beam(RawBytes& out, const BeamConfig& beam) {
  put_text(out, beam.channel_id, 128);
  put(out, beam.beam_type);
  put_f32s(out, std::array{beam.frequency_hz, beam.gain_db, beam.equivalent_beam_angle_db, beam.width_alongship_deg,
                           beam.width_athwartship_deg, beam.sensitivity_alongship, beam.sensitivity_athwartship,
                           beam.offset_alongship_deg, beam.offset_athwartship_deg});
  put_f32s(out, beam.position_m);
  put_f32s(out, beam.direction_deg);
  put_f32s(out, beam.pulse_length_s);
  zeros(out, 8);
  put_f32s(out, beam.gain_table_db);
  zeros(out, 8);
  put_f32s(out, beam.sa_correction_table_db);
  zeros(out, 8);
  put_text(out, "", 16);
  zeros(out, 28);
}

void put_mark(RawBytes& out, std::string_view mark) {
  for (const char c : mark) out.push_back(static_cast<std::byte>(c));
}

void put_reduced_row(RawBytes& out, const ReducedRow& row) {
  put_f32(out, row.background_db);
  put(out, row.seabed_sample);
  put(out, row.recorded_samples);
  put(out, row.open_first);
  put(out, row.open_end);
}

/// What reduced files hold behind a channel's samples.
void put_reduced(RawBytes& out, const ReducedRecord& record) {
  put_mark(out, simrad::kReducedMark);
  put_reduced_row(out, record.row);
  if (record.seabed) {
    put_mark(out, simrad::kReducedSeabedMark);
    const ReducedSeabed& s = *record.seabed;
    for (const double value : {s.offset_m, s.slope_x, s.slope_y, s.min_x, s.max_x, s.min_y, s.max_y}) put(out, value);
  }
  if (record.water) {
    put_mark(out, simrad::kReducedWaterMark);
    const WaterLevels& water = *record.water;
    put(out, water.block_samples);
    put(out, water.blocks);
    put(out, water.places);
    for (const std::size_t count : {water.stretch.size(), water.level.size(), water.cells.size(), water.patch.size()}) {
      put(out, static_cast<std::int32_t>(count));
    }
    for (const float stretch : water.stretch) put_f32(out, stretch);
    for (const std::int16_t count : water.level) put(out, count);
    for (const std::int16_t count : water.reach) put(out, count);
    for (const EchoCell& cell : water.cells) {
      put(out, cell.row);
      put(out, cell.block);
      put_f32(out, cell.evidence);
    }
    for (const std::int8_t steps : water.patch) out.push_back(std::bit_cast<std::byte>(steps));
  }
  if (record.short_beams.empty()) return;
  put_mark(out, simrad::kReducedShortMark);
  put(out, static_cast<std::int32_t>(record.short_beams.size()));
  for (const ReducedChannel& beam : record.short_beams) {
    put(out, static_cast<std::int32_t>(beam.channel + 1));
    put_reduced_row(out, beam.row);
  }
}

}  // namespace

Result<void> append_datagram(RawBytes& out, TimeNs time, std::string_view type, std::span<const std::byte> body) {
  if (type.size() != 4) return fail(ErrorCode::bad_parameter, fmt::format("'{}' is no datagram type", type));
  if (body.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()) - 32) {
    return fail(ErrorCode::bad_parameter, fmt::format("a datagram of {} bytes is too long", body.size()));
  }
  const std::size_t start = open(out, time, type);
  out.insert(out.end(), body.begin(), body.end());
  close(out, start);
  return {};
}

void append_con0(RawBytes& out, TimeNs time, const SounderConfig& config) {
  const std::size_t start = open(out, time, "CON0");
  put_text(out, config.survey_name, 128);
  put_text(out, config.transect_name, 128);
  put_text(out, config.sounder_name, 128);
  put_text(out, config.version, 30);
  put(out, std::int16_t{0});  // multiplexing
  put(out, std::int32_t{0});  // minutes between UTC and local time
  put_f32(out, config.sound_speed_average_mps);
  put_f32(out, config.sound_speed_transducer_mps);
  put_f32s(out, config.mru_offset_m);
  put_f32s(out, config.mru_angles_deg);
  put_f32s(out, config.gps_offset_m);
  zeros(out, 48);
  put(out, static_cast<std::int32_t>(config.beams.size()));
  for (const BeamConfig& beam : config.beams) put_beam(out, beam);
  close(out, start);
}

void append_con1(RawBytes& out, TimeNs time, std::string_view xml) { append_padded_text(out, time, "CON1", xml); }

void append_nme0(RawBytes& out, TimeNs time, std::string_view sentence) {
  append_padded_text(out, time, "NME0", sentence);
}

Result<void> append_raw0(RawBytes& out, TimeNs time, const ChannelPing& p) {
  if (p.channel < 0 || p.channel >= std::numeric_limits<std::int16_t>::max() || p.offset < 0) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("channel {} with offset {} cannot be written", p.channel, p.offset));
  }
  const std::size_t start = open(out, time, "RAW0");
  put(out, static_cast<std::int16_t>(p.channel + 1));
  put(out, std::int16_t{1});
  put_f32s(out, std::array{p.transducer_depth_m, p.frequency_hz, p.transmit_power_w, p.pulse_length_s, p.bandwidth_hz,
                           p.sample_interval_s, p.sound_speed_mps, p.absorption_db_per_m, p.heave_m, p.roll_deg,
                           p.pitch_deg, p.temperature_c, p.heading_deg});
  put(out, static_cast<std::int16_t>(p.transmit_mode));
  put(out, std::int16_t{0});
  put_f32(out, 0.0);
  put(out, static_cast<std::int32_t>(p.offset));
  put(out, static_cast<std::int32_t>(p.power_count.size()));
  const std::size_t samples = out.size();
  out.resize(samples + p.power_count.size_bytes());
  if constexpr (std::endian::native == std::endian::little) {
    if (!p.power_count.empty()) std::memcpy(out.data() + samples, p.power_count.data(), p.power_count.size_bytes());
  } else {
    out.resize(samples);
    for (const std::int16_t count : p.power_count) put(out, count);
  }
  if (p.reduced) put_reduced(out, *p.reduced);
  close(out, start);
  return {};
}

std::string con1_xml(const SounderConfig& config) {
  const auto list = [&](auto value) {
    std::string text;
    for (const BeamConfig& beam : config.beams) {
      if (!text.empty()) text += ';';
      text += shortest(value(beam));
    }
    return text;
  };
  const std::string frequency = list([](const BeamConfig& b) { return b.frequency_hz; });
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?><Configuration><BeamArrays SteeringRxX=\"{}\" SteeringRxY=\"{}\" "
      "FrequencyTx=\"{}\" FrequencyRx=\"{}\"/></Configuration>",
      list([](const BeamConfig& b) { return b.direction_deg[0]; }),
      list([](const BeamConfig& b) { return b.direction_deg[1]; }), frequency, frequency);
}

std::string nmea_sentence(std::string_view body) {
  unsigned checksum = 0;
  for (const char c : body) checksum ^= static_cast<unsigned char>(c);
  return fmt::format("${}*{:02X}", body, checksum);
}

}  // namespace sonar
