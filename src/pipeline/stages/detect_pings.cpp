// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/detect_pings.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "base/hash.h"
#include "pipeline/stages/group_water.h"
#include "school/detect/detect.h"

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
        detected_(static_cast<std::size_t>(count_)) {
    for (std::int64_t i = 0; i < count_; ++i) begin_ping(i);
    if (engine.known() != nullptr) look_up_groups();
  }

  std::vector<DetectedPing> run(ObservationProduct& product) {
    const std::int64_t groups = reach_.last / kGroupPings + 1;
    const std::int64_t at_once = std::max<std::int64_t>(kLeastGroups, work_.threads());
    for (std::int64_t first = reach_.first / kGroupPings; first < groups && !work_.cancelled(); first += at_once) {
      const std::int64_t end = std::min(groups, first + at_once);
      const std::int64_t behind = std::min(count_, end * kGroupPings - reach_.first);
      stage_until(std::min(count_, behind + kGroupSide));
      work_.for_each(end - first, [&](std::int64_t i) { look_at(first + i); });
      forget_before(end < groups ? behind - kGroupSide : count_);
    }
    note_problems(product);
    return std::move(detected_);
  }

 private:
  void begin_ping(std::int64_t i) {
    DetectedPing& detected = detected_[static_cast<std::size_t>(i)];
    detected.ping_index = reach_.first + i;
    detected.time = engine_.observation().navigation[static_cast<std::size_t>(detected.ping_index)].time;
    detected.placement = engine_.tracking_placement(detected.ping_index);
  }

  /// Pings of a group, and of the window that its water is told by, as indices into the reach.
  struct Span {
    std::int64_t first;
    std::int64_t end;
  };
  [[nodiscard]] Span pings_of(std::int64_t group) const {
    return {std::max<std::int64_t>(0, group * kGroupPings - reach_.first),
            std::min(count_, (group + 1) * kGroupPings - reach_.first)};
  }
  [[nodiscard]] Span window_of(std::int64_t group) const {
    const Span pings = pings_of(group);
    return {std::max<std::int64_t>(0, pings.first - kGroupSide), std::min(count_, pings.end + kGroupSide)};
  }

  [[nodiscard]] Hash128 key_of(std::int64_t group) const {
    const Span pings = pings_of(group);
    const Span window = window_of(group);
    Hasher hasher;
    const auto add = [&hasher](const auto& value) { hasher.add(std::as_bytes(std::span(&value, 1))); };
    add(pings.first - window.first);
    add(pings.end - window.first);
    for (std::int64_t i = window.first; i < window.end; ++i) add(engine_.keys().staged(reach_.first + i));
    return hasher.value();
  }

  void look_up_groups() {
    needed_.assign(static_cast<std::size_t>(count_), false);
    for (std::int64_t group = reach_.first / kGroupPings; group <= reach_.last / kGroupPings; ++group) {
      const auto known = engine_.known()->groups.find(key_of(group));
      if (!known) {
        const Span window = window_of(group);
        std::fill(needed_.begin() + window.first, needed_.begin() + window.end, true);
        continue;
      }
      known_.insert(group);
      const Span pings = pings_of(group);
      for (std::int64_t i = pings.first; i < pings.end; ++i) {
        const auto from = static_cast<std::size_t>(i - pings.first);
        detected_[static_cast<std::size_t>(i)].detections = known->detections[from];
        detected_[static_cast<std::size_t>(i)].refused = known->refused[from];
      }
    }
  }

  /// One with a ping that could not be read is no group to remember: the next time it may be readable.
  void remember(std::int64_t group) {
    const Span window = window_of(group);
    for (std::int64_t i = window.first; i < window.end; ++i) {
      if (!problems_[static_cast<std::size_t>(i)].empty()) return;
    }
    const auto made = std::make_shared<KnownPings::Group>();
    const Span pings = pings_of(group);
    for (std::int64_t i = pings.first; i < pings.end; ++i) {
      made->detections.push_back(detected_[static_cast<std::size_t>(i)].detections);
      made->refused.push_back(detected_[static_cast<std::size_t>(i)].refused);
    }
    engine_.known()->groups.put(key_of(group), made);
  }

  void stage_until(std::int64_t end) {
    work_.for_each(end - next_, [&](std::int64_t i) {
      const auto at = static_cast<std::size_t>(next_ + i);
      const std::int64_t ping_index = detected_[at].ping_index;
      if (engine_.is_bad(ping_index) || (!needed_.empty() && !needed_[at])) return;
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
    if (known_.contains(group)) return;
    const Span pings = pings_of(group);
    const auto first = static_cast<std::size_t>(pings.first);
    const auto end = static_cast<std::size_t>(pings.end);
    const auto waters = waters_of(staged_, first, end, engine_.sector());
    for (std::size_t i = first; i < end; ++i) {
      if (const auto& water = waters[i - first]) judge(i, *water);
    }
    if (engine_.known() != nullptr && engine_.refusal()) remember(group);
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
  std::set<std::int64_t> known_;  ///< groups
  std::vector<bool> needed_;      ///< pings of groups that are not; empty = all
};

}  // namespace

std::vector<DetectedPing> detect_pings(Engine& engine, PingReach reach, ObservationProduct& product, Work& work) {
  if (reach.last < reach.first) return {};
  return Detecting(engine, reach, work).run(product);
}

}  // namespace sonar
