// SPDX-License-Identifier: Apache-2.0
#include "pipeline/survey/sound_profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>

namespace sonar {
namespace {

constexpr double kLeast_mps = 1000.0;
constexpr double kMost_mps = 2000.0;
constexpr double kDeepest_m = 12'000.0;
constexpr std::size_t kMostLines = 100'000;

double speed_at(const SoundProfile& profile, double depth_m) {
  const auto below = std::lower_bound(profile.begin(), profile.end(), depth_m,
                                      [](const SoundSpeedAt& line, double depth) { return line.depth_m < depth; });
  if (below == profile.begin()) return profile.front().sound_speed_mps;
  if (below == profile.end()) return profile.back().sound_speed_mps;
  const SoundSpeedAt& above = *(below - 1);
  const double share = (depth_m - above.depth_m) / (below->depth_m - above.depth_m);
  return above.sound_speed_mps + share * (below->sound_speed_mps - above.sound_speed_mps);
}

/// Time through a layer in which the speed changes evenly.
double time_s(double thickness_m, double from_mps, double to_mps) {
  const double change = (to_mps - from_mps) / from_mps;
  return std::abs(change) < 1e-9 ? thickness_m / from_mps : thickness_m / from_mps * std::log1p(change) / change;
}

}  // namespace

double harmonic_mean_mps(const SoundProfile& profile, double from_depth_m, double to_depth_m) {
  const double top = std::min(from_depth_m, to_depth_m);
  const double bottom = std::max(from_depth_m, to_depth_m);
  if (!(bottom > top)) return speed_at(profile, top);
  double time = 0.0;
  double depth = top;
  const auto down_to = [&](double next) {
    time += time_s(next - depth, speed_at(profile, depth), speed_at(profile, next));
    depth = next;
  };
  for (const SoundSpeedAt& line : profile) {
    if (line.depth_m > depth && line.depth_m < bottom) down_to(line.depth_m);
  }
  down_to(bottom);
  return (bottom - top) / time;
}

Result<void> check_sound_speed(double sound_speed_mps) {
  if (sound_speed_mps == 0.0 || (sound_speed_mps >= kLeast_mps && sound_speed_mps <= kMost_mps)) return {};
  return fail(ErrorCode::bad_parameter, fmt::format("sound_speed_mps: {} m/s is outside {} .. {} (0 = not given)",
                                                    sound_speed_mps, kLeast_mps, kMost_mps));
}

Result<void> check_profile(const SoundProfile& profile) {
  if (profile.size() > kMostLines) return fail(ErrorCode::bad_parameter, "sound_speed_profile: too many lines");
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const SoundSpeedAt& line = profile[i];
    if (!(line.sound_speed_mps >= kLeast_mps && line.sound_speed_mps <= kMost_mps)) {
      return fail(ErrorCode::bad_parameter, fmt::format("sound_speed_profile: {} m/s at {} m is outside {} .. {}",
                                                        line.sound_speed_mps, line.depth_m, kLeast_mps, kMost_mps));
    }
    if (!(line.depth_m >= 0.0 && line.depth_m <= kDeepest_m) || (i > 0 && !(line.depth_m > profile[i - 1].depth_m))) {
      return fail(ErrorCode::bad_parameter,
                  fmt::format("sound_speed_profile: depth {} m: expected rising depths from 0 to {} m", line.depth_m,
                              kDeepest_m));
    }
  }
  return {};
}

Result<SoundProfile> profile_from_table(const CsvTable& table) {
  const auto depth = table.require_column("depth_m");
  if (!depth) return pass_on(depth);
  const auto speed = table.require_column("sound_speed_mps");
  if (!speed) return pass_on(speed);
  SoundProfile profile;
  for (const CsvRecord& record : table.records) {
    const auto at = table.number(record, *depth);
    if (!at) return pass_on(at);
    const auto value = table.number(record, *speed);
    if (!value) return pass_on(value);
    profile.push_back({*at, *value});
  }
  if (profile.empty()) return fail(ErrorCode::format, "expected a line for each depth, found none", {table.file});
  if (auto valid = check_profile(profile); !valid) return fail(valid.error().code, valid.error().text, {table.file});
  return profile;
}

nlohmann::json to_json(const SoundProfile& profile) {
  nlohmann::json list = nlohmann::json::array();
  for (const SoundSpeedAt& line : profile) list.push_back({line.depth_m, line.sound_speed_mps});
  return list;
}

Result<SoundProfile> profile_from_json(const nlohmann::json& json) {
  const auto wrong = [] {
    return fail(ErrorCode::format, "sound_speed_profile: expected [[depth_m, sound_speed_mps], ...]");
  };
  if (!json.is_array()) return wrong();
  SoundProfile profile;
  for (const auto& line : json) {
    if (!line.is_array() || line.size() != 2 || !line[0].is_number() || !line[1].is_number()) return wrong();
    profile.push_back({line[0].get<double>(), line[1].get<double>()});
  }
  if (auto valid = check_profile(profile); !valid) return pass_on(valid);
  return profile;
}

}  // namespace sonar
