// SPDX-License-Identifier: Apache-2.0
#include "pipeline/commands/json_members.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "pipeline/recipe/json_file.h"

namespace sonar::members {
namespace {

using nlohmann::json;

constexpr std::int64_t kMostInt = std::numeric_limits<int>::max();

tl::unexpected<Error> expected(const Member& from, std::string_view what) {
  return fail(ErrorCode::format, fmt::format("{}: expected {}", from.name, what));
}

std::optional<int> number(const Member& from, const char* member) {
  if (from.value == nullptr || !from.value->is_object()) return std::nullopt;
  const auto found = from.value->find(member);
  const auto whole = found == from.value->end() ? std::nullopt : whole_number(*found, 0, kMostInt);
  return whole ? std::optional(static_cast<int>(*whole)) : std::nullopt;
}

/// Bytes of UTF-8 above 0x7f are no control characters.
bool is_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x20 || byte == 0x7f;
}

Result<void> read(const Member& from, RunKey& to) {
  const auto part = [&](std::size_t i, std::int64_t least) {
    const json& run = *from.value;
    return run.is_array() && run.size() == 3 ? whole_number(run[i], least, kMostInt) : std::nullopt;
  };
  const auto channel = part(0, 0);
  const auto sample = part(1, 0);
  const auto count = part(2, 1);
  if (!channel || !sample || !count || *sample + *count > kMostInt) return expected(from, "[channel, sample, count]");
  to = {static_cast<int>(*channel), static_cast<int>(*sample), static_cast<int>(*count)};
  return {};
}

template <class T>
Result<void> read_list(const Member& from, std::size_t least, std::string_view what, std::vector<T>& to) {
  if (from.value == nullptr || !from.value->is_array() || from.value->size() < least) return expected(from, what);
  for (const json& one : *from.value) {
    const Member element{&one, fmt::format("{}[{}]", from.name, to.size()), from.ping_time};
    if (auto done = read(element, to.emplace_back()); !done) return done;
  }
  return {};
}

}  // namespace

json json_of(const SeedKey& seed) { return {{"channel", seed.channel}, {"sample", seed.sample}}; }

json json_of(const RunKey& run) { return json::array({run.channel, run.sample, run.count}); }

json json_of(const SchoolKey& school) {
  return {{"ping_time", school.ping_time}, {"channel", school.channel}, {"sample", school.sample}};
}

Result<void> read(const Member& from, bool& to) {
  if (from.value == nullptr) return {};
  if (!from.value->is_boolean()) return expected(from, "true or false");
  to = from.value->get<bool>();
  return {};
}

Result<void> read(const Member& from, std::string& to) {
  if (from.value == nullptr || !from.value->is_string()) return expected(from, "a text");
  auto text = from.value->get<std::string>();
  if (text.size() > kMostTextBytes) {
    return fail(ErrorCode::bad_parameter, fmt::format("{}: is longer than {} bytes", from.name, kMostTextBytes));
  }
  if (std::any_of(text.begin(), text.end(), is_control)) {
    return fail(ErrorCode::bad_parameter, from.name + ": expected one line without control characters");
  }
  to = std::move(text);
  return {};
}

Result<void> read(const Member& from, SeedKey& to) {
  const auto channel = number(from, "channel");
  const auto sample = number(from, "sample");
  if (!channel || !sample) return expected(from, "channel and sample");
  to = {*channel, *sample};
  return {};
}

Result<void> read(const Member& from, SchoolKey& to) {
  if (from.value == nullptr) return expected(from, "a voxel of it");
  SeedKey voxel;
  if (auto done = read(from, voxel); !done) return done;
  to = {from.ping_time, voxel.channel, voxel.sample};
  const auto time = from.value->find("ping_time");
  if (time == from.value->end()) return {};
  const auto whole = whole_number(*time);
  if (!whole) return fail(ErrorCode::format, from.name + ".ping_time: expected a whole number of nanoseconds");
  to.ping_time = *whole;
  return {};
}

Result<void> read(const Member& from, std::vector<SeedKey>& to) { return read_list(from, 1, "an array of voxels", to); }

Result<void> read(const Member& from, std::vector<RunKey>& to) {
  return read_list(from, 1, "an array of [channel, sample, count]", to);
}

Result<void> read(const Member& from, std::vector<SchoolKey>& to) {
  return read_list(from, 2, "an array of two or more voxels", to);
}

Result<void> read(const Member& from, TransferFunction& to) {
  if (from.value == nullptr) return {};
  auto curve = transfer_function_from_json(*from.value);
  if (!curve) return pass_on(curve);
  to = std::move(*curve);
  return {};
}

Result<std::size_t> read_choice(const Member& from, std::span<const std::string_view> names) {
  if (from.value != nullptr && from.value->is_string()) {
    const auto at = std::find(names.begin(), names.end(), from.value->get_ref<const std::string&>());
    if (at != names.end()) return static_cast<std::size_t>(at - names.begin());
  }
  return expected(from, fmt::format("one of {}", fmt::join(names, ", ")));
}

Result<std::int64_t> read_number(const Member& from, const std::string& what, std::int64_t least, std::int64_t most) {
  const auto number = from.value == nullptr ? std::nullopt : whole_number(*from.value, least, most);
  if (!number) return expected(from, what);
  return *number;
}

}  // namespace sonar::members
