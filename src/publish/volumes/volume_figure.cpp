// SPDX-License-Identifier: Apache-2.0
#include "publish/volumes/volume_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "base/time.h"
#include "base/units.h"
#include "pipeline/stages/weak_samples.h"
#include "publish/reports/sample_looks.h"
#include "publish/volumes/volume_legend.h"
#include "view/colour_bar.h"
#include "view/label_room.h"
#include "view/slices/slice_picture.h"
#include "view/volume/context_layout.h"
#include "view/volume/distance_bar.h"
#include "view/volume/earth_pose.h"

namespace sonar {
namespace {

/// Of the seabed that the picture has room for, percent; 100 only where nothing is missing.
int known_percent(const SeabedPatch& bed) {
  const auto known = std::count_if(bed.depth_m.begin(), bed.depth_m.end(), [](float d) { return !std::isnan(d); });
  return static_cast<int>(100 * known / std::max<std::ptrdiff_t>(1, static_cast<std::ptrdiff_t>(bed.depth_m.size())));
}

/// What the seabed's lines are and how its relief is lit.
std::string seabed_words(const SeabedPatch& bed, double room_px, double text_px, const Units& units) {
  const double step = seabed_line_step_m(bed, units);
  if (!(step > 0.0)) return {};
  const double times = relief_exaggeration(bed);
  const std::string lines = "; seabed lines every " + round_text(step, units.length());
  std::string relief;
  if (times > 1.5) relief = fmt::format(", lit as if {:.0f} times as steep", times);
  if (text_width_px((lines + relief).c_str(), text_px) < room_px) return lines + relief;
  return text_width_px(lines.c_str(), text_px) < room_px ? lines : std::string();
}

/// What a level is called: "-50 dB".
std::string level_text(double db) { return fmt::format("{}{:g} dB", db < 0.0 ? "\u2212" : "", std::abs(db)); }

/// How the picture was made and what its bearings start from, for its second line.
/// place  whose title has to hold it
std::string view_line(const VolumeFigure& figure, const PictureOptions& options, const VolumePlace& place,
                      bool data_too) {
  std::string line = "masks of schools";
  if (data_too) {
    line = options.volume.filtered ? "noise removed" : "as recorded";
    if (options.volume.mode == RayMode::accumulate) line += ", accumulated";
    if (options.volume.mode == RayMode::maximum) line += ", maximum along each ray";
    if (options.volume.mode == RayMode::volume_and_surface) line += ", accumulated up to the";
    if (options.volume.mode == RayMode::first_hit) line += ",";
    if (ends_at_surface(options.volume.mode)) {
      line += fmt::format(" surface at {}", level_text(options.volume.first_hit_db));
    }
    if (options.volume.lighting) line += ", lit";
    if (options.volume.depth_cue) line += ", paler with distance";
    if (options.volume.clip != VolumeClip::none) line += ", cut open";
  }
  if (figure.seabed && known_percent(*figure.seabed) < 100) {
    line += fmt::format("; depths known of {} % of the seabed", known_percent(*figure.seabed));
  }
  if (options.volume.context) {
    line += std::isnan(figure.navigation.heading_deg) ? "; bearings from the bow" : "; true bearings";
  }
  if (figure.moved) line += fmt::format("; {}", kStraightAndLevel);
  if (options.volume.earth_fixed) {
    line += on_earth(figure.navigation) ? "; earth-fixed" : "; not earth-fixed: no position or heading";
  }
  if (figure.seabed) {
    const double text_px = place.theme.text_px;
    line += seabed_words(*figure.seabed, place.layout.title.width - text_width_px(line.c_str(), text_px), text_px,
                         options.units);
  }
  return line;
}

/// Why there is nothing in the picture; empty where something is.
std::string nothing_shown(const VolumeFigure& figure, const PictureOptions& options, const VolumeView& view,
                          const RayImage& rays) {
  if (!view.masks.data_too) {
    if (!figure.masks.empty()) return {};
    return !figure.searched ? "no masks: schools not detected" : "no masks: no school in this ping";
  }
  const bool met = std::any_of(rays.rgba.begin(), rays.rgba.end(), [](const auto& pixel) { return pixel[3] > 0.0F; });
  if (met || view.mode != RayMode::first_hit) return {};
  return fmt::format("nothing reaches {} here", level_text(options.volume.first_hit_db));
}

/// Sv above, the seabed's depths below it; where only one is drawn it takes all the room.
void add_colour_bars(FrameDescription& frame, const VolumeFigure& figure, const PictureOptions& options,
                     const VolumePlace& place, bool data_too) {
  const Theme& theme = place.theme;
  const auto depths = figure.seabed ? depth_span(*figure.seabed) : std::nullopt;
  PixelRect above = place.layout.colour_bar;
  PixelRect below = above;
  if (data_too && depths) {
    // Room for the threshold's figure, which stands under the Sv bar.
    const double gap = 4.2 * theme.text_px;
    above.height = std::max(8.0, std::round(0.55 * (above.height - gap)));
    below.y = above.y + above.height + gap;
    below.height = std::max(8.0, below.height - above.height - gap);
  }
  if (data_too) add_colour_bar(frame, above, colour_bar(colours_of(options)), theme);
  if (depths) {
    const Unit unit = theme.units.length();
    add_colour_bar(frame, below,
                   colour_bar(seabed_colours(), unit.of(depths->first), unit.of(depths->second),
                              with_unit("seabed depth", unit), true),
                   theme);
  }
}

/// Of the refused marks that are seen, in the picture; as many as `figure.refused`, NaN = not seen.
std::vector<PixelPoint> places_of_refused(const VolumeFigure& figure, const VolumePlace& place,
                                          const VolumeView& view) {
  const CameraBasis eye = basis(view.camera, view.size);
  std::vector<PixelPoint> out;
  for (const RefusedMark& mark : figure.refused) {
    out.push_back({std::nan(""), std::nan("")});
    const auto seen = eye.project(figure.sector().centre(mark.loudest.fan, mark.loudest.beam, mark.loudest.sample));
    if (!seen) continue;
    const PixelPoint at{place.rect.x + seen->pixel.x / place.scale, place.rect.y + seen->pixel.y / place.scale};
    if (inside(place.rect, at)) out.back() = at;
  }
  return out;
}

/// The sector, the schools, and the words that are written over them.
KeptClear kept_clear_in(const VolumeFigure& figure, const ContextParams& around, const VolumePlace& place,
                        const VolumeView& view, const std::vector<TextItem>& words) {
  const CameraBasis eye = basis(view.camera, view.size);
  KeptClear out;
  const auto in_picture = [&place](ConvexOutline shape) {
    for (PixelPoint& p : shape) p = {place.rect.x + p.x / place.scale, place.rect.y + p.y / place.scale};
    return shape;
  };
  out.sector = in_picture(sector_outline(figure.sector(), around, eye));
  for (const MaskLayer& layer : figure.masks) {
    const auto school = layer.mask ? school_place(figure.sector(), *layer.mask) : std::nullopt;
    if (school) out.always.push_back(in_picture(school_outline(*school, eye)));
  }
  for (const TextItem& item : words) out.always.push_back(outline_of(LabelRoom::box_of(item)));
  return out;
}

/// What is written over the volume: why nothing is shown, and what nobody may miss.
std::vector<TextItem> words_over(const VolumeFigure& figure, const PictureOptions& options, const VolumePlace& place,
                                 const VolumeView& view, const RayImage& rays) {
  const Theme& theme = place.theme;
  const PixelPoint middle{place.rect.x + 0.5 * place.rect.width, place.rect.y + 0.5 * place.rect.height};
  const PixelPoint top{middle.x, place.rect.y + 1.2 * theme.text_px};
  std::vector<TextItem> out;
  const auto write = [&](PixelPoint at, const std::string& words, bool bold) {
    const std::string line = elided_line(words, theme.text_px, place.rect.width);
    if (line.empty()) return;
    out.push_back({at, line, theme.text_px, theme.text, TextAnchor::centre, 0.0, bold, theme.halo});
  };
  write(middle, nothing_shown(figure, options, view, rays), false);
  write(top, figure.mark, true);
  return out;
}

void add_refused(FrameDescription& frame, const VolumeFigure& figure, const VolumePlace& place,
                 const VolumeView& view) {
  const std::vector<PixelPoint> places = places_of_refused(figure, place, view);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!std::isnan(places[i].x)) add_refused_mark(frame, places[i], figure.refused[i].chosen, place.theme);
  }
}

