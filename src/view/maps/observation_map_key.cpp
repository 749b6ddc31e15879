// SPDX-License-Identifier: Apache-2.0
#include "view/maps/observation_map_key.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <string_view>

#include "view/maps/map_items.h"
#include "view/school_look.h"
#include "view/shapes.h"
#include "view/volume/mask_colours.h"

namespace sonar {
namespace {

PixelPoint middle(const PixelRect& at) { return {at.x + 0.5 * at.width, at.y + 0.5 * at.height}; }

KeyEntry line(std::string text, Rgba8 colour, const std::vector<double>& dashes, double width_px) {
  return {std::move(text), [=](FrameDescription& frame, const PixelRect& at) {
            const double y = middle(at).y;
            PathItem item = line_item({at.x, y}, {at.x + at.width, y}, colour, width_px);
            item.stroke.dashes_px = dashes;
            frame.items.emplace_back(std::move(item));
          }};
}

KeyEntry area(std::string text, Rgba8 fill, Rgba8 stroke = {0, 0, 0, 0}, double width_px = 0.0) {
  return {std::move(text), [=](FrameDescription& frame, const PixelRect& at) {
            frame.items.emplace_back(rectangle_item(at, fill, stroke, width_px));
          }};
}

}  // namespace

std::vector<KeyEntry> observation_map_key(const ObservationProduct& product, const Theme& theme) {
  const double width_px = 1.6 * theme.line_px;
  std::vector<KeyEntry> out;
  out.push_back({"ship", [=](FrameDescription& frame, const PixelRect& at) {
                   frame.items.emplace_back(ship_item(middle(at), at.width, 0.5 * std::numbers::pi, theme.ship,
                                                      theme.background, theme.line_px));
                 }});
  out.push_back(line("its path", theme.track, {}, width_px));
  out.push_back({"start", [=](FrameDescription& frame, const PixelRect& at) {
                   frame.items.emplace_back(
                       circle_item(middle(at), 0.45 * theme.text_px, kStartColour, {theme.text, theme.line_px, {}}));
                 }});
  out.push_back(area("hull of all pings", theme.water, theme.outline, theme.line_px));
  out.push_back(area("current ping", with_alpha(theme.accent, 28), theme.accent, width_px));
  if (product.schools.empty()) return out;
  // Any colour may be a school's: the key shows how opaque its parts are.
  MaskPalette grey;
  grey.rejected = {true};
  out.push_back(area("core", mask_colour(grey, 0, 255)));
  out.push_back(area("fuzzy area", mask_colour(grey, 0, 1)));
  for (const char* status : {"accepted", "corrected", "unreviewed", "rejected"}) {
    const bool there = std::any_of(product.schools.begin(), product.schools.end(),
                                   [&](const SchoolRow& row) { return row.status == status; });
    const Rgba8 colour = std::string_view(status) == "rejected" ? theme.muted : theme.text;
    if (there)
      out.push_back(line(fmt::format("path of a school, {}", status), colour, status_dashes(status, theme), width_px));
  }
  return out;
}

}  // namespace sonar
