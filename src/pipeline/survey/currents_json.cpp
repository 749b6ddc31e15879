// SPDX-License-Identifier: Apache-2.0
#include "pipeline/survey/currents_json.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace sonar {
namespace {

/// As wide as what read_currents() gives.
bool in_range(const CurrentAt& bin) {
  return bin.depth_m >= 0.0 && bin.depth_m <= 12'000.0 && std::abs(bin.east_mps) <= 20.0 &&
         std::abs(bin.north_mps) <= 20.0;
}

/// "depth east north" at the beginning of a text, which it takes off.
std::optional<CurrentAt> take_bin(std::string_view& text) {
  std::array<double, 3> numbers{};
  for (double& number : numbers) {
    while (text.starts_with(' ')) text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{}) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
  return CurrentAt{numbers[0], numbers[1], numbers[2]};
}

std::optional<std::vector<CurrentAt>> bins_from(std::string_view text) {
  std::vector<CurrentAt> bins;
  while (!text.empty()) {
    const auto bin = take_bin(text);
    if (!bin || !in_range(*bin) || (!bins.empty() && !(bin->depth_m > bins.back().depth_m))) return std::nullopt;
    bins.push_back(*bin);
    if (!text.empty() && !text.starts_with(';')) return std::nullopt;
    if (!text.empty()) text.remove_prefix(1);
  }
  return bins;
}

std::optional<CurrentProfile> profile_from(const nlohmann::json& one) {
  if (!one.is_object() || !one.contains("time_utc") || !one["time_utc"].is_string()) return std::nullopt;
  if (!one.contains("profile") || !one["profile"].is_string()) return std::nullopt;
  const auto time = time_from_iso(one["time_utc"].get_ref<const std::string&>());
  auto bins = bins_from(one["profile"].get_ref<const std::string&>());
  if (!time || !bins || bins->empty()) return std::nullopt;
  CurrentProfile profile;
  profile.time = *time;
  profile.bins = std::move(*bins);
  if (!one.contains("latitude") && !one.contains("longitude")) return profile;
  const auto latitude = one.find("latitude");
  const auto longitude = one.find("longitude");
  if (latitude == one.end() || longitude == one.end() || !latitude->is_number() || !longitude->is_number()) {
    return std::nullopt;
  }
  profile.place = {latitude->get<double>(), longitude->get<double>()};
  const bool sound = std::abs(profile.place.latitude_deg) <= 90.0 && std::abs(profile.place.longitude_deg) <= 180.0;
  return sound ? std::optional(std::move(profile)) : std::nullopt;
}

}  // namespace

nlohmann::json to_json(const CurrentProfiles& profiles) {
  nlohmann::json list = nlohmann::json::array();
  for (const CurrentProfile& profile : profiles) {
    nlohmann::json one = nlohmann::json::object();
    one["time_utc"] = iso_time(profile.time);
    if (std::isfinite(profile.place.latitude_deg)) {
      one["latitude"] = profile.place.latitude_deg;
      one["longitude"] = profile.place.longitude_deg;
    }
    std::string text;
    for (const CurrentAt& bin : profile.bins) {
      fmt::format_to(std::back_inserter(text), "{}{} {} {}", text.empty() ? "" : "; ", bin.depth_m, bin.east_mps,
                     bin.north_mps);
    }
    one["profile"] = std::move(text);
    list.push_back(std::move(one));
  }
  return list;
}

Result<CurrentProfiles> currents_from_json(const nlohmann::json& json) {
  if (!json.is_array()) return fail(ErrorCode::format, "current_profiles: expected a list of profiles");
  CurrentProfiles profiles;
  for (const auto& one : json) {
    auto profile = profile_from(one);
    if (!profile || (!profiles.empty() && !(profile->time > profiles.back().time))) {
      return fail(ErrorCode::format,
                  fmt::format("current_profiles[{}]: expected rising times, {{\"time_utc\", \"latitude\", "
                              "\"longitude\", \"profile\": \"depth_m east_mps north_mps; ...\"}}",
                              profiles.size()));
    }
    profiles.push_back(std::move(*profile));
  }
  return profiles;
}

}  // namespace sonar
