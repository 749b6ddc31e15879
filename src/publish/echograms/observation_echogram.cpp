// SPDX-License-Identifier: Apache-2.0
#include "publish/echograms/observation_echogram.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <utility>
#include <vector>

#include "publish/echograms/echogram_cache.h"

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

}  // namespace

Result<std::unique_ptr<EchogramPyramid>> observation_echogram(DrawnObservation& observation, bool filtered, int level,
                                                              Work& work) {
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
  engine->rest();
  if (!made) return pass_on(made);
  if (whole) keep_echogram(entry, *made);
  return std::make_unique<EchogramPyramid>(level == 0 ? std::move(*made) : made->coarser(level));
}

std::optional<std::int64_t> fullest_ping(const EchogramPyramid& echogram, std::span<const PingNavigation> pings,
                                         double level_db) {
  const double level = counts_from_db(level_db);
  std::int64_t most = 0;
  std::optional<std::int64_t> fullest;
  const std::size_t count = std::min(echogram.columns(0), pings.size());  // what was kept is a file
  for (std::size_t ping = 0; ping < count; ++ping) {
    if (pings[ping].bad) continue;
    std::int64_t reach = 0;
    for (int bin = 0; bin < echogram.bins(0); ++bin) {
      const EchogramCell& cell = echogram.cell(0, ping, bin);
      reach += !cell.empty() && cell.high >= level ? 1 : 0;
    }
    if (reach <= most) continue;
    most = reach;
    fullest = static_cast<std::int64_t>(ping);
  }
  return fullest;
}

}  // namespace sonar
