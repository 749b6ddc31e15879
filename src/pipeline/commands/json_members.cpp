// SPDX-License-Identifier: Apache-2.0
#include "pipeline/commands/json_members.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "pipeline/recipe/transfer_function_json.h"

namespace sonar::members {
namespace {

constexpr std::int64_t kMostInt = std::numeric_limits<int>::max();
constexpr std::size_t kMostText = 4096;

std::optional<std::int64_t> number(const nlohmann::json& json, const char* member, std::int64_t least,
                                   std::int64_t most) {
  if (!json.is_object()) return std::nullopt;
  const auto found = json.find(member);
  return found == json.end() ? std::nullopt : whole_number(*found, least, most);
}

/// Bytes of UTF-8 above 0x7f are no control characters.
bool is_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x20 || byte == 0x7f;
}

}  // namespace

nlohmann::json from_seed(const SeedKey& seed) { return {{"channel", seed.channel}, {"sample", seed.sample}}; }

nlohmann::json from_seeds(const std::vector<SeedKey>& seeds) {
  nlohmann::json list = nlohmann::json::array();
  for (const SeedKey& seed : seeds) list.push_back(from_seed(seed));
  return list;
}

nlohmann::json from_runs(const std::vector<RunKey>& runs) {
  nlohmann::json list = nlohmann::json::array();
  for (const RunKey& run : runs) list.push_back(nlohmann::json::array({run.channel, run.sample, run.count}));
  return list;
}

nlohmann::json from_school(const SchoolKey& school) {
  return {{"ping_time", school.ping_time}, {"channel", school.channel}, {"sample", school.sample}};
}

Result<SeedKey> read_seed(const nlohmann::json& json, const std::string& place) {
  const auto channel = number(json, "channel", 0, kMostInt);
  const auto sample = number(json, "sample", 0, kMostInt);
  if (!channel || !sample) return fail(ErrorCode::format, place + ": expected channel and sample");
  return SeedKey{static_cast<int>(*channel), static_cast<int>(*sample)};
}

Result<std::vector<SeedKey>> read_seeds(const nlohmann::json& args) {
  const auto list = args.find("seeds");
  if (list == args.end() || !list->is_array() || list->empty()) {
    return fail(ErrorCode::format, "seeds: expected an array of voxels");
  }
  std::vector<SeedKey> seeds;
  for (const auto& json : *list) {
    const auto seed = read_seed(json, fmt::format("seeds[{}]", seeds.size()));
    if (!seed) return pass_on(seed);
    seeds.push_back(*seed);
  }
  return seeds;
}

Result<std::vector<RunKey>> read_runs(const nlohmann::json& args) {
  const auto list = args.find("runs");
  if (list == args.end() || !list->is_array() || list->empty()) {
    return fail(ErrorCode::format, "runs: expected an array of [channel, sample, count]");
  }
  std::vector<RunKey> runs;
  for (const auto& json : *list) {
    const auto part = [&](std::size_t i, std::int64_t least) {
      return json.is_array() && json.size() == 3 ? whole_number(json[i], least, kMostInt) : std::nullopt;
    };
    const auto channel = part(0, 0);
    const auto sample = part(1, 0);
    const auto count = part(2, 1);
    if (!channel || !sample || !count || *sample + *count > kMostInt) {
      return fail(ErrorCode::format, fmt::format("runs[{}]: expected [channel, sample, count]", runs.size()));
    }
    runs.push_back({static_cast<int>(*channel), static_cast<int>(*sample), static_cast<int>(*count)});
  }
  return runs;
}

Result<SchoolKey> read_school(const nlohmann::json& json, const std::string& place, TimeNs ping_time) {
  const auto voxel = read_seed(json, place);
  if (!voxel) return pass_on(voxel);
  if (!json.contains("ping_time")) return SchoolKey{ping_time, voxel->channel, voxel->sample};
  const auto time = whole_number(json["ping_time"]);
  if (!time) return fail(ErrorCode::format, place + ".ping_time: expected a whole number of nanoseconds");
  return SchoolKey{*time, voxel->channel, voxel->sample};
}

Result<SchoolKey> read_school(const nlohmann::json& args, TimeNs ping_time) {
  const auto found = args.find("school");
  if (found == args.end()) return fail(ErrorCode::format, "school: expected a voxel of it");
  return read_school(*found, "school", ping_time);
}

Result<std::optional<SchoolKey>> read_optional_school(const nlohmann::json& args, TimeNs ping_time) {
  if (!args.contains("school")) return std::optional<SchoolKey>{};
  const auto school = read_school(args, ping_time);
  if (!school) return pass_on(school);
  return std::optional<SchoolKey>(*school);
}

Result<TransferFunction> read_growth_curve(const nlohmann::json& args) {
  const auto found = args.find("growth_curve");
  if (found == args.end()) return TransferFunction{};
  return transfer_function_from_json(*found);
}

Result<std::string> read_text(const nlohmann::json& args, const std::string& member) {
  const auto found = args.find(member);
  if (found == args.end() || !found->is_string()) return fail(ErrorCode::format, member + ": expected a text");
  auto text = found->get<std::string>();
  if (text.size() > kMostText) {
    return fail(ErrorCode::bad_parameter, fmt::format("{}: is longer than {} bytes", member, kMostText));
  }
  if (std::any_of(text.begin(), text.end(), is_control)) {
    return fail(ErrorCode::bad_parameter, member + ": expected one line without control characters");
  }
  return text;
}

Result<std::size_t> read_choice(const nlohmann::json& args, const char* member,
                                std::span<const std::string_view> names) {
  const auto found = args.find(member);
  if (found != args.end() && found->is_string()) {
    const auto at = std::find(names.begin(), names.end(), found->get_ref<const std::string&>());
    if (at != names.end()) return static_cast<std::size_t>(at - names.begin());
  }
  return fail(ErrorCode::format, fmt::format("{}: expected one of {}", member, fmt::join(names, ", ")));
}

Result<TimeNs> read_time(const nlohmann::json& args, const char* member) {
  const auto found = args.find(member);
  const auto time = found == args.end() ? std::nullopt : whole_number(*found);
  if (!time) return fail(ErrorCode::format, fmt::format("{}: expected a whole number of nanoseconds", member));
  return *time;
}

}  // namespace sonar::members
