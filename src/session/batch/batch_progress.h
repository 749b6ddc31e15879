// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/tasks/plan.h"

namespace sonar {

/// How far the run of one survey is.
struct BatchProgress {
  std::string stage;             ///< "indexing", "detecting"; empty = nothing was told yet
  std::int64_t observation = 0;  ///< that is worked on, from 1; 0 = none
  std::int64_t observations = 0;
  std::int64_t pings = 0;     ///< done, those of finished observations among them
  std::int64_t of_pings = 0;  ///< 0 = not known yet
  double share = 0.0;         ///< 0 to 1
  std::optional<double> left_s;
};

/// "obs-2 of 3: detecting, 512 of 1 204 pings, 12 min left": what there is to say of it.
[[nodiscard]] std::string text_of(const BatchProgress& progress);
/// "8 s", "12 min", "3.5 h".
[[nodiscard]] std::string duration_text(double seconds);

/// Puts together what a run's Work tells of its stages.
/// threads  one at a time
class RunProgress {
 public:
  /// Pings are counted from here.
  void plan(const Plan& plan, double now_s);
  /// As Work tells it.
  void tell(std::string_view stage, std::int64_t done, std::int64_t total);
  /// Time left follows from pings that were worked on; observations whose products were right already took none.
  [[nodiscard]] BatchProgress now(double now_s) const;

 private:
  void begin_observation(std::int64_t index);
  [[nodiscard]] std::int64_t pings_of(std::int64_t index) const;

  std::string stage_;
  std::vector<std::int64_t> pings_;  ///< [observation]
  std::int64_t of_pings_ = 0;
  std::int64_t at_ = -1;      ///< index of the observation that is worked on
  double share_of_it_ = 0.0;  ///< done of that
  bool worked_ = false;       ///< something was done for it
  double finished_ = 0.0;     ///< pings of those before it
  double made_ = 0.0;         ///< those of them that were worked on
  double planned_s_ = 0.0;
};

}  // namespace sonar
