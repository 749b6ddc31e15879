// SPDX-License-Identifier: Apache-2.0
#include "publish/volume_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/time.h"
#include "base/units.h"
#include "geo/geodesic.h"
#include "io/depth_raster.h"
#include "publish/drawn_schools.h"
#include "publish/renderer_choice.h"
#include "render/context_picture.h"
#include "render/refinement.h"
#include "view/axes.h"
#include "view/colour_bar.h"
#include "view/shapes.h"

namespace sonar {
namespace {

constexpr int kPatchNodes = 121;

/// One ping made ready: what every frame of it shares.
struct Prepared {
  Sector sector;
  DrawnPing ping;
  std::vector<MaskLayer> masks;
  std::shared_ptr<VolumeData> volume;
};

Result<Prepared> prepare(DrawnObservation& observation, const PictureOptions& options, Work& work) {
  if (auto known = require_schools(observation, options); !known) return pass_on(known);
  const auto index = chosen_ping(observation, options);
  if (!index) return pass_on(index);
  auto sector = observation.sector();
  if (!sector) return pass_on(sector);
  auto ping = observation.ping(*index, work);
  if (!ping) return pass_on(ping);
  Prepared out{std::move(*sector), std::move(*ping), {}, nullptr};
  out.masks = mask_layers(out.ping, options);
  const double depth = out.ping.navigation.transducer_depth_m;
  if (out.ping.staged) {
    const StagedPing& staged = *out.ping.staged;
    Volume shown{options.filtered.value_or(true) ? staged.filtered->counts : staged.sv.counts, staged.filtered->flags};
    out.volume = std::make_shared<VolumeData>(volume_data(out.sector, shown, kNotFiltered, depth));
  } else {
    const Shape3 shape{out.sector.fans(), out.sector.beams(), out.sector.range().count};
    // Weakest of all: something for the masks to lie in, which is never shown itself.
    out.volume = std::make_shared<VolumeData>(VolumeData{out.sector, Array3<std::int16_t>(shape, kMinCount), -depth});
  }
  return out;
}

Camera camera_of(const Sector& sector, const PictureOptions& options, PixelSize size) {
  const Camera camera = options.camera ? *options.camera : overview(sector, size);
  return zoomed(orbited(camera, rad_from_deg(options.orbit_deg), rad_from_deg(options.rise_deg)), 1.0 / options.zoom);
}

Result<std::optional<SeabedPatch>> seabed(const Prepared& prepared, const PictureOptions& options) {
  if (options.depth_raster.empty()) return std::optional<SeabedPatch>{};
  const PingNavigation& navigation = prepared.ping.navigation;
  if (!navigation.has_position()) {
    return fail(ErrorCode::mismatch, "no seabed: the ping has no position", {options.depth_raster.string()});
  }
  const RangeAxis& range = prepared.sector.range();
  const double reach = 1.1 * range.range_m(range.count - 1);
  const Geographic ship = navigation.transducer;
  const auto extent = extent_of(std::span(&ship, 1));
  const auto grid = read_depth_raster(options.depth_raster, widened(*extent, 1.5 * reach));
  if (!grid) return pass_on(grid);
  auto patch = seabed_patch(*grid, navigation.placement(), reach);
  if (!patch) return pass_on(patch);
  return std::optional(std::move(*patch));
}

Result<RayImage> traced(const Prepared& prepared, const VolumeView& view, const PictureOptions& options, Work& work) {
  const auto curve = view_curve(options);
  if (!curve) return pass_on(curve);
  const double first = curve->points().front().sv_db;
  const auto table =
      optical_table(*curve, options.table_entries, first, std::max(first + 1.0, curve->points().back().sv_db));
  if (!table) return pass_on(table);
  auto offscreen = offscreen_renderer(options.renderer);
  if (!offscreen) return pass_on(offscreen);
  VolumeRenderer& renderer = *offscreen->renderer;
  if (auto set = renderer.set_volume(prepared.volume); !set) return pass_on(set);
  if (auto set = renderer.set_transfer(*table); !set) return pass_on(set);
  if (auto set = renderer.set_masks(prepared.masks); !set) return pass_on(set);
  if (options.frames <= 0) return renderer.draw(view, {}, work);
  Refinement refinement(renderer, {.most_frames = options.frames, .rest_budget_s = options.seconds});
  refinement.restart(view);
  for (;;) {
    auto frame = refinement.next(work);
    if (!frame) return pass_on(frame);
    if (frame->done) return std::move(frame->image);
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    work.progress("drawing", frame->averaged, options.frames);
  }
}

/// "2020-01-04 08:00:00.350 UTC"
std::string time_text(TimeNs time) {
  std::string text = iso_time(time);
  text[text.find('T')] = ' ';
  text.back() = ' ';
  return text + "UTC";
}

/// How the picture was made, for its second line.
std::string view_line(const PictureOptions& options, bool data_too) {
  if (!data_too) return "masks of schools";
  std::string line = options.filtered.value_or(true) ? "noise removed" : "as recorded";
  if (options.mode == RayMode::accumulate) line += ", accumulated";
  if (options.mode == RayMode::maximum) line += ", maximum along each ray";
  if (options.mode == RayMode::first_hit) line += fmt::format(", surface at {:g} dB", options.first_hit_db);
  return options.lighting ? line + ", lit" : line;
}

/// Which colour is which school, in the lower left corner.
void add_school_legend(FrameDescription& frame, const Prepared& prepared, const PictureOptions& options,
                       const PixelRect& place, const Theme& theme) {
  constexpr std::size_t kMostEntries = 12;
  if (!options.masks || prepared.masks.empty() || prepared.masks.size() > kMostEntries) return;
  const double line = 1.5 * theme.text_px;
  double y = place.y + place.height - line * static_cast<double>(prepared.masks.size());
  for (const DrawnMask& drawn : prepared.ping.masks) {
    if (!wanted(drawn.school_id, options)) continue;
    const double x = place.x + line;
    frame.items.emplace_back(rectangle_item({x, y - 0.4 * theme.text_px, 0.8 * theme.text_px, 0.8 * theme.text_px},
                                            school_colour(static_cast<int>(drawn.school_id))));
    frame.items.emplace_back(TextItem{{x + line, y},
                                      fmt::format("school {}", drawn.school_id),
                                      theme.text_px,
                                      theme.text,
                                      TextAnchor::left,
                                      0.0,
                                      false,
                                      theme.halo});
    y += line;
  }
}

ContextParams context_params(const Prepared& prepared, const PictureOptions& options) {
  ContextParams params;
  params.sector_frame = params.range_rings = params.sea_surface = params.ship = params.depth_axis = options.context;
  params.ship_length_m = options.ship_length_m;
  params.transducer_depth_m = prepared.ping.navigation.transducer_depth_m;
  if (const double heading = prepared.ping.navigation.heading_deg; !std::isnan(heading)) params.heading_deg = heading;
  return params;
}

}  // namespace

Result<SeabedPatch> seabed_patch(const DepthGrid& grid, const Placement& ship, double reach_m) {
  SeabedPatch patch{kPatchNodes, kPatchNodes, -reach_m, -reach_m, 2.0 * reach_m / (kPatchNodes - 1), {}};
  bool known = false;
  for (int iy = 0; iy < patch.ny; ++iy) {
    for (int ix = 0; ix < patch.nx; ++ix) {
      const Point<Sonar> at{patch.first_x_m + ix * patch.spacing_m, patch.first_y_m + iy * patch.spacing_m, 0.0};
      const double depth = grid.depth_at(to_geographic(to_enu(at, ship.heading_rad), ship.transducer));
      known = known || !std::isnan(depth);
      patch.depth_m.push_back(static_cast<float>(depth));
    }
  }
  if (!known) return fail(ErrorCode::mismatch, "no depth is known round the ship", {grid.source});
  return patch;
}

Result<FrameDescription> volume_frame(DrawnObservation& observation, const PictureOptions& options, Work& work) {
  const auto prepared = prepare(observation, options, work);
  if (!prepared) return pass_on(prepared);
  const Theme theme = theme_of(options);
  const Layout layout =
      lay_out(options.size, theme, {.title_lines = 2, .colour_bar = true, .x_axis = false, .y_axis = false});
  const PixelSize size{static_cast<int>(layout.plot.width), static_cast<int>(layout.plot.height)};
  if (size.width < 16 || size.height < 16) {
    return fail(ErrorCode::bad_parameter, fmt::format("a picture of {} x {} pixels has no room for a volume",
                                                      options.size.width, options.size.height));
  }
  const auto patch = seabed(*prepared, options);
  if (!patch) return pass_on(patch);
  const ContextParams params = context_params(*prepared, options);
  const Camera camera = camera_of(prepared->sector, options, size);
  const ContextPicture context = draw_context(context_scene(prepared->sector, params, theme, *patch), camera, size,
                                              theme.plot, -params.transducer_depth_m, work);
  VolumeView view;
  view.camera = camera;
  view.size = size;
  view.mode = options.mode;
  view.first_hit_db = options.first_hit_db;
  view.lighting.on = options.lighting;
  view.masks = options.mask_style;
  view.masks.data_too = view.masks.data_too && prepared->ping.staged != nullptr;
  view.opaque_m = context.opaque_m;
  const auto rays = traced(*prepared, view, options, work);
  if (!rays) return pass_on(rays);

  FrameDescription frame{options.size, theme.background, observation.title(), {}};
  auto image = std::make_shared<const Image>(over(context.front, over(*rays, context.behind)));
  const PixelRect place{layout.plot.x, layout.plot.y, static_cast<double>(size.width),
                        static_cast<double>(size.height)};
  frame.items.emplace_back(ImageItem{place, std::move(image), false});
  FrameDescription labels{size, theme.background, {}, {}};
  if (options.context) add_context_labels(labels, prepared->sector, params, basis(camera, size), theme);
  for (auto& item : labels.items) {
    if (auto* text = std::get_if<TextItem>(&item)) {
      text->at.x += place.x;
      text->at.y += place.y;
      frame.items.emplace_back(std::move(*text));
    }
  }
  add_school_legend(frame, *prepared, options, place, theme);
  if (view.masks.data_too) add_colour_bar(frame, layout.colour_bar, colours_of(options), theme);
  const PingNavigation& navigation = prepared->ping.navigation;
  const std::string what = prepared->ping.staged ? "" : " (masks alone: no raw files)";
  add_title(frame, layout, theme,
            {fmt::format("{}{}   ping {}", observation.title(), what, prepared->ping.ping_index),
             view_line(options, view.masks.data_too)},
            time_text(navigation.time));
  return frame;
}

}  // namespace sonar
