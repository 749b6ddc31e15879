// SPDX-License-Identifier: Apache-2.0
#include "pipeline/survey/cast_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <vector>

#include "base/units.h"
#include "io/atomic_file.h"
#include "io/csv_table.h"
#include "pipeline/survey/sound_profile.h"
#include "signal/absorption.h"

namespace sonar {
namespace {

/// Columns of a cast; empty = it has none.
struct Cast {
  std::vector<double> depth_m;
  std::vector<double> pressure_dbar;  ///< of the water alone
  std::vector<double> sound_speed_mps;
  std::vector<double> temperature_c;
  std::vector<double> salinity_psu;
  double latitude_deg = 45.0;  ///< the depth of a pressure changes by 0.5 % from the equator to a pole
};

double depth_of(double pressure_dbar, double latitude_deg) {
  const double s = std::sin(rad_from_deg(latitude_deg));
  return (1.0 - (5.92e-3 + 5.25e-3 * s * s)) * pressure_dbar - 2.21e-6 * pressure_dbar * pressure_dbar;
}

/// Whether lines begin nearer to the deepest of them than to where they end: the way down was not kept.
bool only_goes_up(const SoundProfile& lines, double deepest_m) {
  return !lines.empty() && deepest_m - lines.front().depth_m < lines.front().depth_m - lines.back().depth_m;
}

Result<SoundProfile> profile_of(const Cast& cast, const std::string& file) {
  const auto& deep = cast.depth_m.empty() ? cast.pressure_dbar : cast.depth_m;
  const bool measured = !cast.sound_speed_mps.empty();
  const std::size_t lines =
      std::min(deep.size(),
               measured ? cast.sound_speed_mps.size() : std::min(cast.temperature_c.size(), cast.salinity_psu.size()));
  SoundProfile valid_lines;
  double deepest_m = 0.0;
  for (std::size_t i = 0; i < lines; ++i) {
    const double depth = cast.depth_m.empty() ? depth_of(deep[i], cast.latitude_deg) : deep[i];
    const double speed =
        measured
            ? cast.sound_speed_mps[i]
            : sound_speed_mackenzie(
                  {.temperature_c = cast.temperature_c[i], .salinity_psu = cast.salinity_psu[i], .depth_m = depth});
    if (!(depth >= 0.0) || !std::isfinite(speed)) continue;
    valid_lines.push_back({depth, speed});
    deepest_m = std::max(deepest_m, depth);
  }
  if (only_goes_up(valid_lines, deepest_m)) std::ranges::reverse(valid_lines);
  SoundProfile profile;
  for (const SoundSpeedAt& line : valid_lines) {
    if (profile.empty() || line.depth_m > profile.back().depth_m) profile.push_back(line);
  }
  if (profile.empty()) {
    return fail(ErrorCode::format,
                "expected depth or pressure, and sound speed or temperature and salinity; found no line with them",
                {file});
  }
  if (auto valid = check_profile(profile); !valid) return fail(valid.error().code, valid.error().text, {file});
  return profile;
}

/// Little-endian values of a TSD file, from front to back.
class Values {
 public:
  explicit Values(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  [[nodiscard]] std::optional<T> next() {
    if (bytes_.size() < sizeof(T)) return std::nullopt;
    T value;
    std::memcpy(&value, bytes_.data(), sizeof(T));
    bytes_.remove_prefix(sizeof(T));
    return value;
  }
  [[nodiscard]] std::optional<std::string> label() {
    if (bytes_.size() < 4) return std::nullopt;
    std::string text(bytes_.substr(0, 4));
    bytes_.remove_prefix(4);
    return text;
  }

 private:
  std::string_view bytes_;
};
static_assert(std::endian::native == std::endian::little);

std::optional<double> value_of(Values& in, const std::string& type) {
  const auto as_double = [](auto value) -> std::optional<double> {
    return value ? std::optional(static_cast<double>(*value)) : std::nullopt;
  };
  if (type == "doub") return as_double(in.next<double>());
  if (type == "floa") return as_double(in.next<float>());
  if (type == "long") return as_double(in.next<std::int32_t>());
  if (type == "shrt") return as_double(in.next<std::int16_t>());
  if (type == "byte" || type == "char") return as_double(in.next<std::int8_t>());
  return std::nullopt;
}

/// The variables of the first time step by their labels; none where the bytes are not what the header says.
std::optional<std::map<std::string, std::vector<double>>> first_step(std::string_view bytes) {
  constexpr float kMostVariables = 1000.0F;
  Values in(bytes.substr(4));
  const auto count = in.next<float>();
  const auto steps = in.next<std::int32_t>();
  const auto rows = in.next<std::int32_t>();
  if (!count || !steps || !rows || !(*count >= 1.0F && *count <= kMostVariables) || *steps < 1) return std::nullopt;
  if (*rows != 1 && *rows != *steps) return std::nullopt;
  const auto variables = static_cast<std::size_t>(*count);
  std::vector<std::int32_t> lengths;
  // One row of lengths a step, or one for all; the first is the first step's.
  for (std::size_t i = 0; i < variables * static_cast<std::size_t>(*rows); ++i) {
    const auto length = in.next<std::int32_t>();
    if (!length || *length < 0) return std::nullopt;
    if (i < variables) lengths.push_back(*length);
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < 2 * variables; ++i) {
    const auto name = in.label();
    if (!name) return std::nullopt;
    names.push_back(*name);
  }
  std::map<std::string, std::vector<double>> out;
  for (std::size_t v = 0; v < variables; ++v) {
    for (std::int32_t i = 0; i < lengths[v]; ++i) {
      const auto value = value_of(in, names[variables + v]);
      if (!value) return std::nullopt;
      out[names[v]].push_back(*value);
    }
  }
  return out;
}

Result<SoundProfile> profile_from_tsd(std::string_view bytes, const std::string& file) {
  auto found = first_step(bytes);
  if (!found) return fail(ErrorCode::format, "Time Step Data that end early, or whose header is damaged", {file});
  auto& step = *found;
  Cast cast;
  cast.pressure_dbar = step["ihpr"];
  // Heights are those of the pressure as if it were that of the air too: used only where it is not there.
  if (cast.pressure_dbar.empty()) {
    for (const double up : step["pszc"]) cast.depth_m.push_back(-up);
  }
  cast.sound_speed_mps = step["isps"];
  cast.temperature_c = step["temp"];
  cast.salinity_psu = step["slty"];
  if (!step["latc"].empty() && std::abs(step["latc"].front()) <= 90.0) cast.latitude_deg = step["latc"].front();
  return profile_of(cast, file);
}

/// The column that a line "# name 3 = svCM: Sound Velocity [Chen-Millero, m/s]" names; null = of no use.
std::vector<double>* column_of(Cast& cast, std::string_view name) {
  const auto says = [&](std::string_view word) { return name.find(word) != std::string_view::npos; };
  if (name.starts_with("dep") && says(", m]")) return &cast.depth_m;
  if (name.starts_with("pr") && says("Pressure") && says("[db]")) return &cast.pressure_dbar;
  if (name.starts_with("sv") && says("m/s]")) return &cast.sound_speed_mps;
  if (name.starts_with("t") && says("Temperature") && says("deg C]")) return &cast.temperature_c;
  if (name.starts_with("sal") && says("Salinity")) return &cast.salinity_psu;
  return nullptr;
}

Result<SoundProfile> profile_from_cnv(std::string_view text, const std::string& file) {
  Cast cast;
  std::vector<std::vector<double>*> columns;
  bool header = true;
  std::int64_t number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
    if (line.starts_with("*END*")) {
      header = false;
    } else if (header && line.starts_with("# name ")) {
      const std::size_t at = line.find("= ");
      std::vector<double>* column = at == std::string_view::npos ? nullptr : column_of(cast, line.substr(at + 2));
      // A second sensor of a kind stands behind the first.
      const bool twice = std::find(columns.begin(), columns.end(), column) != columns.end();
      columns.push_back(twice ? nullptr : column);
    } else if (!header) {
      const char* from = line.data();
      const char* const last = line.data() + line.size();
      for (std::vector<double>* column : columns) {
        while (from != last && *from == ' ') ++from;
        double value = 0.0;
        const auto [stop, error] = std::from_chars(from, last, value);
        if (error != std::errc{}) {
          if (line.find_first_not_of(" \r") == std::string_view::npos) break;
          return fail(ErrorCode::format, fmt::format("line {}: expected {} numbers", number, columns.size()), {file});
        }
        from = stop;
        // Sea-Bird's mark of a bad value.
        if (column != nullptr) column->push_back(value == -9.990e-29 ? std::nan("") : value);
      }
    }
  }
  return profile_of(cast, file);
}

}  // namespace

Result<SoundProfile> profile_from_bytes(std::string_view bytes, const std::string& file) {
  if (bytes.starts_with("%TSD")) return profile_from_tsd(bytes, file);
  if (bytes.starts_with("*") && bytes.find("*END*") != std::string_view::npos) return profile_from_cnv(bytes, file);
  const auto table = parse_csv(bytes, file);
  if (!table) return pass_on(table);
  return profile_from_table(*table);
}

Result<SoundProfile> read_sound_profile(const std::filesystem::path& path) {
  const auto bytes = read_file(path);
  if (!bytes) return pass_on(bytes);
  return profile_from_bytes(*bytes, path.string());
}

}  // namespace sonar
