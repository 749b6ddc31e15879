// SPDX-License-Identifier: Apache-2.0
#include "view/school_labels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>

#include "base/number_text.h"
#include "view/shapes.h"

namespace sonar {
namespace {

/// Gaps between a place and its number, em of the text; from the second on a line leads there.
constexpr std::array<double, 7> kGaps_em{0.35, 1.6, 2.8, 4.2, 6.0, 8.0, 10.5};
constexpr int kNearDirections = 8;
constexpr int kFarDirections = 16;

/// Where a number's middle may stand: round its place, to the upper right first, at one distance.
std::vector<PixelPoint> round_about(const NumberedPlace& place, const PixelRect& box, double gap_px, int directions) {
  std::vector<PixelPoint> out;
  for (int i = 0; i < directions; ++i) {
    // Right and left by turns, so that what is near the first choice comes before what lies opposite.
    const int turn = (i % 2 == 0 ? 1 : -1) * ((i + 1) / 2);
    const double angle = -std::numbers::pi / 4 + 2.0 * std::numbers::pi * turn / directions;
    const double x = std::cos(angle);
    const double y = std::sin(angle);
    const double reach = place.radius_px + gap_px;
    out.push_back({place.at.x + x * (reach + box.width / 2), place.at.y + y * (reach + 0.4 * box.height)});
  }
  return out;
}

/// From the label's edge towards its place.
PixelPoint edge_towards(const PixelRect& box, PixelPoint at) {
  return {std::clamp(at.x, box.x, box.x + box.width), std::clamp(at.y, box.y, box.y + box.height)};
}

/// A line from a place to its number.
void add_leader(FrameDescription& frame, LabelRoom& room, const PixelRect& number, const NumberedPlace& place,
                const Theme& theme) {
  const PixelPoint end = edge_towards(number, place.at);
  const double length = std::hypot(end.x - place.at.x, end.y - place.at.y);
  if (length <= place.radius_px) return;
  const double part = place.radius_px / length;
  const PixelPoint from{place.at.x + part * (end.x - place.at.x), place.at.y + part * (end.y - place.at.y)};
  for (const auto& [colour, width] : {std::pair(theme.halo, 2.6), std::pair(theme.text, 0.9)}) {
    frame.items.emplace_back(line_item(from, end, colour, width * theme.line_px));
  }
  room.add_line(from, end);
}

}  // namespace

std::optional<TextItem> placed_about(FrameDescription& frame, LabelRoom& room, const TextItem& label,
                                     const NumberedPlace& place, const Theme& theme, std::size_t nearest) {
  const PixelRect box = LabelRoom::box_of(label);
  for (std::size_t i = nearest; i < kGaps_em.size(); ++i) {
    const auto where = round_about(place, box, kGaps_em[i] * theme.text_px, i == 0 ? kNearDirections : kFarDirections);
    auto placed = room.place(label, where);
    if (!placed) continue;
    if (i > 0) add_leader(frame, room, LabelRoom::box_of(*placed), place, theme);
    return placed;
  }
  return std::nullopt;
}

std::array<PixelPoint, 8> places_beside(const PixelRect& named, const TextItem& label) {
  const PixelRect own = LabelRoom::box_of(label);
  const double right = 0.5 * (named.width + own.width) + 0.3 * label.size_px;
  const double down = 0.5 * (named.height + own.height) + 0.15 * label.size_px;
  const PixelPoint c{named.x + 0.5 * named.width, named.y + 0.5 * named.height};
  return {{{c.x + right, c.y},
           {c.x - right, c.y},
           {c.x, c.y - down},
           {c.x, c.y + down},
           {c.x + right, c.y - down},
           {c.x - right, c.y - down},
           {c.x + right, c.y + down},
           {c.x - right, c.y + down}}};
}

void add_selected_name(FrameDescription& frame, LabelRoom& room, TextItem name, const std::string& number,
                       const PixelRect& seen, const Theme& theme) {
  LabelRoom beside = room;
  beside.take(seen);
  auto placed = beside.place(name, places_beside(seen, name));
  if (!placed) {
    name.text = number;
    name.at = {seen.x + 0.5 * seen.width, seen.y + 0.5 * seen.height};
    placed = beside.place(name, places_beside(seen, name));
  }
  const NumberedPlace place{name.at, number, 0.5 * std::min(seen.width, seen.height)};
  if (!placed) placed = placed_about(frame, beside, name, place, theme, 1);
  if (!placed) {
    placed = beside.place_nearest(name);
    if (placed) add_leader(frame, beside, LabelRoom::box_of(*placed), place, theme);
  }
  if (placed) {
    room = std::move(beside);
  } else {
    placed = room.place_nearest(name);  // on the school: it fills the picture
    room.take(seen);
  }
  frame.items.emplace_back(placed ? *placed : room.force(name));
}

std::string named_text(std::int64_t number, const std::string& name, const Theme& theme) {
  constexpr double kWidest_em = 12.0;
  if (name.empty()) return {};
  return elided(fmt::format("{} {}", number, name), theme.text_px, kWidest_em * theme.text_px);
}

std::vector<std::string> add_school_numbers(FrameDescription& frame, LabelRoom& room,
                                            std::span<const NumberedPlace> places, const Theme& theme) {
  std::vector<std::string> left_out;
  std::vector<TextItem> numbers;
  for (const NumberedPlace& place : places) {
    TextItem number =
        text_item(place.at, place.text, theme.text_px, place.selected ? theme.accent : theme.text, TextAnchor::centre);
    number.bold = true;
    number.halo = theme.halo;
    std::optional<TextItem> placed;
    for (const std::string& words : {place.named, place.text}) {
      if (words.empty() || placed) continue;
      number.text = words;
      placed = placed_about(frame, room, number, place, theme);
    }
    if (placed) {
      numbers.push_back(std::move(*placed));
    } else {
      left_out.push_back(place.text);
    }
  }
  for (TextItem& number : numbers) frame.items.emplace_back(std::move(number));
  return left_out;
}

std::string left_out_text(std::span<const std::string> labels, const char* what) {
  constexpr std::size_t kNamed = 6;
  if (labels.empty()) return {};
  const std::size_t named = std::min(labels.size(), kNamed);
  std::string out = fmt::format("{} left out: {}", what, fmt::join(labels.first(named), ", "));
  if (named < labels.size()) out += fmt::format(" and {} more", labels.size() - named);
  return out;
}

std::string numbers_text(std::span<const std::int64_t> numbers, std::size_t schools) {
  const auto count = static_cast<std::int64_t>(numbers.size());
  if (count > 2 && numbers.back() - numbers.front() + 1 == count) {
    return fmt::format("{}\u2013{}", numbers.front(), numbers.back());
  }
  if (count > 3) return count_of(static_cast<std::size_t>(schools), "school");
  return fmt::format("{}", fmt::join(numbers, ", "));
}

}  // namespace sonar
