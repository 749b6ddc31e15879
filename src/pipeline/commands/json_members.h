// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "pipeline/commands/command.h"
#include "pipeline/recipe/json_parameters.h"

// Members that several commands have, to and from JSON. Every error names the member.
namespace sonar::members {

template <class P>
nlohmann::json described(P parameters) {
  JsonWriter writer;
  describe(writer, parameters);
  return writer.json();
}

/// A described parameter struct; absent = its defaults.
/// errors  bad_parameter
template <class P>
Result<P> read_described(const nlohmann::json& args, const char* member) {
  P parameters;
  const auto found = args.find(member);
  if (found == args.end()) return parameters;
  JsonReader reader(*found, std::string(member) + ".");
  describe(reader, parameters);
  reader.finish();
  if (!reader.problem().empty()) return fail(ErrorCode::bad_parameter, reader.problem());
  if (const auto valid = validate(parameters); !valid) return pass_on(valid);
  return parameters;
}

[[nodiscard]] nlohmann::json from_seed(const SeedKey& seed);
[[nodiscard]] nlohmann::json from_seeds(const std::vector<SeedKey>& seeds);
[[nodiscard]] nlohmann::json from_runs(const std::vector<RunKey>& runs);
[[nodiscard]] nlohmann::json from_school(const SchoolKey& school);

[[nodiscard]] Result<SeedKey> read_seed(const nlohmann::json& json, const std::string& place);
[[nodiscard]] Result<std::vector<SeedKey>> read_seeds(const nlohmann::json& args);
[[nodiscard]] Result<std::vector<RunKey>> read_runs(const nlohmann::json& args);
/// ping_time  of the line: that of the school where it names none
[[nodiscard]] Result<SchoolKey> read_school(const nlohmann::json& json, const std::string& place, TimeNs ping_time);
[[nodiscard]] Result<SchoolKey> read_school(const nlohmann::json& args, TimeNs ping_time);
[[nodiscard]] Result<std::optional<SchoolKey>> read_optional_school(const nlohmann::json& args, TimeNs ping_time);
/// The linear default where there is none.
[[nodiscard]] Result<TransferFunction> read_growth_curve(const nlohmann::json& args);
/// One line of text without control characters, so that every table can hold it.
[[nodiscard]] Result<std::string> read_text(const nlohmann::json& args, const std::string& member);
/// errors  format: absent, or none of the names
[[nodiscard]] Result<std::size_t> read_choice(const nlohmann::json& args, const char* member,
                                              std::span<const std::string_view> names);
[[nodiscard]] Result<TimeNs> read_time(const nlohmann::json& args, const char* member);

}  // namespace sonar::members
