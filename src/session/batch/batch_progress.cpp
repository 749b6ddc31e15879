// SPDX-License-Identifier: Apache-2.0
#include "session/batch/batch_progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/number_text.h"
#include "pipeline/tasks/run.h"

namespace sonar {
namespace {

/// Of an observation's time, as it was measured; every stage goes over its pings.
struct Stage {
  std::string_view name;
  double begins;
  double ends;
};
constexpr std::array<Stage, 3> kStages{{{"background", 0.0, 0.2}, {"detecting", 0.2, 0.9}, {"measuring", 0.9, 1.0}}};

constexpr double kLeastShare = 0.02;  ///< from which on the time left is told

}  // namespace

std::string duration_text(double seconds) {
  const auto whole = std::llround(seconds);
  if (whole < 100) return fmt::format("{} s", whole);
  return whole < 6000 ? fmt::format("{} min", (whole + 30) / 60) : fmt::format("{:.1f} h", seconds / 3600.0);
}

std::string text_of(const BatchProgress& progress) {
  std::string text = progress.stage;
  if (progress.observation > 0) {
    text = fmt::format("observation {} of {}: {}", progress.observation, progress.observations, text);
  }
  if (progress.of_pings > 0) {
    text += fmt::format("{}{} of {} pings", text.empty() ? "" : ", ", grouped(static_cast<std::size_t>(progress.pings)),
                        grouped(static_cast<std::size_t>(progress.of_pings)));
  }
  if (progress.left_s) text += fmt::format(", {} left", duration_text(*progress.left_s));
  return text;
}

void RunProgress::plan(const Plan& plan, double now_s) {
  for (const PlanTask& task : plan.tasks) {
    pings_.push_back(task.pings);
    of_pings_ += task.pings;
  }
  planned_s_ = now_s;
}

std::int64_t RunProgress::pings_of(std::int64_t index) const {
  return index >= 0 && index < std::ssize(pings_) ? pings_[static_cast<std::size_t>(index)] : 0;
}

void RunProgress::begin_observation(std::int64_t index) {
  const auto before = static_cast<double>(pings_of(at_));
  finished_ += before;
  if (worked_) made_ += before;
  at_ = index;
  share_of_it_ = 0.0;
  worked_ = false;
}

void RunProgress::tell(std::string_view stage, std::int64_t done, std::int64_t total) {
  if (stage == kObservations) return begin_observation(done);
  stage_ = stage;
  const auto known = std::find_if(kStages.begin(), kStages.end(), [&](const Stage& one) { return one.name == stage; });
  if (known == kStages.end() || total <= 0 || pings_of(at_) == 0) return;
  worked_ = true;
  const double of_stage = std::clamp(static_cast<double>(done) / static_cast<double>(total), 0.0, 1.0);
  share_of_it_ = std::max(share_of_it_, known->begins + (known->ends - known->begins) * of_stage);
}

BatchProgress RunProgress::now(double now_s) const {
  BatchProgress progress;
  progress.stage = stage_;
  progress.observations = std::ssize(pings_);
  progress.observation = at_ >= 0 && at_ < std::ssize(pings_) ? at_ + 1 : 0;
  progress.of_pings = of_pings_;
  if (of_pings_ == 0) return progress;
  const double of_it = share_of_it_ * static_cast<double>(pings_of(at_));
  const double all = static_cast<double>(of_pings_);
  progress.pings = std::llround(finished_ + of_it);
  progress.share = std::clamp((finished_ + of_it) / all, 0.0, 1.0);
  const double made = made_ + of_it;
  const double left = all - finished_ - of_it;
  if (made > 0.0 && made >= kLeastShare * (made + left)) progress.left_s = (now_s - planned_s_) * left / made;
  return progress;
}

}  // namespace sonar
