// SPDX-License-Identifier: Apache-2.0
#include "view/label_room.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "view/theme.h"

namespace sonar {
namespace {

constexpr double kBoldWidth = 1.12;  // of plain letters'
constexpr double kTextHeight = 1.2;  // of its size, from the lowest descender to the highest capital

bool overlap(const PixelRect& a, const PixelRect& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

/// Whether a line meets a rectangle (Liang and Barsky 1984: the part of it within each pair of sides).
bool meets(PixelPoint a, PixelPoint b, const PixelRect& r) {
  double first = 0.0;
  double last = 1.0;
  const std::array<std::array<double, 2>, 2> axes{{{a.x, b.x - a.x}, {a.y, b.y - a.y}}};  // start, length
  const std::array<std::array<double, 2>, 2> sides{{{r.x, r.x + r.width}, {r.y, r.y + r.height}}};
  for (std::size_t i = 0; i < 2; ++i) {
    const double start = axes[i][0];
    const double along = axes[i][1];
    if (along == 0.0) {
      if (start < sides[i][0] || start > sides[i][1]) return false;
      continue;
    }
    const double enter = (sides[i][0] - start) / along;
    const double leave = (sides[i][1] - start) / along;
    first = std::max(first, std::min(enter, leave));
    last = std::min(last, std::max(enter, leave));
  }
  return first <= last;
}

}  // namespace

PixelRect LabelRoom::box_of(const TextItem& label) {
  const double width = text_width_px(label.text.c_str(), label.size_px) * (label.bold ? kBoldWidth : 1.0);
  const double height = kTextHeight * label.size_px;
  double left = label.at.x;
  if (label.anchor == TextAnchor::centre) left -= width / 2;
  if (label.anchor == TextAnchor::right) left -= width;
  return {left, label.at.y - height / 2, width, height};
}

bool LabelRoom::free(const PixelRect& box) const {
  if (box.x < inside_.x || box.y < inside_.y || box.x + box.width > inside_.x + inside_.width ||
      box.y + box.height > inside_.y + inside_.height) {
    return false;
  }
  return std::none_of(taken_.begin(), taken_.end(), [&](const PixelRect& t) { return overlap(t, box); });
}

bool LabelRoom::crossed(const PixelRect& box) const {
  return std::any_of(lines_.begin(), lines_.end(), [&](const Line& l) { return meets(l.a, l.b, box); });
}

std::optional<TextItem> LabelRoom::place_nearest(const TextItem& label) {
  // Slid towards its anchor, a free box ends there, at a side of what is taken, or at one of the picture.
  const PixelRect box = box_of(label);
  constexpr double kApart_px = 1e-6;  // what touches shares no rounded edge
  std::vector<double> left{box.x, inside_.x, inside_.x + inside_.width - box.width - kApart_px};
  std::vector<double> top{box.y, inside_.y, inside_.y + inside_.height - box.height - kApart_px};
  for (const PixelRect& t : taken_) {
    left.insert(left.end(), {t.x - box.width - kApart_px, t.x + t.width + kApart_px});
    top.insert(top.end(), {t.y - box.height - kApart_px, t.y + t.height + kApart_px});
  }
  std::optional<TextItem> nearest;
  double least_px = std::numeric_limits<double>::infinity();
  for (const double x : left) {
    if (std::abs(x - box.x) >= least_px) continue;
    for (const double y : top) {
      const double away_px = std::hypot(x - box.x, y - box.y);
      if (away_px >= least_px || !free({x, y, box.width, box.height})) continue;
      least_px = away_px;
      nearest = label;
      nearest->at = {label.at.x + (x - box.x), label.at.y + (y - box.y)};
    }
  }
  if (nearest) taken_.push_back(box_of(*nearest));
  return nearest;
}

TextItem LabelRoom::force(TextItem label) {
  const PixelRect box = box_of(label);
  const auto moved = [](double from, double length, double first, double room) {
    return std::clamp(from, first, std::max(first, first + room - length)) - from;
  };
  label.at.x += moved(box.x, box.width, inside_.x, inside_.width);
  label.at.y += moved(box.y, box.height, inside_.y, inside_.height);
  taken_.push_back(box_of(label));
  return label;
}

std::optional<TextItem> LabelRoom::place(TextItem label, std::span<const PixelPoint> places, bool on_lines) {
  std::optional<PixelPoint> second_best;
  for (const PixelPoint& at : places) {
    label.at = at;
    const PixelRect box = box_of(label);
    if (!free(box)) continue;
    if (!crossed(box)) {
      taken_.push_back(box);
      return label;
    }
    if (!second_best) second_best = at;
  }
  if (!second_best || !on_lines) return std::nullopt;
  label.at = *second_best;
  taken_.push_back(box_of(label));
  return label;
}

}  // namespace sonar
