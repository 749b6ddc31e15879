// SPDX-License-Identifier: Apache-2.0
#include "pipeline/json_file.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "io/atomic_file.h"

namespace sonar {
namespace {

/// A wrong file does not fill the memory.
constexpr std::uint64_t kLimit = 256U << 20U;

}  // namespace

Result<nlohmann::json> parse_json(std::string_view text) {
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    // The library reports parse errors only by exception; it ends here.
    Where where;
    where.offset = static_cast<std::int64_t>(error.byte);
    return fail(ErrorCode::format, "expected JSON", where);
  }
}

Result<nlohmann::json> read_json_file(const std::string& path) {
  const auto text = read_file(path, kLimit);
  if (!text) return pass_on(text);
  auto json = parse_json(*text);
  if (!json) return fail(json.error().code, json.error().text, {path, json.error().where.offset});
  return json;
}

Result<void> check_version(const nlohmann::json& json, const char* member, int current) {
  const auto found = json.find(member);
  if (found == json.end() || !found->is_number_integer()) {
    return fail(ErrorCode::format, fmt::format("expected a whole number {}", member));
  }
  const auto version = found->get<std::int64_t>();
  if (version > current) {
    return fail(ErrorCode::newer_version,
                fmt::format("{} is {}, this program reads up to {}: use a newer program", member, version, current));
  }
  if (version < 1) return fail(ErrorCode::older_version, fmt::format("{} is {}: run again", member, version));
  return {};
}

}  // namespace sonar
