// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "base/array.h"
#include "base/hash.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/survey/survey.h"
#include "school/detect/detection.h"

// While pings come in, an observation is worked out again and again from its first ping on, by the same code as ever. What that
// code made of pings about which nothing has changed is known: equal key, equal value.
namespace sonar {

/// Values by key; those that one look did not ask for are let go before the next.
/// threads  any
template <class Value>
class KeptByKey {
 public:
  /// Null where it is not known.
  [[nodiscard]] std::shared_ptr<const Value> find(const Hash128& key) {
    const std::scoped_lock lock(mutex_);
    const auto found = values_.find(key);
    if (found == values_.end()) return nullptr;
    found->second.asked_for = true;
    return found->second.value;
  }
  void put(const Hash128& key, std::shared_ptr<const Value> value) {
    const std::scoped_lock lock(mutex_);
    values_[key] = {std::move(value), true};
  }
  void forget_others() {
    const std::scoped_lock lock(mutex_);
    for (auto entry = values_.begin(); entry != values_.end();) {
      entry = std::exchange(entry->second.asked_for, false) ? std::next(entry) : values_.erase(entry);
    }
  }
  [[nodiscard]] std::size_t size() const {
    const std::scoped_lock lock(mutex_);
    return values_.size();
  }

 private:
  struct Entry {
    std::shared_ptr<const Value> value;
    bool asked_for = false;
  };
  mutable std::mutex mutex_;
  std::map<Hash128, Entry> values_;
};

/// What the stages up to detection made of an observation's pings.
struct KnownPings {
  struct Background {
    Array3<std::int16_t> levels;  ///< background_levels(); empty = none
    std::vector<float> given;     ///< by row, where a reduced file brings it
  };
  /// What was found in the pings of a group (group_water.h).
  struct Group {
    std::vector<std::vector<Detection>> detections;
    std::vector<std::vector<RefusedDetection>> refused;
  };
  KeptByKey<Background> backgrounds;
  KeptByKey<Group> groups;

  void forget_others() {
    backgrounds.forget_others();
    groups.forget_others();
  }
};

/// Of everything that the stages of a ping depend on, but for the bytes of its samples: published, these never change.
class PingKeys {
 public:
  PingKeys(const SurveyFiles& survey, const ObservationFiles& observation, const Recipe& recipe);

  /// Of Engine's estimate of a ping's background.
  [[nodiscard]] const Hash128& background(std::int64_t ping_index) const { return at(background_, ping_index); }
  /// Of Engine::staged(): the ping, those beside it, and the backgrounds of those in its window.
  [[nodiscard]] const Hash128& staged(std::int64_t ping_index) const { return at(staged_, ping_index); }
  /// Of what is measured in a ping: also where the ship was.
  [[nodiscard]] const Hash128& placed(std::int64_t ping_index) const { return at(placed_, ping_index); }

 private:
  static const Hash128& at(const std::vector<Hash128>& keys, std::int64_t ping_index) {
    return keys[static_cast<std::size_t>(ping_index)];
  }
  std::vector<Hash128> background_;
  std::vector<Hash128> staged_;
  std::vector<Hash128> placed_;
};

}  // namespace sonar
