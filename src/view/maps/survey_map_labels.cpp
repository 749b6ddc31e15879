// SPDX-License-Identifier: Apache-2.0
#include "view/maps/survey_map_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "geo/geodesic.h"
#include "view/label_room.h"
#include "view/school_labels.h"
#include "view/shapes.h"

namespace sonar {
namespace {

LabelRoom room_beside_symbols(const SurveyMapDrawing& d, std::span<const ObservationProduct> observations,
                              const std::optional<PixelPoint>& ship) {
  LabelRoom room(d.map.place);
  if (d.scale) room.take(d.scale->place);
  if (ship) room.take({ship->x - d.em, ship->y - d.em, 2.0 * d.em, 2.0 * d.em});
  for (const ObservationProduct& product : observations) {
    if (const auto at = start_on_map(d, product)) room.take({at->x - 0.5 * d.em, at->y - 0.5 * d.em, d.em, d.em});
  }
  return room;
}

struct Circle {
  PixelPoint at;
  double radius_px = 0.0;
};

std::vector<Circle> circles(const SurveyMapDrawing& d, std::span<const ObservationProduct> observations) {
  std::vector<Circle> out;
  for (const ObservationProduct& product : observations) {
    for (const SchoolRow& school : product.schools) {
      if (!d.look.shown(school) || !std::isfinite(school.latitude) || !std::isfinite(school.longitude)) continue;
      const auto centre = d.map.at(Geographic{school.latitude, school.longitude});
      if (centre) out.push_back({*centre, d.look.radius_px(d.look.backscatter_m2(school))});
    }
  }
  return out;
}

/// How far from a start its name begins on that side (1 = right): past the marker, and past circles that reach there.
double past_circles(const SurveyMapDrawing& d, std::span<const Circle> circles, const PixelPoint& start, double side) {
  double out = 0.9 * d.em;
  for (const Circle& circle : circles) {
    const double off = side * (circle.at.x - start.x);
    const bool meets =
        std::abs(circle.at.y - start.y) < circle.radius_px + 0.5 * d.em && std::abs(off) < circle.radius_px + d.em;
    if (meets) out = std::max(out, off + circle.radius_px + 0.3 * d.em);
  }
  return out;
}

/// The side of a start away from where the ship went: -1 = left, 1 = right.
double free_side(const SurveyMapDrawing& d, const ObservationProduct& product, const PixelPoint& start) {
  const auto first =
      std::find_if(product.pings.begin(), product.pings.end(), [](const auto& n) { return n.has_position(); });
  const auto after = std::find_if(first, product.pings.end(), [&](const auto& n) {
    return n.has_position() && geodesic(first->transducer, n.transducer).distance_m > 20.0;
  });
  const auto next = after != product.pings.end() ? d.map.at(after->transducer) : std::nullopt;
  return next && next->x > start.x ? -1.0 : 1.0;
}

/// In the survey, as tables and map have it; in the observation where nobody merged.
std::int64_t number_of(const SchoolRow& school) {
  return school.survey_school > 0 ? school.survey_school : school.school_id;
}

/// "3 Big one, 4" for schools that share a marker; empty where none has a name or there are too many.
std::string names_text(std::vector<const SchoolRow*> schools, const Theme& theme) {
  constexpr std::size_t kMostNamed = 3;
  const bool any = std::any_of(schools.begin(), schools.end(), [](const SchoolRow* s) { return !s->name.empty(); });
  if (!any || schools.size() > kMostNamed) return {};
  std::sort(schools.begin(), schools.end(), [](auto* a, auto* b) { return number_of(*a) < number_of(*b); });
  std::string out;
  for (const SchoolRow* school : schools) {
    const std::string one = school->name.empty() ? fmt::format("{}", number_of(*school))
                                                 : named_text(number_of(*school), school->name, theme);
    out += (out.empty() ? "" : ", ") + one;
  }
  return out;
}

/// Rejected ones are told where they are shown.
std::size_t count_of(const SchoolLook& look, const std::vector<const SchoolRow*>& rows) {
  std::set<const void*> schools;
  for (const SchoolRow* row : rows) {
    const CountedSchool* school = look.school_of(*row);
    schools.insert(school == nullptr ? static_cast<const void*>(row) : school);
  }
  return schools.size();
}

/// Schools of one observation whose markers lie on each other share one number, from the first of them on.
std::vector<NumberedPlace> numbered_schools(const SurveyMapDrawing& d,
                                            std::span<const ObservationProduct> observations) {
  struct Marker {
    PixelPoint at;
    double radius_px = 0.0;
    double backscatter_m2 = 0.0;
    std::vector<std::int64_t> numbers;
    std::vector<const SchoolRow*> schools;
  };
  std::vector<Marker> markers;
  for (const ObservationProduct& product : observations) {
    const std::size_t first = markers.size();
    for (const SchoolRow& school : product.schools) {
      if (!d.look.shown(school) || !std::isfinite(school.latitude) || !std::isfinite(school.longitude)) continue;
      const auto centre = d.map.at(Geographic{school.latitude, school.longitude});
      if (!centre) continue;
      const double echo_m2 = d.look.backscatter_m2(school);
      const auto shared = std::find_if(
          markers.begin() + static_cast<std::ptrdiff_t>(first), markers.end(),
          [&](const Marker& m) { return std::hypot(m.at.x - centre->x, m.at.y - centre->y) < 0.8 * d.em; });
      Marker& marker = shared != markers.end() ? *shared : markers.emplace_back(Marker{*centre, 0.0, 0.0, {}, {}});
      marker.radius_px = std::max(marker.radius_px, d.look.radius_px(echo_m2));
      marker.backscatter_m2 += std::isfinite(echo_m2) ? echo_m2 : 0.0;
      marker.numbers.push_back(number_of(school));
      marker.schools.push_back(&school);
    }
  }
  // The strongest find room first.
  std::stable_sort(markers.begin(), markers.end(),
                   [](const Marker& a, const Marker& b) { return a.backscatter_m2 > b.backscatter_m2; });
  std::vector<NumberedPlace> out;
  for (Marker& marker : markers) {
    std::sort(marker.numbers.begin(), marker.numbers.end());
    const PixelRect& r = d.map.place;
    if (marker.at.x < r.x || marker.at.y < r.y || marker.at.x > r.x + r.width || marker.at.y > r.y + r.height) continue;
    out.push_back({marker.at, numbers_text(marker.numbers, count_of(d.look, marker.schools)), marker.radius_px, false,
                   names_text(marker.schools, d.theme)});
  }
  return out;
}

}  // namespace

std::optional<PixelPoint> start_on_map(const SurveyMapDrawing& d, const ObservationProduct& product) {
  const auto first =
      std::find_if(product.pings.begin(), product.pings.end(), [](const auto& n) { return n.has_position(); });
  return first == product.pings.end() ? std::nullopt : d.map.at(first->transducer);
}

StartNames start_names(const SurveyMapDrawing& d, std::span<const ObservationProduct> observations,
                       const std::optional<PixelPoint>& ship) {
  StartNames out;
  LabelRoom room = room_beside_symbols(d, observations, ship);
  const std::vector<Circle> schools = circles(d, observations);
  for (const Circle& c : schools) {
    room.take({c.at.x - c.radius_px, c.at.y - c.radius_px, 2.0 * c.radius_px, 2.0 * c.radius_px});
  }
  FrameDescription leaders;
  for (const ObservationProduct& product : observations) {
    const auto at = start_on_map(d, product);
    if (!at) continue;
    TextItem name = text_item(*at, product.observation, small_text_px(d.theme, 0.9), d.theme.text);
    name.halo = d.theme.halo;
    // A start at the map's edge still has its name in the map.
    const double low = d.map.place.y + 0.8 * d.em;
    const double level = std::clamp(at->y, low, std::max(low, d.map.place.y + d.map.place.height - 0.8 * d.em));
    const double line = 1.2 * d.em;
    const double side = free_side(d, product, *at);
    std::optional<TextItem> placed;
    const auto try_at = [&](double x, double y, TextAnchor anchor) {
      if (placed) return;
      name.anchor = anchor;
      placed = room.place(name, std::array{PixelPoint{x, y}});
    };
    const auto try_sides = [&](double y, double right, double left) {
      for (const double s : {side, -side}) {
        if (s > 0.0) try_at(at->x + right, y, TextAnchor::left);
        if (s < 0.0) try_at(at->x - left, y, TextAnchor::right);
      }
    };
    try_sides(level, past_circles(d, schools, *at, 1.0), past_circles(d, schools, *at, -1.0));
    for (const double y : {at->y - line, at->y + line}) {
      try_at(at->x, y, TextAnchor::centre);
      try_sides(y, 0.4 * d.em, 0.4 * d.em);
    }
    if (!placed) {
      name.anchor = TextAnchor::centre;
      placed = placed_about(leaders, room, name, {*at, name.text, 0.5 * d.em}, d.theme, 1);
    }
    if (placed) {
      out.names.push_back(std::move(*placed));
    } else {
      out.left_out.push_back(product.observation);
    }
  }
  out.leaders = std::move(leaders.items);
  return out;
}

std::vector<std::string> add_numbers(const SurveyMapDrawing& d, std::span<const ObservationProduct> observations,
                                     std::span<const TextItem> names, const std::optional<PixelPoint>& ship) {
  LabelRoom room = room_beside_symbols(d, observations, ship);
  for (const TextItem& name : names) room.take(LabelRoom::box_of(name));
  const auto places = numbered_schools(d, observations);
  for (const NumberedPlace& place : places) {
    const double half = 0.7 * place.radius_px;
    room.take({place.at.x - half, place.at.y - half, 2.0 * half, 2.0 * half});
  }
  return add_school_numbers(d.frame, room, places, d.theme);
}

}  // namespace sonar
