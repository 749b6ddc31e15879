// SPDX-License-Identifier: Apache-2.0
#include "pipeline/recipe/json_file.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "io/atomic_file.h"

namespace sonar {
namespace {

/// A wrong file does not fill the memory.
constexpr std::uint64_t kLimit = 256U << 20U;
/// None of our files nests so deep; the library calls itself once a level when it writes, copies or compares.
constexpr int kMostNested = 100;

/// Where the text nests too deep; -1 = nowhere.
std::int64_t too_deep_at(std::string_view text) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '\\') ++i;
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if ((c == '[' || c == '{') && ++depth > kMostNested) return static_cast<std::int64_t>(i);
    if (c == ']' || c == '}') --depth;
  }
  return -1;
}

}  // namespace

Result<nlohmann::json> parse_json(std::string_view text) {
  Where where;
  where.offset = too_deep_at(text);
  if (where.offset >= 0) return fail(ErrorCode::format, "expected JSON that nests less deep", where);
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    // The library reports parse errors only by exception; it ends here.
    where.offset = static_cast<std::int64_t>(error.byte);
    return fail(ErrorCode::format, "expected JSON", where);
  } catch (const nlohmann::json::out_of_range&) {
    return fail(ErrorCode::format, "expected JSON; a number is too large");
  }
}

Result<nlohmann::json> read_json_file(const std::string& path) {
  const auto text = read_file(path, kLimit);
  if (!text) return pass_on(text);
  auto json = parse_json(*text);
  if (!json) return fail(json.error().code, json.error().text, {path, json.error().where.offset});
  return json;
}

Result<void> write_json_file(const std::string& path, const nlohmann::json& json) {
  return write_file(path, json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

std::optional<std::int64_t> whole_number(const nlohmann::json& json, std::int64_t least, std::int64_t most) {
  if (!json.is_number_integer()) return std::nullopt;
  const auto value = json.get<std::int64_t>();
  // The library keeps what does not fit into 63 bits as an unsigned number, and would wrap it round.
  if (json.is_number_unsigned() && value < 0) return std::nullopt;
  if (value < least || value > most) return std::nullopt;
  return value;
}

Result<void> check_version(const nlohmann::json& json, const char* member, int current) {
  const auto found = json.find(member);
  const auto version = found == json.end() ? std::nullopt : whole_number(*found);
  if (!version) return fail(ErrorCode::format, fmt::format("expected a whole number {}", member));
  if (*version > current) {
    return fail(ErrorCode::newer_version,
                fmt::format("{} is {}, this program reads up to {}: use a newer program", member, *version, current));
  }
  if (*version < 1) return fail(ErrorCode::older_version, fmt::format("{} is {}: run again", member, *version));
  return {};
}

}  // namespace sonar
