// SPDX-License-Identifier: Apache-2.0
#include "session/recipes/recipe_preview.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "base/number_text.h"
#include "base/units.h"
#include "session/slices/slice_places.h"

namespace sonar {
namespace {

/// The wished ping under another recipe.
Result<void> stage_under(const Recipe& recipe, SliceWish& wish) {
  const std::shared_ptr<const SurveyFiles> survey(wish.observation, &wish.observation->survey());
  OpenObservation under(survey, wish.observation->index(), recipe, 0);
  auto made = under.ping(wish.ping->ping_index);
  if (!made) return pass_on(made);
  wish.ping = std::move(*made);
  return {};
}

/// As those that a run finds and nobody has looked at yet.
std::vector<SchoolLayer> layers_of(const std::shared_ptr<const std::vector<PingSchool>>& schools) {
  std::vector<SchoolLayer> layers;
  for (const PingSchool& school : *schools) {
    const auto number = static_cast<std::int64_t>(layers.size()) + 1;
    layers.push_back({number,
                      false,
                      mask_layer(std::shared_ptr<const PingMask>(schools, &school.mask),
                                 school_colour(static_cast<int>(number)), "unreviewed"),
                      {},
                      true});
  }
  return layers;
}

}  // namespace

ReadyPings::Key ReadyPings::key_of(OpenObservationPtr observation, std::int64_t ping_index, Recipe recipe) {
  recipe.detect = {};
  return {std::move(observation), ping_index, recipe_hash(recipe)};
}

std::shared_ptr<const PingBeforeDetection> ReadyPings::find(const Key& key) const {
  const std::scoped_lock lock(mutex_);
  for (const auto& [of, ping] : kept_) {
    if (of == key) return ping;
  }
  return nullptr;
}

Result<std::shared_ptr<const PingBeforeDetection>> ReadyPings::made(const Key& key, const Recipe& recipe,
                                                                    const CancelToken& token) {
  constexpr std::size_t kMost = 2;
  std::unique_lock one_at_a_time(making_, std::defer_lock);
  while (!one_at_a_time.try_lock_for(std::chrono::milliseconds(20))) {
    if (token.cancelled()) return fail(ErrorCode::cancelled, "a later edit came");
  }
  if (auto there = find(key)) return there;
  Work work(1);
  work.set_progress([&](std::string_view, std::int64_t, std::int64_t) {
    if (token.cancelled()) work.cancel();
  });
  const OpenObservation& observation = *key.observation;
  auto ping = PingBeforeDetection::of(observation.survey(), observation.files(), recipe, key.ping_index, work);
  if (!ping) return ping;
  const std::scoped_lock lock(mutex_);
  kept_.emplace_back(key, *ping);
  if (kept_.size() > kMost) kept_.pop_front();
  return ping;
}

RecipePreview::RecipePreview(Workspace& workspace, ReadyPings& ready, RecipeEditor* edited)
    : LivePicture(workspace), workspace_(workspace), ready_(ready), edited_(edited) {
  const auto anew = [this] { update(); };
  listening_.to(workspace.document.changes(), [this](DocumentChange change) {
    if (change == DocumentChange::ping || change == DocumentChange::observation) update();
  });
  listening_.to(workspace.slices.changed(), anew);
  listening_.to(workspace.dark.changed(), anew);
  listening_.to(workspace.display, anew);
  if (edited != nullptr) listening_.to(edited->parameters(), anew);
}

SliceWish RecipePreview::wished(const PictureLook& look) const {
  SliceWish wish;
  wish.observation = workspace_.document.shown();
  wish.ping = workspace_.document.staged();
  wish.display = workspace_.display.values();
  wish.display.filtered = true;
  const SliceInUse& in_use = workspace_.slice_in_use();
  const auto ping = static_cast<std::size_t>(wish.ping->ping_index);
  const double heading_deg = wish.observation->files().navigation[ping].heading_deg;
  const Slice slice = live_slice(workspace_, in_use.kind, wish.ping->ping_index);
  wish.north_up = seen_from_above(slice) && wish.display.north_up && !std::isnan(heading_deg);
  wish.view = {slice, wish.north_up ? -rad_from_deg(heading_deg) : 0.0, in_use.extent};
  wish.colours = std::make_shared<const SvColours>(slice_colours(workspace_));
  wish.look = look;
  wish.room = std::make_shared<FlagRoom>();
  return wish;
}

LivePicture::Build RecipePreview::build(const PictureLook& look) {
  const Document& document = workspace_.document;
  if (!document.shown() || !document.staged()) return {};
  SliceWish wish = wished(look);
  const Recipe detecting = edited_ != nullptr ? edited_->recipe() : document.recipe();
  std::optional<Recipe> shown;
  if (edited_ != nullptr) {
    shown = detecting;
    // A calibration that was chosen for the survey holds for what is seen, whatever the recipe says; schools are found
    // without it.
    const Recipe measuring = document.measuring_recipe();
    if (recipe_hash(measuring) != recipe_hash(document.recipe())) shown->calibration = measuring.calibration;
  }
  const ReadyPings::Key key = ReadyPings::key_of(wish.observation, wish.ping->ping_index, detecting);
  return [&ready = ready_, wish = std::move(wish), detecting, key, shown = std::move(shown)](
             PixelSize size, const CancelToken& token, const Show& show) mutable -> Result<void> {
    if (auto valid = validate_recipe(detecting); !valid) return valid;
    if (shown) {
      if (auto staged = stage_under(*shown, wish); !staged) return staged;
      if (token.cancelled()) return fail(ErrorCode::cancelled, "a later edit came");
    }
    const auto put = [&](const std::shared_ptr<const Schools>& schools) -> Result<void> {
      wish.layers = schools && wish.display.masks ? layers_of(schools) : std::vector<SchoolLayer>{};
      auto picture = slice_of(wish, size);
      if (!picture) return pass_on(picture);
      show({std::move(picture->frame), std::nullopt, schools});
      return {};
    };
    auto ping = ready.find(key);
    if (!ping) {
      if (auto first = put(nullptr); !first) return first;
      auto made = ready.made(key, detecting, token);
      if (!made) return pass_on(made);
      ping = std::move(*made);
    }
    return put(std::make_shared<const Schools>(ping->schools(detecting.detect)));
  };
}

void RecipePreview::take(const std::shared_ptr<const void>& detail) {
  schools_ = std::static_pointer_cast<const Schools>(detail);
}

std::string RecipePreview::schools_text() const {
  if (image().size.width < 1) return {};
  if (!schools_) return "schools are being looked for";
  const Schools& schools = *schools_;
  if (schools.empty()) return "no school in this ping";
  const double volume_m3 = std::accumulate(schools.begin(), schools.end(), 0.0,
                                           [](double sum, const PingSchool& one) { return sum + one.volume_m3; });
  return fmt::format("{} in this ping, {} m\u00B3 in all", count_of(schools.size(), "school"),
                     grouped(static_cast<std::size_t>(std::llround(volume_m3))));
}

}  // namespace sonar
