// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/recipe/recipe.h"
#include "pipeline/stages/ping_schools.h"
#include "session/listening.h"
#include "session/live/live_picture.h"
#include "session/open/workspace.h"
#include "session/recipes/recipe_editor.h"
#include "session/slices/slice_build.h"

namespace sonar {

/// Pings made ready for detection, the last two: the recipes before and after an edit have one in common until more than
/// detection differs, and detection itself takes next to no time.
/// threads  any
class ReadyPings {
 public:
  /// What detection works on; equal keys, equal pings.
  struct Key {
    OpenObservationPtr observation;
    std::int64_t ping_index = 0;
    std::string recipe_hash;  ///< of the recipe without its detection
    friend bool operator==(const Key&, const Key&) = default;
  };
  [[nodiscard]] static Key key_of(OpenObservationPtr observation, std::int64_t ping_index, Recipe recipe);

  /// Null where the ping is still to be made.
  [[nodiscard]] std::shared_ptr<const PingBeforeDetection> find(const Key& key) const;
  /// Made where it is not there; others wait meanwhile, until they are cancelled.
  /// errors  as PingBeforeDetection::of()
  [[nodiscard]] Result<std::shared_ptr<const PingBeforeDetection>> made(const Key& key, const Recipe& recipe,
                                                                        const CancelToken& token);

 private:
  std::timed_mutex making_;
  mutable std::mutex mutex_;
  std::deque<std::pair<Key, std::shared_ptr<const PingBeforeDetection>>> kept_;
};

/// The slice in use of the ping looked at: Sv after noise removal and filter, under the recipe in force or under the one that
/// is edited; both in the same place and colours, with the schools that detection finds in this ping under that recipe:
/// where that takes a while, the first picture is without them. The next edit cancels what is being made.
class RecipePreview : public LivePicture {
 public:
  /// All outlive the picture.
  /// edited  whose recipe it shows; null = the one in force
  RecipePreview(Workspace& workspace, ReadyPings& ready, RecipeEditor* edited);
  [[nodiscard]] bool refines() const override { return true; }
  /// What detection finds in this ping, in words; empty without a picture.
  [[nodiscard]] std::string schools_text() const;

 protected:
  [[nodiscard]] Build build(const PictureLook& look) override;
  void take(const std::shared_ptr<const void>& detail) override;

 private:
  using Schools = std::vector<PingSchool>;
  [[nodiscard]] SliceWish wished(const PictureLook& look) const;

  Workspace& workspace_;
  ReadyPings& ready_;
  RecipeEditor* edited_;
  std::shared_ptr<const Schools> schools_;  ///< null = they are being looked for
  Listening listening_;                     // the last member: it ends first
};

/// Before and after an edit, beside each other.
struct RecipeComparison {
  RecipeComparison(Workspace& shared, RecipeEditor& editor)
      : workspace(shared), in_force(shared, ready, nullptr), edited(shared, ready, &editor) {}
  Workspace& workspace;
  ReadyPings ready;
  RecipePreview in_force;
  RecipePreview edited;
};

}  // namespace sonar