/// The scale bar in the lower right corner, else along the edges; over the sector where there is no room beside it, and none
/// where there is no room at all.
/// returns  what it covers
std::optional<PixelRect> add_scale_bar(FrameDescription& frame, const VolumePlace& place, const Camera& camera,
                                       const KeptClear& kept_clear) {
  const Theme& theme = place.theme;
  const PixelSize size{static_cast<int>(place.rect.width), static_cast<int>(place.rect.height)};
  const auto bar = distance_bar(camera, size, std::min(0.25 * size.width, 14.0 * theme.text_px), theme.units.length());
  if (!bar) return std::nullopt;
  const double gap = 0.6 * theme.text_px;
  const PixelRect extent = distance_bar_place(*bar, 0.0, 0.0, theme);
  for (const bool over_sector : {false, true}) {
    const auto found = place_off(kept_clear, over_sector, place.rect, extent.width + 2.0 * gap,
                                 extent.height + 2.0 * gap, Corner::lower_right);
    if (!found) continue;
    const PixelRect covered{found->x + gap, found->y + gap, extent.width, extent.height};
    add_distance_bar(frame, *bar, covered, theme);
    return covered;
  }
  return std::nullopt;
}

/// Labels of the surroundings and the scale bar, which keep off the legend, off other words and off each other.
void add_labels(FrameDescription& frame, const VolumeFigure& figure, const ContextParams& around,
                const VolumePlace& place, const VolumeView& view, const PixelRect& legend,
                const std::vector<TextItem>& words, KeptClear kept_clear) {
  const Theme& theme = place.theme;
  const PixelSize size{static_cast<int>(place.rect.width), static_cast<int>(place.rect.height)};
  FrameDescription labels{size, theme.background, {}, {}};
  std::vector<PixelRect> taken;
  const auto take = [&](PixelRect rect) {
    rect.x -= place.rect.x;
    rect.y -= place.rect.y;
    taken.push_back(rect);
  };
  take(legend);
  for (const TextItem& item : words) take(LabelRoom::box_of(item));
  kept_clear.always.push_back(outline_of(legend));
  if (const auto bar = add_scale_bar(frame, place, view.camera, kept_clear)) take(*bar);
  const double reach = mark_reach_px(theme);
  for (const PixelPoint& mark : places_of_refused(figure, place, view)) {
    if (std::isnan(mark.x)) continue;
    taken.push_back({mark.x - place.rect.x - reach, mark.y - place.rect.y - reach, 2.0 * reach, 2.0 * reach});
  }
  OpaqueView opaque{view.size, {}};
  if (view.opaque_m) opaque.metres = *view.opaque_m;
  add_context_labels(labels, figure.sector(), around, basis(view.camera, size), theme, opaque, taken);
  const auto move = [&place](PixelPoint& p) { p = {p.x + place.rect.x, p.y + place.rect.y}; };
  for (auto& item : labels.items) {
    if (auto* text = std::get_if<TextItem>(&item)) move(text->at);
    if (auto* line = std::get_if<PathItem>(&item)) {
      for (auto& part : line->parts) std::for_each(part.points.begin(), part.points.end(), move);
    }
    frame.items.emplace_back(std::move(item));
  }
}

}  // namespace

