// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "base/time.h"
#include "model/product.h"
#include "model/track_edge.h"
#include "school/track/track.h"

namespace sonar {

/// A row of tracks_edges.csv.
struct TrackEdgeRow {
  std::string observation;
  std::int64_t school_id = 0;
  std::string event;  ///< name of a TrackEdgeKind
  std::int64_t ping_index = 0;
  TimeNs time_utc = 0;
  std::string other_school;  ///< split: observation/school that it came from; merged: that it went into; else empty
};

template <class Visitor>
void columns(Visitor& v, TrackEdgeRow& r) {
  v("observation", "", r.observation);
  v("school_id", "1", r.school_id);
  v("event", "", r.event);
  v("ping_index", "1", r.ping_index);
  v("time_utc", "", TimeColumn{r.time_utc});
  v("other_school", "", r.other_school);
}

/// [school_id] the pings in which it is seen, rising.
using SeenPings = std::map<std::int64_t, std::vector<std::int64_t>>;
[[nodiscard]] SeenPings seen_pings(const ObservationProduct& product);

/// The edges of all tracks, by school and ping. A school that is not seen in a ping between two others was lost
/// in the first and is refound in the second; one that is seen in the observation's last ping is not lost. A merge stands in
/// the place of what would be lost, where the tracker noted it while the school was not seen. Splits and
/// merges are those that the tracker noted; pings tell everything else, so that it is so too where a human has edited.
/// pings  of the observation
[[nodiscard]] std::vector<TrackEdge> track_edges(const SeenPings& seen, std::span<const TrackEvent> noted,
                                                 std::int64_t pings);
/// Those of a product: of its rows and notes.
[[nodiscard]] std::vector<TrackEdgeRow> track_edges(const ObservationProduct& product);

}  // namespace sonar
