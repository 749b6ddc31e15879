// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "pipeline/commands/command.h"
#include "pipeline/recipe/json_parameters.h"
#include "pipeline/recipe/transfer_function_json.h"

// Members of commands, to and from JSON, by their types. Every error names the member.
namespace sonar::members {

[[nodiscard]] inline nlohmann::json json_of(bool value) { return value; }
[[nodiscard]] inline nlohmann::json json_of(std::int64_t value) { return value; }
[[nodiscard]] inline nlohmann::json json_of(const std::string& value) { return value; }
[[nodiscard]] nlohmann::json json_of(const SeedKey& seed);
[[nodiscard]] nlohmann::json json_of(const RunKey& run);
[[nodiscard]] nlohmann::json json_of(const SchoolKey& school);
[[nodiscard]] inline nlohmann::json json_of(const TransferFunction& curve) { return to_json(curve); }
template <class T>
[[nodiscard]] nlohmann::json json_of(const std::vector<T>& list) {
  nlohmann::json json = nlohmann::json::array();
  for (const T& one : list) json.push_back(json_of(one));
  return json;
}
/// A described parameter struct.
template <class P>
[[nodiscard]] nlohmann::json json_of(const P& parameters) {
  P copy = parameters;
  JsonWriter writer;
  describe(writer, copy);
  return writer.json();
}

/// A member as a line has it.
struct Member {
  const nlohmann::json* value = nullptr;  ///< null = absent
  std::string name;
  TimeNs ping_time = 0;  ///< of the line: that of a school that names none
};

// errors  format, bad_parameter
/// Absent = as it is.
[[nodiscard]] Result<void> read(const Member& from, bool& to);
/// One line of text without control characters, so that every table can hold it.
[[nodiscard]] Result<void> read(const Member& from, std::string& to);
[[nodiscard]] Result<void> read(const Member& from, SeedKey& to);
[[nodiscard]] Result<void> read(const Member& from, SchoolKey& to);
/// One or more.
[[nodiscard]] Result<void> read(const Member& from, std::vector<SeedKey>& to);
[[nodiscard]] Result<void> read(const Member& from, std::vector<RunKey>& to);
/// Two or more.
[[nodiscard]] Result<void> read(const Member& from, std::vector<SchoolKey>& to);
/// Absent = the linear default.
[[nodiscard]] Result<void> read(const Member& from, TransferFunction& to);
/// A described parameter struct; absent = its defaults.
template <class P>
[[nodiscard]] Result<void> read(const Member& from, P& to) {
  if (from.value == nullptr) return {};
  JsonReader reader(*from.value, from.name + ".");
  describe(reader, to);
  reader.finish();
  if (!reader.problem().empty()) return fail(ErrorCode::bad_parameter, reader.problem());
  return validate(to);
}
/// errors  format: absent, or none of the names
[[nodiscard]] Result<std::size_t> read_choice(const Member& from, std::span<const std::string_view> names);
/// errors  format: absent, or no whole number within the bounds
/// expected  "a whole number of nanoseconds"
[[nodiscard]] Result<std::int64_t> read_number(const Member& from, const std::string& expected, std::int64_t least,
                                               std::int64_t most);

}  // namespace sonar::members
