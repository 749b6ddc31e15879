// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "base/result.h"

namespace sonar {

// Every parameter struct P has one function
//   template <class Visitor> void describe(Visitor& v, P& p) {
//     v.field("minimum_range_m", p.minimum_range_m, {.unit = "m", .min = 0, .max = 500, .text = "what it does"});
//     v.choice("mode", p.mode, kModeNames, "what it chooses");       // enum class with values 0, 1, ...
//     v.group("median", p.median, "what the group is");              // another described struct
//   }
// JSON, command-line flags, panels, hashes and docs are visitors of it. Fields are bool, int, double or std::string.

/// Who sets a parameter: every user, or an expert who knows what it does.
enum class Tier : std::uint8_t { expert, basic };

struct FieldInfo {
  std::string_view unit = {};
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  std::string_view text = {};  ///< a sentence that can be read alone and says when one would change it
  Tier tier = Tier::expert;
  /// On a command line, where it is not the name with dashes; of a switch that is on, what turns it off.
  std::string_view flag = {};
  std::string_view suits = {};  ///< what it has an effect on, names between blanks; empty = all that its struct is for
};

/// Flag of a field that no command line has.
inline constexpr std::string_view kNoFlag = "-";

/// Of a choice: as FieldInfo.
struct ChoiceInfo {
  constexpr ChoiceInfo(const char* sentence, Tier whose = Tier::expert,  // NOLINT(google-explicit-constructor)
                       std::string_view where = {})
      : text(sentence), tier(whose), suits(where) {}
  std::string_view text;
  Tier tier;
  std::string_view suits;
};

using ChoiceNames = std::span<const std::string_view>;

/// Visitor that finds the first field outside its range.
class RangeCheck {
 public:
  void field(std::string_view, bool&, const FieldInfo&) {}
  void field(std::string_view, std::string&, const FieldInfo&) {}
  void field(std::string_view name, int& value, const FieldInfo& info) { check(name, value, info); }
  void field(std::string_view name, double& value, const FieldInfo& info) { check(name, value, info); }
  template <class E>
  void choice(std::string_view name, E& value, ChoiceNames names, const ChoiceInfo&) {
    const auto index = static_cast<std::size_t>(value);
    if (index >= names.size()) note(fmt::format("{}{}: value {} is none of its choices", prefix_, name, index));
  }
  template <class P>
  void group(std::string_view name, P& p, std::string_view) {
    const std::string outer = prefix_;
    prefix_ += std::string(name) + ".";
    describe(*this, p);
    prefix_ = outer;
  }
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  void check(std::string_view name, double value, const FieldInfo& info) {
    if (std::isnan(value) || value < info.min || value > info.max) {
      note(fmt::format("{}{} = {} is outside {} .. {}{}{}", prefix_, name, value, info.min, info.max,
                       info.unit.empty() || info.unit == "1" ? "" : " ", info.unit == "1" ? "" : info.unit));
    }
  }
  void note(std::string text) {
    if (problem_.empty()) problem_ = std::move(text);
  }
  std::string prefix_;
  std::string problem_;
};

/// Refuses a parameter struct with a field outside its described range; the error names the field.
template <class P>
Result<void> validate(P parameters) {
  RangeCheck check;
  describe(check, parameters);
  if (!check.problem().empty()) return fail(ErrorCode::bad_parameter, check.problem());
  return {};
}

}  // namespace sonar
