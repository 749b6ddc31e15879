// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <memory>
#include <optional>
#include <utility>

#include "publish/drawn_schools.h"
#include "publish/map_pictures.h"
#include "view/echogram_pyramid.h"
#include "view/timeline.h"

namespace sonar {
namespace {

/// Pings that are worked on at once, so that memory does not grow with the observation.
constexpr std::int64_t kAtOnce = 32;

/// Columns of every ping; empty for those that cannot be read.
Result<std::unique_ptr<EchogramPyramid>> echogram(DrawnObservation& observation, Work& work) {
  Engine* engine = observation.engine();
  if (engine == nullptr) return std::unique_ptr<EchogramPyramid>();
  const std::int64_t pings = observation.pings();
  // Flags need no background: the echogram is of Sv as recorded.
  const EchogramRange range = echogram_range(engine->sector().range());
  auto pyramid = std::make_unique<EchogramPyramid>(range);
  for (std::int64_t first = 0; first < pings; first += kAtOnce) {
    const std::int64_t count = std::min(kAtOnce, pings - first);
    std::vector<std::vector<EchogramCell>> columns(static_cast<std::size_t>(count));
    work.for_each(count, [&](std::int64_t i) {
      const auto ping = engine->staged(first + i);
      if (!ping) return;
      const Volume shown{ping->sv.counts, ping->filtered->flags};
      columns[static_cast<std::size_t>(i)] = echogram_column(engine->sector(), shown, kNotFiltered, range);
    });
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    for (std::int64_t i = 0; i < count; ++i) {
      const PingNavigation& navigation = observation.product().pings[static_cast<std::size_t>(first + i)];
      pyramid->add_ping(navigation.time, columns[static_cast<std::size_t>(i)], navigation.distance_nmi);
    }
    work.progress("echogram", first + count, pings);
  }
  return pyramid;
}

}  // namespace

Result<FrameDescription> timeline_frame(const std::vector<DrawnObservation*>& observations,
                                        const PictureOptions& options, Work& work) {
  std::vector<std::unique_ptr<EchogramPyramid>> echograms;
  std::vector<TimelineObservation> drawn;
  for (DrawnObservation* observation : observations) {
    auto made = echogram(*observation, work);
    if (!made) return pass_on(made);
    echograms.push_back(std::move(*made));
    drawn.push_back({&observation->product(), echograms.back().get()});
  }
  TimelineStyle style;
  style.value = options.maximum ? EchogramValue::maximum : EchogramValue::mean;
  style.axis = options.along_log ? TimelineAxis::log : TimelineAxis::time;
  style.schools = options.masks;
  // Means over all beams are weaker than a beam's own Sv; the timeline's own limits hold unless the user moved them.
  if (options.scale.low_db != SvScale{}.low_db || options.scale.span_db != SvScale{}.span_db)
    style.scale = options.scale;
  style.scale.map = options.scale.map;
  return timeline(drawn, style, options.size, theme_of(options));
}

}  // namespace sonar
