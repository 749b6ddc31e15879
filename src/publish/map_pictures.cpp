// SPDX-License-Identifier: Apache-2.0
#include "publish/map_pictures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/depth_raster.h"
#include "io/map_outlines.h"
#include "publish/drawn_schools.h"
#include "view/observation_map.h"
#include "view/propagation_view.h"
#include "view/survey_map.h"

namespace sonar {
namespace {

/// The schools that the options ask for; the others' rows and masks are left out.
ObservationProduct with_chosen_schools(const ObservationProduct& product, const PictureOptions& options) {
  ObservationProduct chosen = product;
  const auto unwanted = [&](std::int64_t id) {
    return !options.masks || (!options.schools.empty() &&
                              std::find(options.schools.begin(), options.schools.end(), id) == options.schools.end());
  };
  std::erase_if(chosen.schools, [&](const SchoolRow& row) { return unwanted(row.school_id); });
  std::erase_if(chosen.school_pings, [&](const SchoolPingRow& row) { return unwanted(row.school_id); });
  std::erase_if(chosen.masks, [&](const SchoolMask& mask) { return unwanted(mask.school_id); });
  return chosen;
}

}  // namespace

Result<FrameDescription> observation_map_frame(const DrawnObservation& observation, const PictureOptions& options) {
  if (auto known = require_schools(observation, options); !known) return pass_on(known);
  const auto ping = chosen_ping(observation, options);
  if (!ping) return pass_on(ping);
  const ObservationProduct product = with_chosen_schools(observation.product(), options);
  const auto base = observation_map_base(product, options.size, theme_of(options));
  if (!base) return pass_on(base);
  MaskPalette palette;
  palette.core_at = static_cast<double>(options.mask_style.core_at);
  return observation_map(*base, product, mask_mosaic(*base, product), static_cast<std::size_t>(*ping), palette);
}

Result<FrameDescription> propagation_frame(const DrawnObservation& observation, const PictureOptions& options) {
  if (auto known = require_schools(observation, options); !known) return pass_on(known);
  const auto ping = chosen_ping(observation, options);
  if (!ping) return pass_on(ping);
  const auto sector = observation.sector();
  if (!sector) return pass_on(sector);
  const ObservationProduct product = with_chosen_schools(observation.product(), options);
  PropagationStyle style;
  style.before = style.after = options.neighbours;
  style.aspect = options.side_view ? MaskAspect::side : MaskAspect::above;
  style.palette.core_at = static_cast<double>(options.mask_style.core_at);
  const auto panels = propagation_panels(product, *ping, style);
  return propagation_view(*sector, panels, style, options.size, theme_of(options), observation.title());
}

Result<FrameDescription> survey_map_frame(const std::vector<DrawnObservation>& observations,
                                          const PictureOptions& options, Work& work) {
  std::vector<ObservationProduct> products;
  for (const DrawnObservation& observation : observations)
    products.push_back(with_chosen_schools(observation.product(), options));
  std::vector<ObservationOutlines> outlines(products.size());
  work.for_each(static_cast<std::int64_t>(products.size()), [&](std::int64_t i) {
    outlines[static_cast<std::size_t>(i)] = map_outlines(products[static_cast<std::size_t>(i)]);
  });
  if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
  SurveyMapStyle style;
  style.sv_low_db = options.scale.low_db;
  style.sv_high_db = options.scale.high_db();
  std::optional<DepthGrid> depths;
  if (!options.depth_raster.empty()) {
    const auto extent = survey_extent(products, outlines, style.margin);
    if (!extent) return fail(ErrorCode::not_found, "no ping of the survey has a position");
    auto read = read_depth_raster(options.depth_raster, *extent);
    if (!read) return pass_on(read);
    depths = std::move(*read);
  }
  return survey_map(products, outlines, depths ? &*depths : nullptr, style, options.size, theme_of(options));
}

}  // namespace sonar