std::shared_ptr<const VolumeData> drawn_volume(const Sector& sector, const StagedPing& staged,
                                               const PictureOptions& options, const VolumeCut& cut,
                                               double transducer_depth_m) {
  const SampleFlags reasons = put_back(options.display);
  Volume shown{!options.volume.filtered ? staged.sv.counts
               : any(reasons)           ? counts_put_back(staged, reasons)
                                        : staged.filtered->counts,
               staged.filtered->flags};
  if (const auto below_db = weak_below(options.display)) flag_weak(staged, *below_db, shown.flags.view());
  const SampleFlags left_out = left_out_of_volume(options.display);
  VolumeData drawn = volume_data(sector, shown, left_out, transducer_depth_m);
  cut_away(drawn.sv, cut);
  return std::make_shared<const VolumeData>(std::move(drawn));
}

bool wants_outlines(const VolumeFigure& figure, const PictureOptions& options) {
  return (options.volume.mode != RayMode::accumulate || !options.display.tint) && options.volume.data &&
         figure.samples && !figure.masks.empty();
}

bool same_volume(const PictureOptions& a, const PictureOptions& b) {
  return a.volume.filtered == b.volume.filtered && put_back(a.display) == put_back(b.display) &&
         left_out_of_volume(a.display) == left_out_of_volume(b.display) &&
         weak_below(a.display) == weak_below(b.display);
}

