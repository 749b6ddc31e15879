// SPDX-License-Identifier: Apache-2.0
#include "publish/lineage_picture.h"

#include <string>
#include <utility>
#include <vector>

#include "pipeline/exports/track_edges.h"
#include "pipeline/stages/placed_events.h"
#include "publish/volumes/drawn_schools.h"
#include "view/lineage/lineage.h"

namespace sonar {

Result<FrameDescription> lineage_frame(const DrawnObservation& observation, const PictureOptions& options) {
  if (auto known = require_schools(observation, options); !known) return pass_on(known);
  const ObservationProduct product = with_chosen_schools(observation.product(), options);
  LineageData data;
  data.title = observation.title() + ": lineage of schools";
  for (const PingNavigation& ping : product.pings) data.times.push_back(ping.time);
  SeenPings seen = seen_pings(product);
  data.edges = track_edges(seen, noted_events(product), std::ssize(product.pings));
  for (const SchoolRow& row : product.schools) {
    if (std::vector<std::int64_t>& pings = seen[row.school_id]; !pings.empty()) {
      data.schools.push_back({row.school_id, row.status, std::move(pings)});
    }
  }
  auto drawn = lineage(data, {}, options.size, theme_of(options));
  if (!drawn) return pass_on(drawn);
  return std::move(drawn->frame);
}

}  // namespace sonar
