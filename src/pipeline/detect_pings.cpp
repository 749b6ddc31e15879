// SPDX-License-Identifier: Apache-2.0
#include "pipeline/detect_pings.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>

#include "school/detect.h"
#include "school/evidence/null_model.h"

namespace sonar {
namespace {

constexpr std::int64_t kGroup = 5;  ///< pings that are judged by one null model ...
constexpr std::int64_t kSide = 3;   ///< ... with so many before and behind them
constexpr std::int64_t kLeastGroups = 4;

class Detecting {
 public:
  Detecting(Engine& engine, PingReach reach, Work& work)
      : engine_(engine),
        reach_(reach),
        work_(work),
        count_(reach.last - reach.first + 1),
        staged_(static_cast<std::size_t>(count_)),
        problems_(static_cast<std::size_t>(count_)),
        detected_(static_cast<std::size_t>(count_)) {}

  std::vector<DetectedPing> run(ObservationProduct& product) {
    const std::int64_t groups = (count_ + kGroup - 1) / kGroup;
    const std::int64_t at_once = std::max<std::int64_t>(kLeastGroups, work_.threads());
    for (std::int64_t first = 0; first < groups && !work_.cancelled(); first += at_once) {
      const std::int64_t end = std::min(groups, first + at_once);
      stage_until(std::min(count_, end * kGroup + kSide), product);
      work_.for_each(end - first, [&](std::int64_t i) { look_at(first + i); });
      forget_before(end * kGroup - kSide);
    }
    note_problems(product);
    return std::move(detected_);
  }

 private:
  void stage_until(std::int64_t end, const ObservationProduct& product) {
    work_.for_each(end - next_, [&](std::int64_t i) {
      const auto at = static_cast<std::size_t>(next_ + i);
      const std::int64_t ping_index = reach_.first + next_ + i;
      DetectedPing& detected = detected_[at];
      detected.ping_index = ping_index;
      detected.time = product.pings[static_cast<std::size_t>(ping_index)].time;
      detected.placement = engine_.tracking_placement(ping_index);
      if (engine_.is_bad(ping_index)) return;
      auto ping = engine_.staged(ping_index);
      if (ping) {
        staged_[at] = std::make_shared<StagedPing>(std::move(*ping));
      } else {
        problems_[at] = ping.error().text;
      }
    });
    next_ = std::max(next_, end);
  }

  void look_at(std::int64_t group) {
    const std::int64_t from = std::max<std::int64_t>(0, group * kGroup - kSide);
    const std::int64_t to = std::min(count_, (group + 1) * kGroup + kSide);
    std::vector<WaterPing> window;
    std::vector<std::size_t> of_window;
    for (std::int64_t i = from; i < to; ++i) {
      const auto& ping = staged_[static_cast<std::size_t>(i)];
      if (!ping || ping->water) continue;
      of_window.push_back(static_cast<std::size_t>(i));
      window.push_back({&ping->means, &ping->seabed, ping->background()});
    }
    std::vector<WaterLevels> levels = water_levels(window, engine_.sector(), kLeastEvidence);
    for (std::size_t w = 0; w < levels.size(); ++w) {
      if (static_cast<std::int64_t>(of_window[w]) / kGroup == group) judge(of_window[w], levels[w]);
    }
    // reduced files bring what the whole ones told
    for (std::int64_t i = group * kGroup; i < std::min(count_, (group + 1) * kGroup); ++i) {
      const auto& ping = staged_[static_cast<std::size_t>(i)];
      if (ping && ping->water) judge(static_cast<std::size_t>(i), *ping->water);
    }
  }

  void judge(std::size_t at, const WaterLevels& water) {
    const auto& ping = staged_[at];
    detected_[at].detections = detect(engine_.echo(*ping, water), engine_.recipe().detect);
    work_.progress("detecting", ++done_, count_);
  }

  void forget_before(std::int64_t end) {
    for (; forgotten_ < end; ++forgotten_) {
      const auto at = static_cast<std::size_t>(forgotten_);
      if (staged_[at] && !detected_[at].detections.empty()) {
        staged_[at]->sv.flags = {};  // measuring looks at those with the seabed
        staged_[at]->means = {};
        engine_.keep(std::move(staged_[at]));
      }
      staged_[at].reset();
    }
  }

  void note_problems(ObservationProduct& product) {
    for (std::size_t i = 0; i < problems_.size(); ++i) {
      if (problems_[i].empty()) continue;
      product.pings[static_cast<std::size_t>(detected_[i].ping_index)].bad = true;
      product.diagnostics.push_back(
          {DiagnosticCode::ping_unreadable, "", -1, detected_[i].ping_index, std::move(problems_[i])});
      detected_[i].ping_index = -1;
    }
    // To the tracker such a ping never was: that no school shows there says nothing.
    std::erase_if(detected_, [&](const DetectedPing& ping) {
      return ping.ping_index < 0 || engine_.is_bad(ping.ping_index);
    });
  }

  Engine& engine_;
  PingReach reach_;
  Work& work_;
  std::int64_t count_;
  std::int64_t next_ = 0;       ///< first ping that is not staged yet
  std::int64_t forgotten_ = 0;  ///< first ping that may still be
  std::atomic<std::int64_t> done_{0};
  std::vector<std::shared_ptr<StagedPing>> staged_;
  std::vector<std::string> problems_;
  std::vector<DetectedPing> detected_;
};

}  // namespace

std::vector<DetectedPing> detect_pings(Engine& engine, PingReach reach, ObservationProduct& product, Work& work) {
  if (reach.last < reach.first) return {};
  return Detecting(engine, reach, work).run(product);
}

}  // namespace sonar
