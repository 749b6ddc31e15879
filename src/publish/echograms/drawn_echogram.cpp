// SPDX-License-Identifier: Apache-2.0
#include "publish/echograms/drawn_echogram.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

#include "pipeline/stages/placements.h"
#include "pipeline/stages/voxel_statistics.h"
#include "publish/echograms/echogram_columns.h"
#include "publish/reports/sample_looks.h"
#include "publish/volumes/drawn_schools.h"

namespace sonar {
namespace {

/// Pings that are worked on at once, so that memory does not grow with the observation.
constexpr std::int64_t kAtOnce = 32;

struct PingSpan {
  std::int64_t first = 0;
  std::int64_t count = 0;
};

Result<PingSpan> asked_pings(const DrawnObservation& observation, const EchogramParams& params) {
  const std::int64_t pings = observation.pings();
  if (pings == 0) return fail(ErrorCode::usage, observation.name() + " has no pings");
  const std::int64_t last = params.to_ping < 0 ? pings - 1 : params.to_ping;
  if (params.from_ping < pings && last < pings && params.from_ping <= last) {
    return PingSpan{params.from_ping, last - params.from_ping + 1};
  }
  return fail(ErrorCode::usage, fmt::format("no pings {} to {} in {}: it has pings 0 to {}", params.from_ping, last,
                                            observation.name(), pings - 1));
}

/// The beam that is named, else one through the largest school of the ping that slices would show, else the middle one.
Result<EchogramOf> asked_beam(const DrawnObservation& observation, const Sector& sector,
                              const PictureOptions& options) {
  const auto refused = [&](const char* what, int asked, int count) {
    return fail(ErrorCode::usage,
                fmt::format("no {} {} in {}: it has {}s 0 to {}", what, asked, observation.name(), what, count - 1));
  };
  if (options.fan && (*options.fan < 0 || *options.fan >= sector.fans())) {
    return refused("fan", *options.fan, sector.fans());
  }
  if (options.beam && (*options.beam < 0 || *options.beam >= sector.beams())) {
    return refused("beam", *options.beam, sector.beams());
  }
  const auto ping = chosen_ping(observation, options);
  if (!ping) return pass_on(ping);
  const auto school =
      middle_of_largest(chosen_layers(observation.ping_without_samples(*ping), options), sector.beams());
  EchogramOf of;
  of.fan = options.fan.value_or(school ? school->fan : sector.fans() / 2);
  if (!options.kind.echogram.of_fan) of.beam = options.beam.value_or(school ? school->beam : sector.beams() / 2);
  of.height = options.kind.echogram.depth ? EchogramHeight::depth : EchogramHeight::range;
  return of;
}

/// The product with the pings of a span alone; rows and masks keep the observation's numbers of pings.
ObservationProduct product_of(const DrawnObservation& observation, const PingSpan& span,
                              const PictureOptions& options) {
  ObservationProduct out = with_chosen_schools(observation.product(), options);
  const auto first = out.pings.begin() + static_cast<std::ptrdiff_t>(span.first);
  out.pings = {first, first + static_cast<std::ptrdiff_t>(span.count)};
  return out;
}

using Column = std::vector<EchogramCell>;

/// The columns of a span of pings; empty for those that cannot be read.
Result<std::unique_ptr<EchogramPyramid>> pyramid_of(const ObservationProduct& product, const PingSpan& span,
                                                    const EchogramRange& range,
                                                    const std::function<Column(std::int64_t)>& column, Work& work) {
  auto pyramid = std::make_unique<EchogramPyramid>(range);
  TimeNs least = product.pings.front().time;
  for (std::int64_t done = 0; done < span.count; done += kAtOnce) {
    const std::int64_t count = std::min(kAtOnce, span.count - done);
    std::vector<Column> columns(static_cast<std::size_t>(count));
    work.for_each(count, [&](std::int64_t i) { columns[static_cast<std::size_t>(i)] = column(span.first + done + i); });
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    for (std::int64_t i = 0; i < count; ++i) {
      const PingNavigation& navigation = product.pings[static_cast<std::size_t>(done + i)];
      // Clocks may step back; an echogram's times do not.
      least = std::max(least, navigation.time);
      pyramid->add_ping(least, columns[static_cast<std::size_t>(i)], navigation.distance_nmi);
    }
    work.progress("echogram", done + count, span.count);
  }
  return pyramid;
}

Result<DrawnEchogram> of_beams(DrawnObservation& observation, const PingSpan& span, const PictureOptions& options,
                               Work& work) {
  const auto sector = observation.sector();
  if (!sector) return pass_on(sector);
  const auto of = asked_beam(observation, *sector, options);
  if (!of) return pass_on(of);
  Engine* engine = observation.engine();
  std::optional<ProductPlacements> alone;
  if (engine == nullptr) alone.emplace(observation.product());
  const auto placement = [&](std::int64_t ping) {
    return alone ? alone->of(observation.product().pings[static_cast<std::size_t>(ping)]) : engine->placement(ping);
  };
  std::vector<Placement> placements;
  for (std::int64_t i = 0; i < span.count; ++i) placements.push_back(placement(span.first + i));
  const EchogramRange range = echogram_range(*sector, placements, *of);
  const RowsOfPing rows = [&](std::int64_t ping) { return echogram_rows(*sector, placement(ping), *of); };
  DrawnEchogram out;
  out.product = product_of(observation, span, options);
  out.of = echogram_text(*sector, observation.frequency_hz(), *of);
  out.heights = heights_of(range);
  out.searched = observation.has_product();
  out.filtered = options.display.filtered;
  // Means over the beams of a fan are weaker than a beam's own Sv, as a timeline's are.
  out.scale = of->beam ? options.display.scale : TimelineStyle{}.scale;
  if (options.display.masks) out.schools = echogram_schools(out.product, rows, range, span.first, span.count);
  std::vector<RefusedEcho> refused;
  if (options.display.refused_echoes && out.product.grid) {
    refused = echogram_refused(out.product.rejected, out.product.grid->grid, rows, span.first, span.count);
  }
  out.product.rejected = std::move(refused);
  if (engine == nullptr) return out;
  if (out.filtered || options.display.shadow) {
    auto known = engine->estimate_background(span.first, span.first + span.count - 1, work);
    if (!known) return pass_on(known);
  }
  const EchogramSamples shown = echogram_samples(options.display);
  std::vector<std::vector<EchogramStretch>> shadow(static_cast<std::size_t>(span.count));
  auto made = pyramid_of(
      out.product, span, range,
      [&](std::int64_t ping) {
        const auto staged = engine->staged(ping);
        if (!staged) return Column{};
        if (options.display.shadow) {
          const DrawnPing drawn = observation.ping_without_samples(ping);
          const auto at = static_cast<std::size_t>(ping - span.first);
          shadow[at] = echogram_shadow(
              shadow_of(*staged, *sector, casting_shadow(drawn, options), observation.recipe().measure.extinction),
              rows(ping), range, sector->range().count, options.display.shadow_db, at);
        }
        return echogram_column(*staged, *sector, placement(ping), *of, shown, range);
      },
      work);
  engine->rest();
  if (!made) return pass_on(made);
  for (const auto& of_ping : shadow) out.shadow.insert(out.shadow.end(), of_ping.begin(), of_ping.end());
  out.echogram = std::move(*made);
  return out;
}

Result<DrawnEchogram> of_channel(DrawnObservation& observation, const PingSpan& span, const PictureOptions& options,
                                 Work& work) {
  const ObservationFiles& files = *observation.files();
  const auto channel = named_channel(files, options.kind.echogram.channel);
  if (!channel) return pass_on(channel);
  const auto height = options.kind.echogram.depth ? EchogramHeight::depth : EchogramHeight::range;
  const Recipe recipe = observation.recipe();
  const ChannelEchogram channels(*observation.survey(), files, recipe, *channel, height);
  DrawnEchogram out;
  out.product = product_of(observation, span, options);
  out.of = channel_text(files, *channel);
  out.heights = heights_of(channels.range());
  out.searched = true;  // schools are not looked for in single beams: nothing is to be said of them
  out.scale = SvScale{.map = options.display.scale.map, .low_db = -70.0, .span_db = 36.0};
  auto made = pyramid_of(
      out.product, span, channels.range(), [&](std::int64_t ping) { return channels.column(ping).value_or(Column{}); },
      work);
  if (!made) return pass_on(made);
  out.echogram = std::move(*made);
  return out;
}

}  // namespace

Result<DrawnEchogram> drawn_echogram(DrawnObservation& observation, const PictureOptions& options, Work& work) {
  if (auto known = require_schools(observation, options); !known) return pass_on(known);
  const auto span = asked_pings(observation, options.kind.echogram);
  if (!span) return pass_on(span);
  const bool of_fans = observation.sector().has_value();
  if (of_fans || !observation.has_raw()) {
    if (!options.kind.echogram.channel.empty() && of_fans) {
      return fail(ErrorCode::usage, fmt::format("channel {}: {} has fans and beams; choose them with fan and beam",
                                                options.kind.echogram.channel, observation.name()));
    }
    return of_beams(observation, *span, options, work);
  }
  if (options.fan || options.beam || options.kind.echogram.of_fan) {
    return fail(ErrorCode::usage, observation.name() + " has no fans and beams; choose one of its channels");
  }
  return of_channel(observation, *span, options, work);
}

}  // namespace sonar
