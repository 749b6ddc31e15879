// SPDX-License-Identifier: Apache-2.0
#include "session/slices/slice_build.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "base/units.h"
#include "pipeline/stages/placements.h"
#include "pipeline/stages/voxel_statistics.h"
#include "pipeline/stages/weak_samples.h"
#include "publish/reports/sample_looks.h"
#include "session/looks/screen_theme.h"
#include "view/label_room.h"
#include "view/school_labels.h"
#include "view/shapes.h"
#include "view/slices/slice_cuts.h"

namespace sonar {
namespace {

/// The rows of one fan, or one beam; none for slices that meet any row.
std::vector<int> rows_of(const Slice& slice, const Sector& sector) {
  std::vector<int> rows;
  if (const auto* top = std::get_if<TopSlice>(&slice)) {
    for (int beam = 0; beam < sector.beams(); ++beam) rows.push_back(top->fan * sector.beams() + beam);
  } else if (const auto* side = std::get_if<SideSlice>(&slice)) {
    for (int fan = 0; fan < sector.fans(); ++fan) rows.push_back(fan * sector.beams() + side->beam);
  }
  return rows;
}

/// Flags of all that the slice shows; a range or a plane that moves through one ping finds them marked already.
View3<const SampleFlags> marked_flags(const SliceWish& wish, double below_db) {
  FlagRoom& room = *wish.room;
  const Shape3 shape = wish.ping->filtered->flags.shape();
  if (room.flags.shape() != shape) room.flags = Array3<SampleFlags>(shape);
  const std::vector<int> rows = rows_of(wish.view.slice, wish.observation->sector());
  if (!rows.empty()) {
    flag_weak_rows(*wish.ping, rows, below_db, room.flags.view());
  } else if (room.all_of.lock() != wish.ping || room.below_db != below_db) {
    flag_weak(*wish.ping, below_db, room.flags.view());
    room.all_of = wish.ping;
    room.below_db = below_db;
  }
  return View3<const SampleFlags>(room.flags.view());
}

/// What a slice shows of a mask, in the picture; empty where it shows nothing.
std::optional<PixelRect> shown_of(const SlicePicture& picture, const SliceWish& wish, const PingMask& mask) {
  const Sector& sector = wish.observation->sector();
  const bool along_beams = !rows_of(wish.view.slice, sector).empty();
  constexpr double kFar = std::numeric_limits<double>::infinity();
  PixelPoint low{kFar, kFar};
  PixelPoint high{-kFar, -kFar};
  for (const Run& run : mask.runs) {
    auto voxel = farthest_cut(sector, wish.view.slice, run);
    for (int end = 0; voxel && end < (along_beams ? 2 : 1); ++end) {
      if (const auto at = picture.place_of(*voxel)) {
        low = {std::min(low.x, at->x), std::min(low.y, at->y)};
        high = {std::max(high.x, at->x), std::max(high.y, at->y)};
      }
      voxel->sample = run.first_sample;
    }
  }
  const PixelRect& plot = picture.plot.place;  // zoomed, some of it lies beyond
  low = {std::max(low.x, plot.x), std::max(low.y, plot.y)};
  high = {std::min(high.x, plot.x + plot.width), std::min(high.y, plot.y + plot.height)};
  if (low.x > high.x || low.y > high.y) return std::nullopt;
  return PixelRect{low.x, low.y, high.x - low.x, high.y - low.y};
}

/// What no name may lie on: other words, and the ship of slices along beams, which stands where these begin.
void take_what_is_there(LabelRoom& room, const SlicePicture& picture, const SliceWish& wish, const Theme& theme) {
  for (const auto& item : picture.frame.items) {
    const auto* words = std::get_if<TextItem>(&item);
    if (words != nullptr && inside(picture.plot.place, words->at)) room.take(LabelRoom::box_of(*words));
  }
  if (rows_of(wish.view.slice, wish.observation->sector()).empty()) return;
  const PixelPoint ship = picture.map->pixel_of(0.0, 0.0);
  const double size = 2.4 * theme.text_px;
  room.take({picture.plot.place.x + ship.x - 0.5 * size, picture.plot.place.y + ship.y - 0.5 * size, size, size});
}

/// The selected school's name beside what the slice shows of it, or its number.
void name_selected(SlicePicture& picture, const SliceWish& wish, const Theme& theme) {
  for (const SchoolLayer& school : wish.layers) {
    if (!school.selected || !school.layer.mask) continue;
    const auto shown = shown_of(picture, wish, *school.layer.mask);
    if (!shown) continue;
    LabelRoom room(picture.plot.place);
    take_what_is_there(room, picture, wish, theme);
    TextItem name = text_item({}, school.title, theme.text_px, theme.text, TextAnchor::centre);
    name.bold = true;
    name.halo = theme.halo;
    add_selected_name(picture.frame, room, std::move(name), std::to_string(school.number), *shown, theme);
    return;
  }
}

}  // namespace

SlicePing slice_ping(const OpenObservation& observation, std::int64_t ping_index) {
  const PingNavigation& navigation = observation.files().navigation[static_cast<std::size_t>(ping_index)];
  SlicePing ping;
  ping.observation = observation.title();
  ping.ping_index = ping_index;
  ping.time = navigation.time;
  ping.heading_rad = rad_from_deg(navigation.heading_deg);
  ping.transducer_depth_m = navigation.transducer_depth_m;
  ping.frequency_hz = observation.grid().frequency_hz;
  ping.rays = observation.rays();
  ping.moved = moves_places(observation.recipe(), navigation);
  return ping;
}

SvColours slice_colours(const Workspace& workspace) {
  const SvScale& scale = workspace.display.values().scale;
  if (workspace.curve_follows_scale()) return sv_colours(scale);
  return sv_colours(workspace.view_curve(), scale.threshold_db, scale.no_data);
}

Result<SlicePicture> slice_of(const SliceWish& wish, PixelSize size) {
  const Volume& volume = wish.display.filtered ? *wish.ping->filtered : wish.ping->sv;
  SliceData data;
  data.sv = volume.counts.view();
  Array3<std::int16_t> restored;
  if (const SampleFlags reasons = put_back(wish.display); wish.display.filtered && any(reasons)) {
    restored = counts_put_back(*wish.ping, reasons);
    data.sv = View3<const std::int16_t>(restored.view());
  }
  data.flags = wish.ping->filtered->flags.view();
  if (const auto below_db = weak_below(wish.display)) {
    data.flags = marked_flags(wish, *below_db);
  }
  std::vector<const PingMask*> casting_shadow;
  for (const SchoolLayer& school : wish.layers) {
    MaskLayer layer = school.layer;
    if (school.casts_shadow) casting_shadow.push_back(school.layer.mask.get());
    layer.mask = fuzzy_area(layer.mask, wish.display.fuzzy_above);
    data.masks.push_back(std::move(layer));
  }
  data.refused = wish.refused;
  if (wish.display.shadow) {
    data.shadow_from = shadow_from(*wish.ping, wish.observation->sector(), casting_shadow,
                                   wish.observation->recipe().measure.extinction, wish.display.shadow_db);
  }
  SliceStyle style = slice_style(wish.display, *wish.colours);
  style.north_up = wish.north_up;
  const Theme theme = screen_theme(size, wish.look);
  auto picture = slice_picture(wish.observation->sector(), data, slice_ping(*wish.observation, wish.ping->ping_index),
                               wish.view, style, theme, size, wish.earlier);
  if (picture) name_selected(*picture, wish, theme);
  return picture;
}

}  // namespace sonar
