// SPDX-License-Identifier: Apache-2.0
#include "publish/volume_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/time.h"
#include "base/units.h"
#include "pipeline/stages/weak_samples.h"
#include "publish/sample_looks.h"
#include "view/colour_bar.h"
#include "view/shapes.h"

namespace sonar {
namespace {

/// Of the seabed that the picture has room for, percent; 100 only where nothing is missing.
int known_percent(const SeabedPatch& bed) {
  const auto known = std::count_if(bed.depth_m.begin(), bed.depth_m.end(), [](float d) { return !std::isnan(d); });
  return static_cast<int>(100 * known / std::max<std::ptrdiff_t>(1, static_cast<std::ptrdiff_t>(bed.depth_m.size())));
}

/// What the seabed's lines are and how its relief is lit.
std::string seabed_words(const SeabedPatch& bed, double room_px, double text_px) {
  const double step = seabed_line_step_m(bed);
  if (!(step > 0.0)) return {};
  const double times = relief_exaggeration(bed);
  const std::string lines = fmt::format("; seabed lines every {:g} m", step);
  std::string relief;
  if (times > 1.5) relief = fmt::format(", lit as if {:.0f} times as steep", times);
  if (text_width_px((lines + relief).c_str(), text_px) < room_px) return lines + relief;
  return text_width_px(lines.c_str(), text_px) < room_px ? lines : std::string();
}

/// How the picture was made and what its bearings start from, for its second line.
/// place  whose title has to hold it
std::string view_line(const VolumeFigure& figure, const PictureOptions& options, const VolumePlace& place,
                      bool data_too) {
  std::string line = "masks of schools";
  if (data_too) {
    line = options.volume.filtered ? "noise removed" : "as recorded";
    if (options.volume.mode == RayMode::accumulate) line += ", accumulated";
    if (options.volume.mode == RayMode::maximum) line += ", maximum along each ray";
    if (options.volume.mode == RayMode::first_hit) {
      line += fmt::format(", surface at {}{:g} dB", options.volume.first_hit_db < 0.0 ? "\u2212" : "",
                          std::abs(options.volume.first_hit_db));
    }
    if (options.volume.lighting) line += ", lit";
  }
  if (figure.seabed && known_percent(*figure.seabed) < 100) {
    line += fmt::format("; depths known of {} % of the seabed", known_percent(*figure.seabed));
  }
  if (options.volume.context) {
    line += std::isnan(figure.navigation.heading_deg) ? "; bearings from the bow" : "; true bearings";
  }
  if (figure.seabed) {
    const double text_px = place.theme.text_px;
    line += seabed_words(*figure.seabed, place.layout.title.width - text_width_px(line.c_str(), text_px), text_px);
  }
  return line;
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
  if (data_too) add_colour_bar(frame, above, colours_of(options), theme);
  if (depths)
    add_colour_bar(frame, below, seabed_colours(), depths->first, depths->second, theme, "seabed depth (m)", true);
}

/// How core and fuzzy area look, and which colour is which school, in the lower left corner.
class SchoolLegend {
 public:
  SchoolLegend(FrameDescription& frame, const PixelRect& place, const Theme& theme, std::size_t rows)
      : frame_(frame),
        theme_(theme),
        x_(place.x + line()),
        y_(place.y + place.height - line() * (static_cast<double>(rows))) {}

  void area(Rgba8 colour, const std::string& words) {
    const double em = theme_.text_px;
    frame_.items.emplace_back(rectangle_item({x_, y_ - 0.4 * em, 0.8 * em, 0.8 * em}, colour));
    text(words);
  }
  void mark(const std::string& words) {
    add_refused_mark(frame_, {x_ + 0.4 * theme_.text_px, y_}, false, theme_);
    text(words);
  }
  void outline(bool broken, const std::string& words) {
    const double em = theme_.text_px;
    PathItem item = line_item({x_ - 0.2 * em, y_}, {x_ + em, y_}, theme_.text, 2.0 * theme_.line_px);
    if (broken) item.stroke.dashes_px = {0.3 * em, 0.3 * em};
    frame_.items.emplace_back(std::move(item));
    text(words);
  }

 private:
  [[nodiscard]] double line() const { return 1.5 * theme_.text_px; }
  void text(const std::string& words) {
    frame_.items.emplace_back(
        TextItem{{x_ + line(), y_}, words, theme_.text_px, theme_.text, TextAnchor::left, 0.0, false, theme_.halo});
    y_ += line();
  }

