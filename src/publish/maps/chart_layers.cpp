// SPDX-License-Identifier: Apache-2.0
#include "publish/maps/chart_layers.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <utility>

#include "io/depth_raster.h"
#include "io/mask_outlines.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/stages/placements.h"

namespace sonar {
namespace {

/// Masks are sorted by school.
std::span<const SchoolMask> masks_of(const ObservationProduct& product, std::int64_t school_id) {
  const auto [first, last] =
      std::equal_range(product.masks.begin(), product.masks.end(), SchoolMask{school_id, 0, {}},
                       [](const SchoolMask& a, const SchoolMask& b) { return a.school_id < b.school_id; });
  return {first, last};
}

bool same_masks(const ObservationProduct& a, const ObservationProduct& b, std::int64_t school_id) {
  const auto x = masks_of(a, school_id);
  const auto y = masks_of(b, school_id);
  return std::equal(x.begin(), x.end(), y.begin(), y.end(), [](const SchoolMask& m, const SchoolMask& n) {
    return m.ping_index == n.ping_index && m.mask == n.mask;
  });
}

}  // namespace

ObservationOutlines school_outlines(const ObservationProduct& product, const ObservationProduct* before,
                                    const ObservationOutlines& kept) {
  ObservationOutlines out;
  out.observation = product.observation;
  out.swept = kept.swept;
  std::optional<ProductPlacements> placements;
  // Another recipe may turn or bend otherwise.
  const bool same_recipe = before != nullptr && before->recipe_json == product.recipe_json;
  for (const SchoolRow& school : product.schools) {
    const auto old = std::find_if(kept.schools.begin(), kept.schools.end(),
                                  [&](const auto& one) { return one.school_id == school.school_id; });
    const bool stays = same_recipe && old != kept.schools.end() && same_masks(*before, product, school.school_id);
    if (!stays && !placements) placements.emplace(product);
    out.schools.push_back(
        {school.school_id, stays ? old->area : school_outline(product, school.school_id, std::cref(*placements))});
  }
  return out;
}

GeoArea swept_area(const ObservationProduct& product) { return swept_outline(product, ProductPlacements(product)); }

std::shared_ptr<const CurrentProfiles> map_currents(const ObservationProduct& product) {
  auto recipe = recipe_from_text(product.recipe_json);
  if (!recipe || recipe->current_profiles.empty()) return nullptr;
  return std::make_shared<const CurrentProfiles>(std::move(recipe->current_profiles));
}

Result<DepthGrid> map_depths(const std::filesystem::path& raster, const GeoExtent& extent) {
  return read_depth_raster(raster, extent);
}

}  // namespace sonar
