// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/describe.h"
#include "base/result.h"
#include "geo/sector.h"
#include "model/filtered_ping.h"
#include "model/mask.h"
#include "model/transfer_function.h"
#include "school/grow/grow.h"
#include "school/runs.h"

namespace sonar {

struct PaperPropagationParams {
  int enlarge_fans = 2;
  int enlarge_beams = 4;
  int enlarge_samples = 40;
  Connectivity connectivity = Connectivity::faces;
};

template <class Visitor>
void describe(Visitor& v, PaperPropagationParams& p) {
  v.field("enlarge_fans", p.enlarge_fans,
          {.unit = "fans",
           .min = 0,
           .max = 1000,
           .text = "How many fans the school's bounding volume is enlarged by on each side from ping to ping; raise it "
                   "for schools that dive or for long ping intervals."});
  v.field("enlarge_beams", p.enlarge_beams,
          {.unit = "beams",
           .min = 0,
           .max = 1000,
           .text = "How many beams the school's bounding volume is enlarged by on each side from ping to ping; raise "
                   "it for a fast ship or long ping intervals."});
  v.field("enlarge_samples", p.enlarge_samples,
          {.unit = "samples",
           .min = 0,
           .max = 100000,
           .text = "How many samples the school's bounding volume is enlarged by on each side from ping to ping; raise "
                   "it for schools that swim fast or for long ping intervals."});
  v.choice("connectivity", p.connectivity, kConnectivityNames,
           "Which voxels count as neighbours: the 6 across faces, or all 26. Choose 26 for schools that are thin in "
           "some direction.");
}

/// A school in one ping.
struct PropagatedPing {
  std::int64_t ping_index = 0;
  PingMask mask;
  double threshold_db = 0.0;  ///< lowest Sv that could be a member
};

/// A school through time, and why each direction ended.
struct Propagation {
  std::vector<PropagatedPing> pings;  ///< rising ping index; lost pings are absent
  std::string note_backward;          ///< "stopped at ping 3: ..."; empty only where the reach or the observer ended it
  std::string note_forward;
  std::optional<std::int64_t> stopped_at;  ///< the ping after which the observer wanted no more
};

/// Watches a propagation: called after each ping, first backwards, then forwards, with what the school has there (empty
/// where it is lost for now). False = no more: what was reached is kept, and is exactly what a reach up to that ping
/// gives; stopped on the way back, nothing goes forwards.
using PropagationObserver = std::function<bool(std::int64_t ping_index, const PingMask& mask)>;

/// What the paper computes once from the hand-made selection.
struct PaperRange {
  double centre_opacity = 0.0;
  double tolerance = 0.0;
};
/// Half the range of the selection's opacities, and its middle.
[[nodiscard]] PaperRange paper_range(View3<const std::int16_t> sv, const PingMask& selection,
                                     std::span<const float> opacity);

/// Inclusive range of pings that may be visited.
struct PingReach {
  std::int64_t first = 0;
  std::int64_t last = 0;
};

/// The paper's propagation to the letter: seed = centre of gravity weighted by the mask (in index space), the bounding
/// volume enlarged each ping, tolerance and centre value computed once from the hand-made selection; forwards and
/// backwards; ends where the enlarged bounds leave the usable volume or the centre's voxel is out of range.
/// selection  the hand-made mask in ping `clicked`, not empty
/// on_step    empty = none
/// errors     bad_parameter: empty selection; those of the provider for the clicked ping. A provider's failure
///            elsewhere ends that direction with a note.
/// source     Balabanian et al. 2007, section 4.3
[[nodiscard]] Result<Propagation> propagate_paper(const PingProvider& pings, std::int64_t clicked,
                                                  const PingMask& selection, PingReach reach,
                                                  const TransferFunction& growth_curve,
                                                  const PaperPropagationParams& params,
                                                  const PropagationObserver& on_step = {});

}  // namespace sonar