  FrameDescription& frame_;
  const Theme& theme_;
  double x_;
  double y_;
};

void add_school_legend(FrameDescription& frame, const VolumeFigure& figure, const PictureOptions& options,
                       const PixelRect& place, const Theme& theme) {
  constexpr std::size_t kMostEntries = 12;
  const bool schools = options.display.masks && !figure.legend.empty() && figure.legend.size() <= kMostEntries;
  const bool refused = !figure.refused.empty();
  SchoolLegend legend(frame, place, theme, (schools ? figure.legend.size() + 2 : 0) + (refused ? 1 : 0));
  if (refused) legend.mark(kRefusedWords);
  if (!schools) return;
  const std::string core = fmt::format("core, confidence {:g} and more", options.display.core_at);
  if (figure.outlined) {
    legend.outline(true, core);
    legend.outline(false, "fuzzy area");
  } else {
    legend.area(theme.text, core);
    legend.area(
        with_alpha(theme.text, static_cast<int>(255.0F * mask_style(options.display, options.volume).fuzzy_opacity)),
        "fuzzy area");
  }
  for (const auto& [colour, name] : figure.legend) legend.area(colour, name);
}

void add_refused(FrameDescription& frame, const VolumeFigure& figure, const VolumePlace& place,
                 const VolumeView& view) {
  const CameraBasis eye = basis(view.camera, view.size);
  for (const RefusedMark& mark : figure.refused) {
    const auto seen = eye.project(figure.sector().centre(mark.loudest.fan, mark.loudest.beam, mark.loudest.sample));
    if (!seen) continue;
    const PixelPoint at{place.rect.x + seen->pixel.x / place.scale, place.rect.y + seen->pixel.y / place.scale};
    if (inside(place.rect, at)) add_refused_mark(frame, at, mark.chosen, place.theme);
  }
}

}  // namespace

std::shared_ptr<const VolumeData> drawn_volume(const Sector& sector, const StagedPing& staged,
                                               const PictureOptions& options, double transducer_depth_m) {
  const SampleFlags reasons = put_back(options.display);
  Volume shown{!options.volume.filtered ? staged.sv.counts
               : any(reasons)           ? counts_put_back(staged, reasons)
                                        : staged.filtered->counts,
               staged.filtered->flags};
  if (const auto below_db = weak_below(options.display)) flag_weak(staged, *below_db, shown.flags.view());
  const SampleFlags left_out = left_out_of_volume(options.display);
  return std::make_shared<const VolumeData>(volume_data(sector, shown, left_out, transducer_depth_m));
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

ContextParams volume_surroundings(const PingNavigation& navigation, const PictureOptions& options) {
  ContextParams params;
  params.sector_frame = params.range_rings = params.sea_surface = params.ship = params.depth_axis =
      options.volume.context;
  params.ship_length_m = options.volume.ship_length_m;
  params.transducer_depth_m = navigation.transducer_depth_m;
  if (const double heading = navigation.heading_deg; !std::isnan(heading)) params.heading_deg = heading;
  return params;
}

ContextPicture volume_context(const VolumeFigure& figure, const PictureOptions& options, const VolumePlace& place,
                              const Camera& camera, Work& work) {
  const ContextParams params = volume_surroundings(figure.navigation, options);
  Theme theme = place.theme;
  theme.line_px *= place.scale;
  theme.text_px *= place.scale;
  return draw_context(context_scene(figure.sector(), params, theme, figure.seabed), camera, place.rays, theme.plot,
                      -params.transducer_depth_m, work);
}

VolumeView volume_view(const VolumeFigure& figure, const PictureOptions& options, const VolumePlace& place,
                       const Camera& camera, const ContextPicture& context) {
  VolumeView view;
  view.camera = camera;
  view.size = place.rays;
  view.mode = options.volume.mode;
  view.first_hit_db = options.volume.first_hit_db;
  view.lighting.on = options.volume.lighting;
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
  const PixelSize size{static_cast<int>(place.rect.width), static_cast<int>(place.rect.height)};
  FrameDescription labels{size, theme.background, {}, {}};
  if (options.volume.context) {
    OpaqueView opaque{view.size, {}};
    if (view.opaque_m) opaque.metres = *view.opaque_m;
    add_context_labels(labels, figure.sector(), volume_surroundings(figure.navigation, options),
                       basis(view.camera, size), theme, opaque);
  }
  for (auto& item : labels.items) {
    if (auto* text = std::get_if<TextItem>(&item)) {
      text->at.x += place.rect.x;
      text->at.y += place.rect.y;
      frame.items.emplace_back(std::move(*text));
    }
  }
  add_refused(frame, figure, place, view);
  add_school_legend(frame, figure, options, place.rect, theme);
  if (!view.masks.data_too && figure.masks.empty()) {
    const PixelPoint middle{place.rect.x + 0.5 * place.rect.width, place.rect.y + 0.5 * place.rect.height};
    const char* words = !figure.searched ? "no masks: schools not detected" : "no masks: no school in this ping";
    frame.items.emplace_back(
        TextItem{middle, words, theme.text_px, theme.text, TextAnchor::centre, 0.0, false, theme.halo});
  }
  add_colour_bars(frame, figure, options, place, view.masks.data_too);
  add_title(frame, place.layout, theme, {figure.title_line, view_line(figure, options, place, view.masks.data_too)},
            time_text(figure.navigation.time));
  return frame;
}

}  // namespace sonar
