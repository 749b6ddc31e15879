// SPDX-License-Identifier: Apache-2.0
#include "publish/movies/between_pings.h"

#include <cmath>
#include <memory>
#include <utility>

#include "base/units.h"
#include "geo/frames.h"

namespace sonar {
namespace {

double line(double a, double b, double fraction) { return a + fraction * (b - a); }

/// Degrees, the shorter way round.
double turned(double a, double b, double fraction) { return a + fraction * wrap_180(b - a); }

}  // namespace

PingNavigation navigation_between(const PingNavigation& a, const PingNavigation& b, double fraction) {
  PingNavigation out = fraction < 0.5 ? a : b;
  out.time = a.time + static_cast<TimeNs>(std::llround(fraction * static_cast<double>(b.time - a.time)));
  out.transducer.latitude_deg = line(a.transducer.latitude_deg, b.transducer.latitude_deg, fraction);
  out.transducer.longitude_deg = wrap_180(turned(a.transducer.longitude_deg, b.transducer.longitude_deg, fraction));
  out.heading_deg = wrap_360(turned(a.heading_deg, b.heading_deg, fraction));
  out.course_deg = wrap_360(turned(a.course_deg, b.course_deg, fraction));
  out.speed_mps = line(a.speed_mps, b.speed_mps, fraction);
  out.distance_nmi = line(a.distance_nmi, b.distance_nmi, fraction);
  out.pitch_deg = line(a.pitch_deg, b.pitch_deg, fraction);
  out.roll_deg = line(a.roll_deg, b.roll_deg, fraction);
  out.heave_m = line(a.heave_m, b.heave_m, fraction);
  out.transducer_depth_m = line(a.transducer_depth_m, b.transducer_depth_m, fraction);
  return out;
}

Array3<std::int16_t> counts_between(const Array3<std::int16_t>& a, const Array3<std::int16_t>& b, double fraction,
                                    Work& work) {
  const Array3<std::int16_t>& nearer = fraction < 0.5 ? a : b;
  Array3<std::int16_t> out = nearer;
  if (a.shape() != b.shape()) return out;
  const auto& shape = out.shape();
  const auto rows = static_cast<std::int64_t>(shape.fans) * shape.beams;
  work.for_each(rows, [&](std::int64_t row) {
    const int fan = static_cast<int>(row / shape.beams);
    const int beam = static_cast<int>(row % shape.beams);
    const auto from = a.row(fan, beam);
    const auto to = b.row(fan, beam);
    const auto here = out.row(fan, beam);
    for (std::size_t i = 0; i < here.size(); ++i) {
      // As recorded where nothing changes: not even rounded.
      if (from[i] == to[i] || from[i] == kNoData || to[i] == kNoData) continue;
      here[i] = count_from_linear(line(linear_from_count(from[i]), linear_from_count(to[i]), fraction));
    }
  });
  return out;
}

std::shared_ptr<const StagedPing> staged_between(const StagedPing& a, const StagedPing& b, double fraction,
                                                 Work& work) {
  auto staged = std::make_shared<StagedPing>(fraction < 0.5 ? a : b);
  staged->sv.counts = counts_between(a.sv.counts, b.sv.counts, fraction, work);
  staged->filtered = std::make_shared<Volume>(
      Volume{counts_between(a.filtered->counts, b.filtered->counts, fraction, work), staged->filtered->flags});
  return staged;
}

Result<DrawnPing> drawn_ping(DrawnObservation& observation, std::int64_t ping_index, const PictureOptions& options,
                             Work& work) {
  auto first = observation.ping(ping_index, work);
  if (!first || !(options.towards_next > 0.0)) return first;
  auto second = observation.ping(ping_index + 1, work);
  if (!second) return second;
  const double fraction = options.towards_next;
  DrawnPing out = fraction < 0.5 ? *first : *second;
  out.navigation = navigation_between(first->navigation, second->navigation, fraction);
  if (first->staged && second->staged) out.staged = staged_between(*first->staged, *second->staged, fraction, work);
  return out;
}

}  // namespace sonar
