// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>
#include <utility>

#include "publish/echograms/echogram_cache.h"
#include "publish/echograms/observation_echogram.h"
#include "publish/maps/map_pictures.h"
#include "publish/volumes/drawn_schools.h"
#include "view/timelines/echogram_pyramid.h"
#include "view/timelines/timeline.h"

namespace sonar {

Result<FrameDescription> timeline_frame(const std::vector<DrawnObservation*>& observations,
                                        const PictureOptions& options, Work& work) {
  if (observations.size() == 1) {
    if (auto known = require_schools(*observations.front(), options); !known) return pass_on(known);
  }
  std::size_t pings = 0;
  for (const DrawnObservation* observation : observations) pings += static_cast<std::size_t>(observation->pings());
  const int level = echogram_level(pings, options.size.width);
  std::vector<std::unique_ptr<EchogramPyramid>> echograms;
  std::vector<ObservationProduct> products;
  for (DrawnObservation* observation : observations) {
    // Among several observations those without a grid have nothing to show; alone they are told about.
    const bool drawable = !observation->has_raw() || observation->engine() != nullptr;
    if (!drawable && observations.size() > 1) continue;
    auto made = observation_echogram(*observation, options.display.filtered, level, work);
    if (!made) return pass_on(made);
    echograms.push_back(std::move(*made));
    products.push_back(with_chosen_schools(observation->product(), options));
  }
  if (products.empty()) return fail(ErrorCode::unsupported, "no observation has a grid of fans and beams to draw");
  std::vector<TimelineObservation> drawn;
  for (std::size_t i = 0; i < products.size(); ++i) {
    TimelineObservation& one = drawn.emplace_back(TimelineObservation{&products[i], echograms[i].get()});
    if (options.display.refused_echoes) one.refused = products[i].rejected;
  }
  TimelineStyle style;
  style.value = options.kind.timeline.maximum ? EchogramValue::maximum : EchogramValue::mean;
  style.axis = options.kind.timeline.along_log ? TimelineAxis::log : TimelineAxis::time;
  style.schools = options.display.masks;
  style.filtered = options.display.filtered;
  style.searched =
      std::any_of(observations.begin(), observations.end(), [](const DrawnObservation* o) { return o->has_product(); });
  // Means over all beams are weaker than a beam's own Sv: the timeline has limits of its own unless some were chosen.
  if (options.transfer) {
    style.scale = sv_scale(*options.transfer, options.display.scale.map);
  } else if (options.limits_given) {
    style.scale = options.display.scale;
  } else if (options.kind.timeline.maximum) {
    style.scale = SvScale{};  // a beam's own Sv, as in slices
  }
  style.scale.map = options.display.scale.map;
  style.scale.threshold_db = options.display.scale.threshold_db;
  return timeline(drawn, style, options.size, theme_of(options));
}

}  // namespace sonar
