// SPDX-License-Identifier: Apache-2.0
#include "io/simrad/con0.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include "io/simrad/fields.h"

namespace sonar::simrad {
namespace {

constexpr std::size_t kHeaderBytes = 516;
constexpr std::size_t kBlockBytes = 320;

template <std::size_t N>
std::array<double, N> floats_at(std::span<const std::byte> bytes, std::size_t offset) {
  std::array<double, N> values{};
  for (std::size_t i = 0; i < N; ++i) values[i] = float_at(bytes, offset + 4 * i);
  return values;
}

BeamConfig parse_block(std::span<const std::byte> block) {
  BeamConfig beam;
  beam.channel_id = text_at(block, 0, 128);
  beam.beam_type = number_at<std::int32_t>(block, 128);
  beam.frequency_hz = float_at(block, 132);
  beam.gain_db = float_at(block, 136);
  beam.equivalent_beam_angle_db = float_at(block, 140);
  beam.width_alongship_deg = float_at(block, 144);
  beam.width_athwartship_deg = float_at(block, 148);
  beam.sensitivity_alongship = float_at(block, 152);
  beam.sensitivity_athwartship = float_at(block, 156);
  beam.offset_alongship_deg = float_at(block, 160);
  beam.offset_athwartship_deg = float_at(block, 164);
  beam.position_m = floats_at<3>(block, 168);
  beam.direction_deg = floats_at<3>(block, 180);
  beam.pulse_length_s = floats_at<5>(block, 192);
  beam.gain_table_db = floats_at<5>(block, 220);
  beam.sa_correction_table_db = floats_at<5>(block, 248);
  return beam;
}

/// Impossible numbers become NaN, unknown; whether there was one, or one that is not finite. What is 0 may be left unset.
bool forget_impossible(BeamConfig& beam) {
  bool bad = false;
  const auto within = [&bad](double& value, double least, double most) {
    if (value >= least && value <= most) return;
    value = std::numeric_limits<double>::quiet_NaN();
    bad = true;
  };
  within(beam.frequency_hz, 0.0, 5e6);
  within(beam.gain_db, -20.0, 60.0);
  within(beam.equivalent_beam_angle_db, -45.0, 11.0);  // 11 = all directions
  within(beam.width_alongship_deg, 0.0, 360.0);
  within(beam.width_athwartship_deg, 0.0, 360.0);
  for (double* angle : {&beam.direction_deg[0], &beam.direction_deg[1]}) within(*angle, -360.0, 360.0);
  for (double& gain : beam.gain_table_db) within(gain, -20.0, 60.0);
  for (double& correction : beam.sa_correction_table_db) within(correction, -10.0, 10.0);
  for (double& pulse : beam.pulse_length_s) within(pulse, 0.0, 1.0);
  return bad;
}

bool starts_with(std::string_view text, std::string_view start) { return text.substr(0, start.size()) == start; }

}  // namespace

SounderKind kind_of(const std::string& sounder_name) {
  std::string name = sounder_name;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  if (name.find("MS70") != std::string::npos || name == "MBS") return SounderKind::ms70;
  if (name.find("ME70") != std::string::npos || name == "MBES") return SounderKind::me70;
  for (const std::string_view start : {"ER60", "EK60", "ES60", "ES70"}) {
    if (starts_with(name, start)) return SounderKind::ek60;
  }
  for (const std::string_view start : {"SX90", "SU90", "SH90", "SX9", "SU9", "SH9", "ST90", "SN90"}) {
    if (starts_with(name, start)) return SounderKind::omni;
  }
  return SounderKind::unknown;
}

Con0 parse_con0(std::span<const std::byte> body) {
  Con0 con0;
  if (body.size() < kHeaderBytes) {
    con0.problem = fmt::format("CON0 body of {} bytes, expected at least {}", body.size(), kHeaderBytes);
    return con0;
  }
  SounderConfig& config = con0.config;
  config.survey_name = text_at(body, 0, 128);
  config.transect_name = text_at(body, 128, 128);
  config.sounder_name = text_at(body, 256, 128);
  config.version = text_at(body, 384, 30);
  config.kind = kind_of(config.sounder_name);
  config.sound_speed_average_mps = float_at(body, 420);
  config.sound_speed_transducer_mps = float_at(body, 424);
  config.mru_offset_m = floats_at<3>(body, 428);
  config.mru_angles_deg = floats_at<3>(body, 440);
  config.gps_offset_m = floats_at<3>(body, 452);
  const auto stated = number_at<std::int32_t>(body, 512);
  const auto fitting = static_cast<std::int64_t>((body.size() - kHeaderBytes) / kBlockBytes);
  if (stated < 0 || stated > fitting) {
    con0.problem = fmt::format("CON0 speaks of {} beams, its body holds {}", stated, fitting);
  }
  const std::int64_t count = stated < 0 ? 0 : std::min<std::int64_t>(stated, fitting);
  for (std::int64_t i = 0; i < count; ++i) {
    config.beams.push_back(
        parse_block(body.subspan(kHeaderBytes + static_cast<std::size_t>(i) * kBlockBytes, kBlockBytes)));
    if (forget_impossible(config.beams.back()) && con0.bad_numbers.empty()) {
      con0.bad_numbers = fmt::format("beam {} of CON0 has a number that is not finite or impossible", i + 1);
    }
  }
  return con0;
}

}  // namespace sonar::simrad
