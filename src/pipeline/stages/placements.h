// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>

#include "geo/frames.h"
#include "geo/sector.h"
#include "geo/sound_ray.h"
#include "model/navigation.h"
#include "model/product.h"
#include "pipeline/recipe/recipe.h"

namespace sonar {

/// Rays of an observation, from the depth of its first ping's transducer; null without a profile, pings or samples.
/// sound_speed_mps  that ranges are counted at
[[nodiscard]] std::shared_ptr<const Refraction> rays_of(const SoundProfile& profile,
                                                        std::span<const PingNavigation> pings, const RangeAxis& range,
                                                        double sound_speed_mps);

/// How levelled() takes the places of a ping: turned by roll and pitch where beams are not stabilised, bent where the
/// recipe bends. Heading and depth are the ping's.
[[nodiscard]] Placement placement_under(const Recipe& recipe, const PingNavigation& ping,
                                        const std::shared_ptr<const Refraction>& rays);

/// Whether a ping's places lie elsewhere in tables than along straight beams of a level ship, as slices and volumes draw
/// them.
[[nodiscard]] bool moves_places(const Recipe& recipe, const PingNavigation& ping);

/// How levelled() takes the places of a product's pings, under the recipe that it was made with: what is written of its
/// masks lies where its tables have them.
class ProductPlacements {
 public:
  /// A recipe that cannot be read is the default.
  explicit ProductPlacements(const ObservationProduct& product);
  [[nodiscard]] Placement of(const PingNavigation& ping) const { return placement_under(recipe_, ping, rays_); }
  /// The same, for whoever takes a function.
  [[nodiscard]] Placement operator()(const PingNavigation& ping) const { return of(ping); }

 private:
  Recipe recipe_;
  std::shared_ptr<const Refraction> rays_;
};

}  // namespace sonar
