// SPDX-License-Identifier: Apache-2.0
#include "publish/maps/map_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/depth_raster.h"
#include "io/mask_outlines.h"
#include "model/school_totals.h"
#include "pipeline/integrate/transects.h"
#include "pipeline/stages/placements.h"
#include "publish/maps/chart_layers.h"
#include "publish/volumes/drawn_schools.h"
#include "view/maps/observation_map.h"
#include "view/maps/survey_map.h"
#include "view/volume/propagation_view.h"

namespace sonar {
namespace {

/// Schools in their own colours, rejected ones grey.
MaskPalette palette_of(const ObservationProduct& product, const PictureOptions& options) {
  MaskPalette palette;
  palette.core_at = options.display.core_at;
  palette.rejected.assign(MaskMosaic::kSchools, false);
  for (const SchoolRow& school : product.schools) {
    palette.rejected[static_cast<std::size_t>(school.school_id) % palette.rejected.size()] =
        school.status == "rejected";
  }
  return palette;
}

}  // namespace

Result<FrameDescription> observation_map_frame(const DrawnObservation& observation, const PictureOptions& options) {
  if (auto known = require_schools(observation, options); !known) return pass_on(known);
  const auto ping = chosen_ping(observation, options);
  if (!ping) return pass_on(ping);
  const ObservationProduct product = with_chosen_schools(observation.product(), options);
  auto base = observation_map_base(product, options.size, theme_of(options), {}, true, options.display.refused_echoes,
                                   ProductPlacements(product));
  if (!base) return pass_on(base);
  base->searched = observation.has_product();
  base->left_out = static_cast<std::size_t>(school_count(observation.product()) - school_count(product));
  FrameDescription frame = observation_map(*base, product, mask_mosaic(*base, product), static_cast<std::size_t>(*ping),
                                           palette_of(product, options));
  const PingNavigation& current = product.pings[static_cast<std::size_t>(*ping)];
  add_map_schools(frame, *base, map_schools(product),
                  current.has_position() ? base->map.at(current.transducer) : std::nullopt);
  if (options.display.refused_echoes) add_map_refused(frame, *base, product.rejected);
  return frame;
}

Result<FrameDescription> propagation_frame(const DrawnObservation& observation, const PictureOptions& options) {
  if (auto known = require_schools(observation, options); !known) return pass_on(known);
  const auto ping = chosen_ping(observation, options);
  if (!ping) return pass_on(ping);
  const auto sector = observation.sector();
  if (!sector) return pass_on(sector);
  if (observation.product().masks.empty()) {
    return fail(ErrorCode::not_found,
                "there are no schools to draw a propagation of; detect them, or name the work folder of a run");
  }
  const ObservationProduct product = with_chosen_schools(observation.product(), options);
  PropagationStyle style;
  style.dates = true;
  style.before = style.after = options.kind.propagation.neighbours;
  style.aspect = options.kind.propagation.side_view ? MaskAspect::side : MaskAspect::above;
  style.palette.core_at = options.display.core_at;
  auto panels = propagation_panels(product, *ping, style, observation.has_product());
  for (PropagationPanel& panel : panels) {
    const auto& masks = observation.product().masks;
    panel.left_out = std::any_of(masks.begin(), masks.end(), [&](const SchoolMask& mask) {
      return mask.ping_index == panel.ping_index &&
             !(options.display.masks && wanted(observation.product(), mask.school_id, options));
    });
  }
  return propagation_view(*sector, panels, style, options.size, theme_of(options), observation.title());
}

Result<FrameDescription> survey_map_frame(const std::vector<DrawnObservation>& observations,
                                          const PictureOptions& options, Work& work) {
  for (const std::int64_t school : options.schools) {
    const bool known = std::any_of(observations.begin(), observations.end(), [school](const DrawnObservation& o) {
      return std::any_of(o.product().schools.begin(), o.product().schools.end(),
                         [school](const SchoolRow& row) { return row.school_id == school; });
    });
    if (!known) return fail(ErrorCode::usage, fmt::format("no school {} in any observation", school));
  }
  std::vector<ObservationProduct> products;
  SurveyMapStyle style;
  for (const DrawnObservation& observation : observations) products.push_back(observation.product());
  style.left_out = counted_schools(products).size();
  products = with_chosen_schools(std::move(products), options);
  style.left_out -= counted_schools(products).size();
  std::vector<ObservationOutlines> outlines(products.size());
  work.for_each(static_cast<std::int64_t>(products.size()), [&](std::int64_t i) {
    const ObservationProduct& product = products[static_cast<std::size_t>(i)];
    outlines[static_cast<std::size_t>(i)] = map_outlines(product, ProductPlacements(product));
  });
  if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
  style.sv_low_db = options.display.scale.low_db;
  style.sv_high_db = options.display.scale.high_db();
  style.unsearched = static_cast<int>(std::count_if(observations.begin(), observations.end(),
                                                    [](const DrawnObservation& o) { return !o.has_product(); }));
  // Products of one survey have one recipe.
  if (!products.empty()) style.currents = map_currents(products.front());
  if (!options.transects.empty()) {
    auto transects = read_transects(options.transects);
    if (!transects) return pass_on(transects);
    style.transects = std::move(*transects);
  }
  std::optional<DepthGrid> depths;
  if (!options.depth_raster.empty()) {
    const auto surveyed = survey_extent(products, outlines, style.margin);
    const auto shown = survey_map_extent(products, outlines, style, options.size, theme_of(options));
    if (!surveyed || !shown) return fail(ErrorCode::not_found, "no ping of the survey has a position");
    // A raster that meets only the paper about the survey would be a wrong file: asked coarsely, then read in full.
    if (auto met = read_depth_raster(options.depth_raster, *surveyed, {.most_nodes = 100}); !met) return pass_on(met);
    auto read = read_depth_raster(options.depth_raster, *shown);
    if (!read) return pass_on(read);
    depths = std::move(*read);
  }
  return survey_map(products, outlines, depths ? &*depths : nullptr, style, options.size, theme_of(options));
}

}  // namespace sonar
