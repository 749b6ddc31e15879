// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.h"
#include "model/school.h"
#include "pipeline/live/live_schools.h"

namespace sonar {

/// A rule that calls somebody: "volume_m3 > 20000, range_m < 150" holds where all its comparisons do. Names are numeric
/// columns of school_pings.csv; a column that is not known compares with nothing.
class Alarm {
 public:
  /// errors  usage: what was expected, and where
  [[nodiscard]] static Result<Alarm> parse(std::string_view rule);

  [[nodiscard]] bool holds(const SchoolPingRow& row) const;
  /// As it was given.
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  struct Comparison {
    std::string column;
    bool above = false;  ///< > ; else <
    double limit = 0.0;
  };
  std::string text_;
  std::vector<Comparison> comparisons_;
};

/// Several of them, watched: each rings when a school begins to fit, and again only after it did not.
/// threads  one
class Alarms {
 public:
  explicit Alarms(std::vector<Alarm> alarms = {}) : alarms_(std::move(alarms)) {}

  /// A rule that a school fits now, and where it was when it did.
  struct Ringing {
    std::string rule;
    LiveSchool school;
  };
  [[nodiscard]] std::vector<Ringing> ring(std::span<const LiveSchool> schools);

 private:
  std::vector<Alarm> alarms_;
  std::set<std::pair<std::string, std::string>> rung_;  ///< school, rule: told, and still so
};

}  // namespace sonar
