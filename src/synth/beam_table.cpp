// SPDX-License-Identifier: Apache-2.0
#include "synth/beam_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <sstream>
#include <string_view>

#include "base/units.h"
#include "io/atomic_file.h"

namespace sonar::synth {
namespace {

struct FanRow {
  int count;
  double absorption_db_per_m;
  std::array<double, 3> gain_db;  ///< most aft, middle and most forward beam
  std::array<double, 3> psi_db;
  std::array<double, 2> sa_correction_db;  ///< least and largest of the fan
  double power_w;
};

constexpr int kFans = 20;
constexpr int kBeams = 25;
constexpr double kDeepestFrequency_hz = 111075.0;
constexpr double kFrequencyStep_hz = 1850.0;

constexpr std::array<FanRow, kFans> kFanRows = {{
    {1324, 0.035709, {14.50, 15.69, 14.28}, {-17.51, -18.83, -17.51}, {-1.657, -1.467}, 26.37},
    {1324, 0.035241, {15.21, 16.99, 15.32}, {-18.55, -19.85, -18.55}, {-1.665, -1.461}, 29.07},
    {1324, 0.034766, {16.52, 18.14, 16.27}, {-19.34, -20.62, -19.34}, {-1.486, -1.439}, 32.35},
    {1324, 0.034282, {17.38, 19.11, 17.36}, {-19.86, -21.14, -19.86}, {-1.613, -1.501}, 34.56},
    {1324, 0.033790, {18.38, 20.16, 18.40}, {-20.31, -21.58, -20.31}, {-1.656, -1.528}, 36.18},
    {1324, 0.033289, {18.59, 20.65, 18.49}, {-20.66, -21.92, -20.66}, {-1.643, -1.495}, 36.62},
    {1324, 0.032779, {19.07, 20.90, 19.22}, {-20.93, -22.17, -20.93}, {-1.627, -1.490}, 36.09},
    {1324, 0.032260, {19.30, 20.96, 19.91}, {-21.14, -22.36, -21.14}, {-1.556, -1.446}, 35.61},
    {1324, 0.031731, {19.67, 21.09, 19.78}, {-21.31, -22.52, -21.31}, {-1.624, -1.522}, 35.02},
    {1324, 0.031193, {20.13, 21.63, 19.73}, {-21.45, -22.64, -21.45}, {-1.611, -1.510}, 34.69},
    {1324, 0.030644, {20.19, 21.99, 20.22}, {-21.53, -22.73, -21.53}, {-1.619, -1.484}, 34.69},
    {1324, 0.030085, {20.31, 22.06, 20.02}, {-21.62, -22.80, -21.62}, {-1.596, -1.496}, 35.19},
    {1324, 0.029516, {20.37, 22.33, 20.25}, {-21.68, -22.85, -21.68}, {-1.616, -1.500}, 35.67},
    {1324, 0.028935, {20.22, 22.06, 20.21}, {-21.72, -22.88, -21.72}, {-1.660, -1.481}, 36.16},
    {1324, 0.028344, {20.07, 21.75, 20.23}, {-21.73, -22.89, -21.73}, {-1.665, -1.474}, 37.21},
    {1324, 0.027741, {20.02, 21.45, 20.44}, {-21.73, -22.87, -21.73}, {-1.640, -1.515}, 38.40},
    {1320, 0.027127, {20.30, 21.31, 20.41}, {-21.70, -22.84, -21.70}, {-1.536, -1.464}, 39.59},
    {1320, 0.026502, {20.54, 21.80, 20.62}, {-21.66, -22.80, -21.66}, {-1.602, -1.445}, 40.40},
    {1320, 0.025864, {20.44, 22.36, 20.66}, {-21.60, -22.74, -21.60}, {-1.681, -1.425}, 40.63},
    {1320, 0.025215, {19.82, 20.96, 19.78}, {-21.53, -22.67, -21.53}, {-1.668, -1.465}, 40.09},
}};

/// The table gives the ends and the middle of a fan.
double between(const std::array<double, 3>& values, int beam) {
  const double x = 2.0 * beam / (kBeams - 1);
  return x < 1.0 ? values[0] + (values[1] - values[0]) * x : values[1] + (values[2] - values[1]) * (x - 1.0);
}

Beam ms70_beam(int fan, int beam) {
  const FanRow& row = kFanRows[static_cast<std::size_t>(fan)];
  Beam b;
  b.elevation_deg = -45.0 + 45.0 * fan / (kFans - 1);
  b.azimuth_deg = -30.0 + 2.5 * beam;
  b.frequency_hz = kDeepestFrequency_hz - kFrequencyStep_hz * fan;
  // A flat array that stands upright and faces abeam; both constants reproduce all widths of the recorded table.
  b.vertical_width_deg = 549327.5 / (b.frequency_hz * std::cos(rad_from_deg(b.elevation_deg)));
  b.horizontal_width_deg = 300888.0 / (b.frequency_hz * std::cos(rad_from_deg(b.azimuth_deg)));
  b.gain_db = between(row.gain_db, beam);
  b.psi_db = between(row.psi_db, beam);
  b.sa_correction_db =
      row.sa_correction_db[0] + (row.sa_correction_db[1] - row.sa_correction_db[0]) * beam / (kBeams - 1);
  b.power_w = row.power_w;
  b.absorption_db_per_m = row.absorption_db_per_m;
  b.count = row.count;
  return b;
}

struct Column {
  std::string_view name;
  double Beam::*member;
  double min;
  double max;
};
constexpr std::array<Column, 10> kColumns = {{
    {"elevation_deg", &Beam::elevation_deg, -90, 90},
    {"azimuth_deg", &Beam::azimuth_deg, -180, 180},
    {"frequency_hz", &Beam::frequency_hz, 1e3, 1e7},
    {"vertical_width_deg", &Beam::vertical_width_deg, 0.1, 90},
    {"horizontal_width_deg", &Beam::horizontal_width_deg, 0.1, 90},
    {"gain_db", &Beam::gain_db, -100, 100},
    {"psi_db", &Beam::psi_db, -100, 20},
    {"sa_correction_db", &Beam::sa_correction_db, -20, 20},
    {"power_w", &Beam::power_w, 1e-3, 1e6},
    {"absorption_db_per_m", &Beam::absorption_db_per_m, 0, 10},
}};
constexpr int kMaxChannels = 10000;
constexpr int kMaxCount = 100000;
/// More is no table of kMaxChannels lines.
constexpr std::uint64_t kMostBytes = 16U << 20U;

std::vector<std::string_view> split(std::string_view line) {
  while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

using Fields = std::map<std::string_view, std::size_t>;

Result<double> number(const std::vector<std::string_view>& fields, const Fields& header, std::string_view name,
                      double min, double max) {
  const auto column = header.find(name);
  if (column == header.end()) return fail(ErrorCode::format, fmt::format("the column {} is missing", name));
  double value = 0.0;
  const std::string_view text = column->second < fields.size() ? fields[column->second] : std::string_view();
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || end != text.data() + text.size()) {
    return fail(ErrorCode::format, fmt::format("'{}' in column {} is no number", text, name));
  }
  if (!(value >= min && value <= max)) {
    return fail(ErrorCode::bad_parameter, fmt::format("{} = {} is outside {} .. {}", name, value, min, max));
  }
  return value;
}

Result<int> whole(const std::vector<std::string_view>& fields, const Fields& header, std::string_view name, int min,
                  int max) {
  const auto value = number(fields, header, name, min, max);
  if (!value) return pass_on(value);
  if (*value != std::floor(*value)) {
    return fail(ErrorCode::format, fmt::format("{} = {} is no whole number", name, *value));
  }
  return static_cast<int>(*value);
}

Result<void> read_row(const std::vector<std::string_view>& fields, const Fields& header, std::map<int, Beam>& beams) {
  Beam beam;
  for (const Column& column : kColumns) {
    const auto value = number(fields, header, column.name, column.min, column.max);
    if (!value) return pass_on(value);
    beam.*column.member = *value;
  }
  const auto count = whole(fields, header, "count", 1, kMaxCount);
  if (!count) return pass_on(count);
  beam.count = *count;
  const auto channel = whole(fields, header, "channel", 0, kMaxChannels - 1);
  if (!channel) return pass_on(channel);
  if (!beams.emplace(*channel, beam).second) {
    return fail(ErrorCode::format, fmt::format("channel {} stands there twice", *channel));
  }
  return {};
}

/// The table's first line, before any of its numbers is looked at.
Result<void> check_header(const Fields& header) {
  std::string expected = "channel,count";
  for (const Column& column : kColumns) expected += fmt::format(",{}", column.name);
  const auto has = [&](std::string_view name) { return header.contains(name); };
  const bool all = has("channel") && has("count") &&
                   std::all_of(kColumns.begin(), kColumns.end(), [&](const Column& c) { return has(c.name); });
  if (all) return {};
  return fail(ErrorCode::format, fmt::format("line 1: expected the columns {} in any order", expected));
}

}  // namespace

std::vector<Beam> ms70_beams() {
  std::vector<Beam> beams;
  for (int fan = 0; fan < kFans; ++fan) {
    for (int beam = 0; beam < kBeams; ++beam) beams.push_back(ms70_beam(fan, beam));
  }
  return beams;
}

Result<std::vector<Beam>> parse_beam_table(const std::string& text, const std::string& file) {
  std::istringstream in(text);
  std::string header_line;
  std::getline(in, header_line);
  Fields header;
  const auto names = split(header_line);
  for (std::size_t i = 0; i < names.size(); ++i) header.emplace(names[i], i);
  if (auto checked = check_header(header); !checked)
    return fail(checked.error().code, checked.error().text, {.file = file});
  std::map<int, Beam> beams;
  std::string line;
  for (int number = 2; std::getline(in, line); ++number) {
    if (line.empty() || line == "\r") continue;
    if (auto read = read_row(split(line), header, beams); !read) {
      return fail(read.error().code, fmt::format("line {}: {}", number, read.error().text), {.file = file});
    }
  }
  if (beams.empty() || beams.rbegin()->first + 1 != static_cast<int>(beams.size())) {
    return fail(ErrorCode::format, "the channels are not 0, 1, ... each once", {.file = file});
  }
  std::vector<Beam> in_order;
  for (const auto& [channel, beam] : beams) in_order.push_back(beam);
  return in_order;
}

Result<std::vector<Beam>> read_beam_table(const std::filesystem::path& path) {
  const auto text = read_file(path, kMostBytes);
  if (!text) return pass_on(text);
  return parse_beam_table(*text, path.string());
}

SounderConfig sounder_config(const std::vector<Beam>& beams, const std::string& survey_name) {
  SounderConfig config;
  config.survey_name = survey_name;
  config.sounder_name = "MBS";
  config.version = "synthetic";
  config.kind = SounderKind::ms70;
  config.sound_speed_average_mps = kSoundSpeed_mps;
  config.sound_speed_transducer_mps = kSoundSpeed_mps;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const Beam& beam = beams[i];
    BeamConfig& c = config.beams.emplace_back();
    c.channel_id = fmt::format("MS70 SYNTHETIC channel {:03d}", i + 1);
    c.frequency_hz = beam.frequency_hz;
    c.gain_db = beam.gain_db;
    c.equivalent_beam_angle_db = beam.psi_db;
    c.width_alongship_deg = beam.vertical_width_deg;
    c.width_athwartship_deg = beam.horizontal_width_deg;
    c.sensitivity_alongship = 1.0;
    c.sensitivity_athwartship = 1.0;
    c.direction_deg = {beam.elevation_deg, beam.azimuth_deg, 0.0};
    c.pulse_length_s[0] = kPulseLength_s;
    c.gain_table_db[0] = beam.gain_db;
    c.sa_correction_table_db[0] = beam.sa_correction_db;
  }
  return config;
}

}  // namespace sonar::synth
