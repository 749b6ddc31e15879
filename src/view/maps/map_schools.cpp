// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "view/label_room.h"
#include "view/maps/observation_map.h"
#include "view/school_labels.h"
#include "view/school_look.h"
#include "view/shapes.h"

namespace sonar {
namespace {

PathItem::Part path_of(const MapFrame& map, const MapSchool& school) {
  PathItem::Part part;
  for (const Geographic& place : school.places) {
    if (!std::isfinite(place.latitude_deg) || !std::isfinite(place.longitude_deg)) continue;
    if (const auto at = map.at(place)) part.points.push_back(*at);
  }
  return part;
}

}  // namespace

std::vector<MapSchool> map_schools(const ObservationProduct& product, std::int64_t selected, bool rejected) {
  std::vector<MapSchool> schools;
  auto row = product.school_pings.begin();
  for (const SchoolRow& school : product.schools) {
    if (!rejected && school.status == "rejected") continue;
    MapSchool& shown = schools.emplace_back();
    shown.number = school.school_id;
    shown.name = school.name;
    shown.status = school.status;
    shown.selected = school.school_id == selected;
    // Both tables rise with the number.
    while (row != product.school_pings.end() && row->school_id < school.school_id) ++row;
    for (; row != product.school_pings.end() && row->school_id == school.school_id; ++row) {
      shown.places.push_back({row->latitude, row->longitude});
    }
  }
  return schools;
}

void add_map_schools(FrameDescription& frame, const ObservationMapBase& base, std::span<const MapSchool> schools,
                     std::optional<PixelPoint> ship) {
  const Theme& theme = base.theme;
  const double em = theme.text_px;
  LabelRoom room(base.map.place);
  if (base.scale) room.take(base.scale->place);
  for (const auto& [symbol, half] : {std::pair(base.start, 0.5 * em), std::pair(ship, em)}) {
    if (symbol) room.take({symbol->x - half, symbol->y - half, 2.0 * half, 2.0 * half});
  }
  frame.items.emplace_back(ClipItem{base.map.place});
  // The selected school lies over the others, and its number is the first to find room.
  std::vector<const MapSchool*> order;
  for (const bool selected : {false, true}) {
    for (const MapSchool& school : schools) {
      if (school.selected == selected) order.push_back(&school);
    }
  }
  std::vector<PixelPoint> middles;
  for (const MapSchool* school : order) {
    PathItem::Part part = path_of(base.map, *school);
    middles.push_back(part.points.empty() ? PixelPoint{-1e9, -1e9} : part.points[part.points.size() / 2]);
    if (part.points.empty()) continue;
    for (std::size_t i = 1; i < part.points.size(); ++i) room.add_line(part.points[i - 1], part.points[i]);
    if (part.points.size() == 1) part.points.push_back({part.points[0].x + 1.0, part.points[0].y});
    const bool rejected = school->status == "rejected";
    const Rgba8 colour = rejected ? theme.muted : school_colour(static_cast<int>(school->number));
    const double wide = school->selected ? 2.6 : 1.6;
    for (const auto& [line, width] : {std::pair(theme.halo, wide + 1.8), std::pair(colour, wide)}) {
      PathItem item;
      item.parts.push_back(part);
      item.stroke = {line, width * theme.line_px,
                     width > wide ? std::vector<double>{} : status_dashes(school->status, theme)};
      frame.items.emplace_back(std::move(item));
    }
  }
  std::vector<NumberedPlace> places;
  for (std::size_t i = order.size(); i-- > 0;) {
    if (!inside(base.map.place, middles[i])) continue;
    places.push_back({middles[i], fmt::format("{}", order[i]->number), 0.25 * em, order[i]->selected,
                      named_text(order[i]->number, order[i]->name, theme)});
  }
  const auto left_out = add_school_numbers(frame, room, places, theme);
  if (!left_out.empty()) {
    const PixelPoint corner{base.map.place.x + base.map.place.width - 0.5 * em, base.map.place.y + 0.9 * em};
    const double size = small_text_px(theme, 0.9);
    TextItem note = text_item(corner, elided(left_out_text(left_out), size, base.map.place.width - em), size,
                              theme.text, TextAnchor::right);
    note.halo = theme.halo;
    frame.items.emplace_back(std::move(note));
  }
  frame.items.emplace_back(ClipItem{});
}

}  // namespace sonar
