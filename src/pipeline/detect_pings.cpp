// SPDX-License-Identifier: Apache-2.0
#include "pipeline/detect_pings.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "pipeline/group_water.h"
#include "school/detect.h"

namespace sonar {
namespace {

constexpr std::int64_t kLeastGroups = 2;

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
    const std::int64_t groups = reach_.last / kGroupPings + 1;
    const std::int64_t at_once = std::max<std::int64_t>(kLeastGroups, work_.threads());
    for (std::int64_t first = reach_.first / kGroupPings; first < groups && !work_.cancelled(); first += at_once) {
      const std::int64_t end = std::min(groups, first + at_once);
      const std::int64_t behind = std::min(count_, end * kGroupPings - reach_.first);
      stage_until(std::min(count_, behind + kGroupSide), product);
      work_.for_each(end - first, [&](std::int64_t i) { look_at(first + i); });
      forget_before(end < groups ? behind - kGroupSide : count_);
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

  /// Groups are counted from the observation's first ping, whatever part of it is looked at.
  void look_at(std::int64_t group) {
    const auto first = static_cast<std::size_t>(std::max<std::int64_t>(0, group * kGroupPings - reach_.first));
    const auto end = static_cast<std::size_t>(std::min(count_, (group + 1) * kGroupPings - reach_.first));
    const auto waters = waters_of(staged_, first, end, engine_.sector());
    for (std::size_t i = first; i < end; ++i) {
      if (const auto& water = waters[i - first]) judge(i, *water);
    }
  }

  void judge(std::size_t at, const WaterLevels& water) {
    const auto& ping = staged_[at];
    DetectedPing& into = detected_[at];
    into.detections = detect(engine_.echo(*ping, water), engine_.recipe().detect, nullptr, &into.refused);
    work_.progress("detecting", ++done_, count_);
  }

  void forget_before(std::int64_t end) {
    for (; forgotten_ < end; ++forgotten_) {
      const auto at = static_cast<std::size_t>(forgotten_);
      if (staged_[at] && !detected_[at].detections.empty()) {
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
    std::erase_if(detected_,
                  [&](const DetectedPing& ping) { return ping.ping_index < 0 || engine_.is_bad(ping.ping_index); });
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
