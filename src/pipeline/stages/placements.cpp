// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/placements.h"

#include <utility>

#include "base/units.h"
#include "geo/refraction.h"

namespace sonar {

std::shared_ptr<const Refraction> rays_of(const SoundProfile& profile, std::span<const PingNavigation> pings,
                                          const RangeAxis& range, double sound_speed_mps) {
  if (profile.empty() || pings.empty() || range.count == 0) return nullptr;
  const double farthest_m = range.range_m(range.count);
  // A damaged product may say anything.
  if (!(sound_speed_mps > 0.0) || !(farthest_m > 0.0)) return nullptr;
  return std::make_shared<const Refraction>(profile, pings.front().transducer_depth_m, sound_speed_mps, farthest_m);
}

Placement placement_under(const Recipe& recipe, const PingNavigation& ping,
                          const std::shared_ptr<const Refraction>& rays) {
  Placement placement = ping.placement();
  if (recipe.survey.bend_rays) placement.rays = rays;
  if (recipe.navigation.beams_stabilised) return placement;
  placement.roll_rad = rad_from_deg(ping.roll_deg);
  placement.pitch_rad = rad_from_deg(ping.pitch_deg);
  return placement;
}

bool moves_places(const Recipe& recipe, const PingNavigation& ping) {
  const Placement placement = placement_under(recipe, ping, nullptr);
  return recipe.survey.bend_rays || placement.roll_rad != 0.0 || placement.pitch_rad != 0.0;
}

ProductPlacements::ProductPlacements(const ObservationProduct& product) {
  if (auto recipe = recipe_from_text(product.recipe_json)) recipe_ = std::move(*recipe);
  if (!product.grid || !recipe_.survey.bend_rays) return;
  rays_ =
      rays_of(recipe_.survey.sound_speed_profile, product.pings, product.grid->range, product.grid->sound_speed_mps);
}

}  // namespace sonar
