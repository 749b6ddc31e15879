// SPDX-License-Identifier: Apache-2.0
#include "session/recipe_preview.h"

#include <cmath>
#include <utility>

#include "base/units.h"
#include "session/slices/slice_build.h"
#include "session/slices/slice_places.h"

namespace sonar {

RecipePreview::RecipePreview(Workspace& workspace, RecipeEditor* edited)
    : LivePicture(workspace), workspace_(workspace), edited_(edited) {
  const auto anew = [this] { update(); };
  listening_.to(workspace.document.changes(), [this](DocumentChange change) {
    if (change == DocumentChange::ping || change == DocumentChange::observation) update();
  });
  listening_.to(workspace.slices.changed(), anew);
  listening_.to(workspace.dark.changed(), anew);
  listening_.to(workspace.display, anew);
  if (edited != nullptr) listening_.to(edited->parameters(), anew);
}

LivePicture::Build RecipePreview::build(const PictureLook& look) {
  const Document& document = workspace_.document;
  if (!document.shown() || !document.staged()) return {};
  SliceWish wish;
  wish.observation = document.shown();
  wish.ping = document.staged();
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
  std::optional<Recipe> recipe;
  if (edited_ != nullptr) {
    recipe = edited_->recipe();
    // A calibration that was chosen for the survey holds whatever the recipe says.
    const Recipe measuring = document.measuring_recipe();
    if (recipe_hash(measuring) != recipe_hash(document.recipe())) recipe->calibration = measuring.calibration;
  }
  return [wish = std::move(wish), recipe = std::move(recipe)](PixelSize size, const CancelToken& token,
                                                              const Show& show) mutable -> Result<void> {
    if (recipe) {
      if (auto valid = validate_recipe(*recipe); !valid) return valid;
      const std::shared_ptr<const SurveyFiles> survey(wish.observation, &wish.observation->survey());
      OpenObservation under(survey, wish.observation->index(), *recipe, 0);
      auto made = under.ping(wish.ping->ping_index);
      if (!made) return pass_on(made);
      wish.ping = std::move(*made);
      if (token.cancelled()) return fail(ErrorCode::cancelled, "a later edit came");
    }
    auto picture = slice_of(wish, size);
    if (!picture) return pass_on(picture);
    auto detail = std::make_shared<const SlicePicture>(std::move(*picture));
    show({detail->frame, std::nullopt, detail});
    return {};
  };
}

void RecipePreview::take(const std::shared_ptr<const void>& detail) {
  picture_ = std::static_pointer_cast<const SlicePicture>(detail);
}

}  // namespace sonar
