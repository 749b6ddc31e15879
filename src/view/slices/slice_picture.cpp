// SPDX-License-Identifier: Apache-2.0
#include "view/slices/slice_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/time.h"
#include "base/units.h"
#include "view/colour_bar.h"
#include "view/shapes.h"
#include "view/slices/slice_context.h"
#include "view/slices/slice_key.h"

namespace sonar {
namespace {

/// Axes in the slice's own coordinates, x right and y down, grown to fill the plot with square metres or degrees.
PlotFrame slice_axes(const PixelRect& place, const SliceExtent& extent) {
  PlotFrame plot{place, {extent.x0, extent.x1, "", false}, {extent.y0, extent.y1, "", false}};
  make_isotropic(plot);
  return plot;
}

/// Distances to either side of the ship, the bow up, without a sign; named is a side that has a number, and where only 0
/// stands on the axis the longer one.
void label_sides(PlotFrame& plot, const Theme& theme) {
  const auto named = [&](const char* sides) { return length_axis(plot.x.first, plot.x.last, sides, theme); };
  plot.x = named("port | starboard");
  const std::vector<double> numbers = x_ticks(plot, theme).major;
  const bool port = !numbers.empty() && numbers.front() < 0.0;
  const bool starboard = !numbers.empty() && numbers.back() > 0.0;
  if (!port || !starboard) {
    plot.x = named(port || (!starboard && plot.x.first + plot.x.last < 0.0) ? "port" : "starboard");
  }
  plot.x.both_ways = true;
}

void label_from_above(PlotFrame& plot, bool north_up, double up_rad, const Theme& theme) {
  const char* upwards = north_up ? "north" : up_rad == 0.0 ? "ahead" : "up";
  plot.y = length_axis(-plot.y.first, -plot.y.last, upwards, theme);
  if (!north_up && up_rad == 0.0) return label_sides(plot, theme);
  plot.x = length_axis(plot.x.first, plot.x.last, north_up ? "east" : "right", theme);
}

/// Slice coordinates to what people read: depths below the water line, north upwards, elevations upwards.
void label_axes(PlotFrame& plot, const SliceView& view, const SlicePing& ping, bool north_up, const Theme& theme) {
  const auto depths = [&](double origin_z) {
    plot.y.first += origin_z + ping.transducer_depth_m;
    plot.y.last += origin_z + ping.transducer_depth_m;
    plot.y = length_axis(plot.y.first, plot.y.last, ping.moved ? fmt::format("depth, {}", kStraightAndLevel) : "depth",
                         theme);
  };
  const auto from_above = [&] { label_from_above(plot, north_up, view.up_rad, theme); };
  if (std::holds_alternative<TopSlice>(view.slice)) return from_above();
  if (std::holds_alternative<SideSlice>(view.slice)) {
    depths(0.0);
    plot.x = length_axis(plot.x.first, plot.x.last, "horizontal distance", theme);
    return;
  }
  if (std::holds_alternative<RangeSlice>(view.slice)) {
    plot.x.degrees = plot.y.degrees = true;
    plot.x.label = "azimuth from the bow";
    plot.y = {-plot.y.first, -plot.y.last, "elevation", true};
    return;
  }
  const auto& plane = std::get<PlaneSlice>(view.slice);
  if (plane.kind == PlaneSlice::Kind::horizontal) return from_above();
  plot.x = length_axis(plot.x.first, plot.x.last, "along", theme);
  plot.y = length_axis(plot.y.first, plot.y.last, "down the plane", theme);
  if (plane.kind == PlaneSlice::Kind::vertical) depths(plane.origin.z);
}

void add_words(SlicePicture& out, const Layout& layout, const SlicePing& ping, const SliceStyle& style,
               const Theme& theme) {
  add_axes(out.frame, out.plot, theme, {style.grid, true});
  std::string first = ping.observation;
  if (ping.ping_index >= 0) first += fmt::format("{}ping {}", first.empty() ? "" : "   ", ping.ping_index);
  add_title(out.frame, layout, theme, {first, slice_text(out.map->sector(), out.map->view(), ping, style, theme.units)},
            ping.time != 0 ? time_text(ping.time) : "");
  add_colour_bar(out.frame, layout.colour_bar, colour_bar(style.colours), theme);
}

/// A ping that was recorded, and not one sample of what is shown.
bool nothing_recorded(const SliceMap& map, const SliceData& data) {
  if (data.flags.shape() != data.sv.shape()) return false;  // masks alone: nothing was asked for
  const auto sv = data.sv.all();
  return std::none_of(map.voxels().begin(), map.voxels().end(),
                      [&](int voxel) { return voxel >= 0 && sv[static_cast<std::size_t>(voxel)] != kNoData; });
}

void add_refused(SlicePicture& out, const std::vector<RefusedMark>& marks, const Theme& theme) {
  for (const RefusedMark& mark : marks) {
    auto at = place_of(*out.map, mark);
    if (!at) continue;
    at = PixelPoint{at->x + out.plot.place.x, at->y + out.plot.place.y};
    if (!inside(out.plot.place, *at)) continue;
    out.refused.push_back({*at, mark.echo_id});
    add_refused_mark(out.frame, *at, mark.chosen, theme);
  }
}

void say_nothing_recorded(FrameDescription& frame, const PixelRect& plot, const Theme& theme) {
  const PixelPoint middle{plot.x + 0.5 * plot.width, plot.y + 0.5 * plot.height};
  frame.items.emplace_back(
      TextItem{middle, "no data in this ping", theme.text_px, theme.text, TextAnchor::centre, 0.0, false, theme.halo});
}

std::vector<KeyEntry> key_of(const Sector& sector, const SliceData& data, const SliceView& view,
                             const SliceStyle& style, const Theme& theme, PixelSize size) {
  if (!style.key) return {};
  std::vector<bool> cut;
  bool refused = false;
  if (!style.key->schools.empty() || !data.refused.empty()) {
    // Of the slice without a key: how much room the key leaves depends on what the slice cuts.
    if (const auto bare = mapped_slice(sector, view, lay_out(size, theme).plot)) {
      cut = cut_masks(*bare->map, data.masks);
      refused = std::ranges::any_of(data.refused,
                                    [&](const RefusedMark& mark) { return place_of(*bare->map, mark).has_value(); });
    }
  }
  std::vector<KeyEntry> key = slice_key(style, cut, theme);
  if (refused) key.push_back(refused_key(theme));
  if (!data.shadow_from.empty()) key.push_back(shadow_key(theme));
  return key;
}

}  // namespace

std::optional<MappedSlice> mapped_slice(const Sector& sector, const SliceView& view, const PixelRect& place) {
  const std::optional<SliceExtent> extent = view.extent ? view.extent : whole_extent(sector, view);
  if (!extent) return std::nullopt;
  MappedSlice out{slice_axes(place, *extent), nullptr};
  const SliceExtent shown{out.plot.x.first, out.plot.y.first, out.plot.x.last, out.plot.y.last};
  const PixelSize pixels{static_cast<int>(place.width), static_cast<int>(place.height)};
  out.map = std::make_shared<const SliceMap>(sector, view, shown, pixels);
  return out;
}

std::optional<Voxel> SlicePicture::voxel_at(PixelPoint pixel) const {
  return map->voxel_at({pixel.x - plot.place.x, pixel.y - plot.place.y});
}

std::optional<PixelPoint> SlicePicture::place_of(const Voxel& voxel) const {
  const auto p = map->place_of(voxel);
  if (!p) return std::nullopt;
  return PixelPoint{p->x + plot.place.x, p->y + plot.place.y};
}

std::optional<PixelPoint> SlicePicture::carried(const Voxel& voxel) const {
  const auto p = map->carried(voxel);
  if (!p) return std::nullopt;
  return PixelPoint{p->x + plot.place.x, p->y + plot.place.y};
}

Result<SlicePicture> slice_picture(const Sector& sector, const SliceData& data, const SlicePing& ping,
                                   const SliceView& view, const SliceStyle& style, const Theme& theme, PixelSize size,
                                   std::shared_ptr<const SliceMap> earlier) {
  if (size.width < 160 || size.height < 120) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("a slice of {} x {} pixels; expected 160 x 120 or more", size.width, size.height));
  }
  if (sector.fans() == 0 || sector.beams() == 0 || sector.range().count == 0) {
    return fail(ErrorCode::bad_parameter, "the ping has no data to slice");
  }
  if (auto ok = check_slice(sector, view); !ok) return pass_on(ok);
  Layout layout;
  layout.plot = {0.0, 0.0, static_cast<double>(size.width), static_cast<double>(size.height)};
  std::vector<KeyEntry> key;
  if (style.decorations) {
    key = key_of(sector, data, view, style, theme, size);
    const double width = lay_out(size, theme, {.foot_lines = 1}).foot.width;
    layout = lay_out(size, theme, {.foot_lines = key_lines(key, width, theme)});
  }
  const PixelSize pixels{static_cast<int>(layout.plot.width), static_cast<int>(layout.plot.height)};
  SlicePicture out;
  if (earlier != nullptr && earlier->fits(sector, view, pixels)) {
    const SliceExtent& e = earlier->extent();
    out.plot = {layout.plot, {e.x0, e.x1, "", false}, {e.y0, e.y1, "", false}};
    out.map = std::move(earlier);
  } else {
    auto whole = mapped_slice(sector, view, layout.plot);
    if (!whole) return fail(ErrorCode::bad_parameter, "the slice does not meet the sonar's sector");
    out.plot = std::move(whole->plot);
    out.map = std::move(whole->map);
  }
  label_axes(out.plot, view, ping, style.north_up, theme);
  auto image = slice_image(*out.map, data, style.colours, style.flags, style.masks, theme);
  if (!image) return pass_on(image);

  out.frame.size = size;
  out.frame.background = theme.background;
  out.frame.title = slice_text(sector, view, ping, style, theme.units);
  out.frame.items.emplace_back(rectangle_item(layout.plot, theme.plot));
  out.frame.items.emplace_back(ImageItem{layout.plot, std::make_shared<const Image>(std::move(*image)), false});
  out.frame.items.emplace_back(ClipItem{layout.plot});
  add_slice_context(out.frame, *out.map, {layout.plot.x, layout.plot.y}, ping, style, theme);
  add_refused(out, data.refused, theme);
  out.frame.items.emplace_back(ClipItem{});
  if (style.decorations && nothing_recorded(*out.map, data)) say_nothing_recorded(out.frame, layout.plot, theme);
  if (style.decorations) add_words(out, layout, ping, style, theme);
  add_key(out.frame, layout.foot, key, theme);
  return out;
}

}  // namespace sonar
