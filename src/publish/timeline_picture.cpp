// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>
#include <utility>

#include "publish/echograms/echogram_cache.h"
#include "publish/maps/map_pictures.h"
#include "publish/volumes/drawn_schools.h"
#include "view/timelines/echogram_pyramid.h"
#include "view/timelines/timeline.h"

namespace sonar {
namespace {

/// Pings that are worked on at once, so that memory does not grow with the observation.
constexpr std::int64_t kAtOnce = 32;

/// Columns of every ping; empty for those that cannot be read. `whole` becomes false where the disk was at fault, which
/// may be better the next time.
Result<EchogramPyramid> made_echogram(DrawnObservation& observation, bool filtered, const EchogramRange& range,
                                      std::atomic<bool>& whole, Work& work) {
  Engine& engine = *observation.engine();
  if (filtered) {
    if (auto known = engine.estimate_background(0, observation.pings() - 1, work); !known) return pass_on(known);
  }
  const std::int64_t pings = observation.pings();
  EchogramPyramid pyramid(range);
  for (std::int64_t first = 0; first < pings; first += kAtOnce) {
    const std::int64_t count = std::min(kAtOnce, pings - first);
    std::vector<std::vector<EchogramCell>> columns(static_cast<std::size_t>(count));
    work.for_each(count, [&](std::int64_t i) {
      const auto ping = engine.staged(first + i);
      if (!ping && ping.error().code != ErrorCode::format) whole = false;
      if (!ping) return;
      const Volume shown{filtered ? ping->filtered->counts : ping->sv.counts, ping->filtered->flags};
      columns[static_cast<std::size_t>(i)] = echogram_column(engine.sector(), shown, kNotFiltered, range);
    });
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    for (std::int64_t i = 0; i < count; ++i) {
      const PingNavigation& navigation = observation.product().pings[static_cast<std::size_t>(first + i)];
      pyramid.add_ping(navigation.time, columns[static_cast<std::size_t>(i)], navigation.distance_nmi);
    }
    work.progress("echogram", first + count, pings);
  }
  return pyramid;
}

/// From the user's cache, or made and kept there. Null without raw files.
Result<std::unique_ptr<EchogramPyramid>> echogram(DrawnObservation& observation, bool filtered, int level, Work& work) {
  Engine* engine = observation.engine();
  if (engine == nullptr && observation.has_raw()) return pass_on(observation.sector());
  if (engine == nullptr) return std::unique_ptr<EchogramPyramid>();
  // Flags need no background: the echogram is of Sv as recorded.
  const EchogramRange range = echogram_range(engine->sector().range());
  const EchogramEntry entry = echogram_entry(IndexCache::of_user(), engine->survey(), engine->observation(),
                                             recipe_hash(engine->recipe()), filtered, kNotFiltered, range);
  if (auto kept = kept_echogram(entry, level)) return std::make_unique<EchogramPyramid>(std::move(*kept));
  std::atomic<bool> whole = true;
  auto made = made_echogram(observation, filtered, range, whole, work);
  if (!made) return pass_on(made);
  if (whole) keep_echogram(entry, *made);
  return std::make_unique<EchogramPyramid>(made->coarser(level));
}

}  // namespace

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
    auto made = echogram(*observation, options.display.filtered, level, work);
    if (observation->engine() != nullptr) observation->engine()->rest();
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
