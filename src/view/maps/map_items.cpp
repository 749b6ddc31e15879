// SPDX-License-Identifier: Apache-2.0
#include "view/maps/map_items.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "base/number_text.h"

namespace sonar {
namespace {

constexpr double kNear_px = 0.5;

void append(std::vector<PixelPoint>& points, const PixelPoint& p) {
  if (!points.empty() && std::hypot(p.x - points.back().x, p.y - points.back().y) < kNear_px) return;
  points.push_back(p);
}

}  // namespace

PathItem area_item(const MapFrame& map, const GeoArea& area, Rgba8 fill, Stroke stroke) {
  PathItem item;
  item.fill = fill;
  item.stroke = std::move(stroke);
  for (const auto& ring : area.rings) {
    PathItem::Part part;
    part.closed = true;
    for (const Geographic& place : ring) {
      if (const auto p = map.at(place)) append(part.points, *p);
    }
    if (part.points.size() > 2) item.parts.push_back(std::move(part));
  }
  return item;
}

PathItem track_item(const MapFrame& map, std::span<const PingNavigation> pings, Stroke stroke) {
  PathItem item;
  item.stroke = std::move(stroke);
  PathItem::Part part;
  std::optional<PixelPoint> last;
  const auto finish = [&] {
    if (last && !part.points.empty() && part.points.back() != *last) part.points.push_back(*last);
    if (part.points.size() > 1) item.parts.push_back(std::move(part));
    part = {};
    last.reset();
  };
  for (const PingNavigation& ping : pings) {
    const auto p = ping.has_position() ? map.at(ping.transducer) : std::nullopt;
    if (!p) {
      finish();
      continue;
    }
    append(part.points, *p);
    last = p;
  }
  finish();
  return item;
}

PathItem circle_item(PixelPoint centre, double radius_px, Rgba8 fill, Stroke stroke) {
  constexpr int kCorners = 32;
  PathItem item;
  item.fill = fill;
  item.stroke = std::move(stroke);
  PathItem::Part part;
  part.closed = true;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    part.points.push_back({centre.x + radius_px * std::cos(angle), centre.y + radius_px * std::sin(angle)});
  }
  item.parts.push_back(std::move(part));
  return item;
}

std::vector<std::string> wrapped(const std::string& text, double width_px, double size_px) {
  std::vector<std::string> lines;
  std::string line;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at);
    const std::string longer = line.empty() ? word : fmt::format("{} {}", line, word);
    if (!line.empty() && text_width_px(longer.c_str(), size_px) > width_px) {
      lines.push_back(line);
      line = word;
    } else {
      line = longer;
    }
    at = end + 1;
  }
  if (!line.empty()) lines.push_back(line);
  return lines;
}

std::string clock_text(TimeNs time, bool seconds) {
  std::string text = iso_time(time).substr(0, seconds ? 19 : 16);
  text[10] = ' ';
  return text;
}

std::string time_span_text(TimeNs first, TimeNs last) {
  if (first == 0 || last == 0) return {};
  const bool brief = last - first < 120 * kSecondNs;
  const std::string from = clock_text(first, brief);
  const std::string to = clock_text(last, brief);
  if (from == to) return from + " UTC";
  const bool same_day = from.substr(0, 10) == to.substr(0, 10);
  return from + " \u2013 " + (same_day ? to.substr(11) : to) + " UTC";
}

std::string schools_text(std::size_t shown, std::size_t left_out) {
  const std::size_t all = shown + left_out;
  std::string words = count_of(all, "school");
  if (left_out == 0) return words;
  return shown == 0 ? words + ", not shown" : fmt::format("{} of {}", shown, words);
}

std::string survey_title(std::span<const ObservationProduct> products) {
  std::string title;
  bool synthetic = false;
  bool several = false;
  for (const ObservationProduct& product : products) {
    std::string own = product.title;
    if (own.ends_with(" " + product.observation)) own.resize(own.size() - product.observation.size() - 1);
    // A survey without a name: "Fish schools of ".
    while (own.ends_with(' ')) own.pop_back();
    if (own.ends_with(" of")) own.resize(own.size() - 3);
    synthetic = synthetic || own.find("SYNTHETIC") != std::string::npos;
    if (title.empty()) title = own;
    several = several || (!own.empty() && own != title);
  }
  if (title.empty()) title = "Survey";
  if (several) title += " and others";
  if (synthetic && title.find("SYNTHETIC") == std::string::npos) title = "SYNTHETIC: " + title;
  return title;
}

std::string observation_title(const ObservationProduct& product) {
  constexpr std::string_view kSchools = "Fish schools of ";
  std::string survey = survey_title(std::span(&product, 1));
  if (product.title.empty() || survey == "Fish schools") return product.observation;
  if (survey.starts_with(kSchools)) survey.erase(0, kSchools.size());
  return product.observation + " of " + survey;
}

}  // namespace sonar