Result<VolumePlace> volume_place(const PictureOptions& options, double scale) {
  VolumePlace out;
  out.theme = theme_of(options);
  out.scale = scale;
  out.layout =
      lay_out(options.size, out.theme, {.title_lines = 2, .colour_bar = true, .x_axis = false, .y_axis = false});
  const PixelSize size{static_cast<int>(out.layout.plot.width), static_cast<int>(out.layout.plot.height)};
  if (size.width < 16 || size.height < 16) {
    return fail(ErrorCode::bad_parameter, fmt::format("a picture of {} x {} pixels has no room for a volume",
                                                      options.size.width, options.size.height));
  }
  out.rect = {out.layout.plot.x, out.layout.plot.y, static_cast<double>(size.width), static_cast<double>(size.height)};
  out.rays = {static_cast<int>(std::lround(size.width * scale)), static_cast<int>(std::lround(size.height * scale))};
  return out;
}

Theme scaled_theme(const VolumePlace& place) {
  Theme theme = place.theme;
  theme.line_px *= place.scale;
  theme.text_px *= place.scale;
  return theme;
}

Result<Camera> volume_camera(const Sector& sector, const PictureOptions& options, PixelSize size) {
  const CameraParams& params = options.kind.volume;
  const auto named = named_camera(params);
  if (!named) return pass_on(named);
  const Camera from = options.camera ? *options.camera : named->has_value() ? **named : overview(sector, size);
  return zoomed(orbited(from, rad_from_deg(params.orbit_deg), rad_from_deg(params.rise_deg)), 1.0 / params.zoom);
}

Result<OpticalTable> volume_table(const PictureOptions& options) {
  const auto curve = view_curve(options);
  if (!curve) return pass_on(curve);
  const double first = curve->points().front().sv_db;
  auto table =
      optical_table(*curve, options.volume.table_entries, first, std::max(first + 1.0, curve->points().back().sv_db));
  if (!table) return table;
  // What lies below the analysis threshold is not shown, whatever curve is given.
  const double step_db = (table->last_db - table->first_db) / (options.volume.table_entries - 1);
  for (std::size_t i = 0; i < table->rgb_extinction.size(); ++i) {
    if (table->first_db + step_db * static_cast<double>(i) < options.display.scale.threshold_db)
      table->rgb_extinction[i][3] = 0.0F;
  }
  return table;
}

VolumeView volume_view(const VolumeFigure& figure, const PictureOptions& options, const VolumePlace& place,
                       const Camera& camera, const ContextPicture& context) {
  VolumeView view;
  view.camera = camera;
  view.size = place.rays;
  view.mode = options.volume.mode;
  view.first_hit_db = options.volume.first_hit_db;
  view.lighting.on = options.volume.lighting;
  view.lighting.occlusion_m = static_cast<float>(options.volume.occlusion_m);
  if (options.volume.depth_cue) view.cue = depth_cue(figure.sector(), camera, place.theme.plot);
  view.masks = mask_style(options.display, options.volume);
  view.masks.data_too = view.masks.data_too && figure.samples;
  view.opaque_m = context.opaque_m;
  return view;
}

FrameDescription volume_figure_frame(const VolumeFigure& figure, const PictureOptions& options,
                                     const VolumePlace& place, const VolumeView& view, const ContextPicture& context,
                                     const RayImage& rays, Work& work) {
  const Theme& theme = place.theme;
  FrameDescription frame{options.size, theme.background, figure.title, {}};
  frame.items.emplace_back(ImageItem{place.rect, std::make_shared<const Image>(between(context, rays, work)), false});
  const std::vector<TextItem> words = words_over(figure, options, place, view, rays);
  const ContextParams around = volume_surroundings(figure, options);
  const KeptClear kept_clear = kept_clear_in(figure, around, place, view, words);
  const PlacedLegend legend = placed_legend(figure, options, place.rect, theme, kept_clear);
  if (options.volume.context) add_labels(frame, figure, around, place, view, legend.place, words, kept_clear);
  add_refused(frame, figure, place, view);
  add_volume_legend(frame, legend, theme);
  frame.items.insert(frame.items.end(), words.begin(), words.end());
  add_colour_bars(frame, figure, options, place, view.masks.data_too);
  std::string line = view_line(figure, options, place, view.masks.data_too);
  if (legend.left_out) line += "; no room for the legend";
  add_title(frame, place.layout, theme, {figure.title_line, line}, time_text(figure.navigation.time));
  return frame;
}

}  // namespace sonar
