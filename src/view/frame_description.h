// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "view/image.h"

namespace sonar {

/// A rectangle of a picture, pixels; x, y is the upper left corner.
struct PixelRect {
  double x = 0.0;
  double y = 0.0;
  double width = 0.0;
  double height = 0.0;
  friend bool operator==(const PixelRect&, const PixelRect&) = default;
};

/// Edges belong to it.
[[nodiscard]] inline bool inside(const PixelRect& rect, PixelPoint p) {
  return p.x >= rect.x && p.y >= rect.y && p.x <= rect.x + rect.width && p.y <= rect.y + rect.height;
}

/// How a line is drawn; no dashes = solid.
struct Stroke {
  Rgba8 colour{0, 0, 0, 255};
  double width_px = 1.0;
  std::vector<double> dashes_px;
  friend bool operator==(const Stroke&, const Stroke&) = default;
};

/// A raster laid over a rectangle; `smooth` = interpolated when enlarged, else each of its pixels stays a block.
struct ImageItem {
  PixelRect place;
  std::shared_ptr<const Image> image;
  bool smooth = false;
};

/// One path of one or more rings or polylines, filled (even-odd) and stroked; alpha 0 = not.
struct PathItem {
  struct Part {
    std::vector<PixelPoint> points;
    bool closed = false;
  };
  std::vector<Part> parts;
  Rgba8 fill{0, 0, 0, 0};
  Stroke stroke{{0, 0, 0, 0}, 0.0, {}};
};

/// Where a text's anchor point lies in it.
enum class TextAnchor : std::uint8_t { left, centre, right };

/// One line of text; `at` is the anchor on the text's vertical middle. A halo keeps it readable over a picture.
struct TextItem {
  PixelPoint at;
  std::string text;  ///< UTF-8
  double size_px = 12.0;
  Rgba8 colour{0, 0, 0, 255};
  TextAnchor anchor = TextAnchor::left;
  double turned_deg = 0.0;  ///< clockwise
  bool bold = false;
  Rgba8 halo{0, 0, 0, 0};
};

/// Items between a ClipItem and the next are cut to its rectangle; an empty rectangle ends clipping.
struct ClipItem {
  PixelRect place;
};

/// A colour bar: what it shows, and how it is read.
struct ColourBar {
  std::vector<Rgba8> colours;  ///< of even parts from `low` to `high`
  double low = 0.0;
  double high = 1.0;
  double step = 0.0;                   ///< between colours that are told apart; 0 = smooth
  std::optional<double> threshold_db;  ///< analysis threshold that is marked in it
  bool rising_down = false;            ///< low at the top, as depth is read
  std::string label;                   ///< quantity and unit: "depth (m)"
  friend bool operator==(const ColourBar&, const ColourBar&) = default;
};

/// Where a picture is from, for whoever finds its file later.
struct PictureOrigin {
  std::string program;      ///< "Sonar Explorer 0.2.0"
  std::string recipe_hash;  ///< of what the echoes were processed with
  std::string data_time;    ///< "FIRST/LAST", ISO 8601, UTC: of the pings that the picture is of
};

/// A 2-D picture as a list of things to draw, in order. What `view` builds, and `render` turns into pixels, SVG or PDF.
struct FrameDescription {
  PixelSize size;
  Rgba8 background{255, 255, 255, 255};
  std::string title;  ///< of the document; what is seen stands in a TextItem
  std::vector<std::variant<ImageItem, PathItem, TextItem, ClipItem>> items;
  PictureOrigin origin{};  ///< what a file says of where it is from; empty = nothing
  /// Colour bars that its colours need and that do not stand in it: the page does that draws one for many pictures.
  std::vector<ColourBar> bars{};
  double dots_per_inch = 96.0;  ///< pixels of the size an inch of paper
};

}  // namespace sonar
