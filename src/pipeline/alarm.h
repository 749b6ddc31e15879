// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "model/school.h"

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

}  // namespace sonar
