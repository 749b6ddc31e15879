// SPDX-License-Identifier: Apache-2.0
#include "view/composed_figure.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "view/shapes.h"

namespace sonar {
namespace {

/// A picture's pixels as those of the page.
class Placing {
 public:
  Placing(FrameDescription& page, PixelSize size, const PixelRect& place)
      : page_(page), place_(place), scale_(place.width / size.width) {}

  void add(const ImageItem& item) { keep(ImageItem{moved(item.place), item.image, item.smooth}); }
  void add(PathItem item) {
    for (PathItem::Part& part : item.parts) {
      for (PixelPoint& p : part.points) p = moved(p);
    }
    item.stroke.width_px *= scale_;
    for (double& dash : item.stroke.dashes_px) dash *= scale_;
    keep(std::move(item));
  }
  void add(TextItem item) {
    item.at = moved(item.at);
    item.size_px *= scale_;
    keep(std::move(item));
  }
  void add(const ClipItem& clip) {
    const bool ends = !(clip.place.width > 0.0) || !(clip.place.height > 0.0);
    const PixelRect shown = ends ? place_ : common(moved(clip.place), place_);
    // An empty rectangle would end all clipping: what nobody sees is left out instead.
    hidden_ = !(shown.width > 0.0) || !(shown.height > 0.0);
    if (!hidden_) page_.items.emplace_back(ClipItem{shown});
  }

 private:
  template <class Item>
  void keep(Item item) {
    if (!hidden_) page_.items.emplace_back(std::move(item));
  }
  [[nodiscard]] PixelPoint moved(PixelPoint p) const { return {place_.x + scale_ * p.x, place_.y + scale_ * p.y}; }
  [[nodiscard]] PixelRect moved(const PixelRect& r) const {
    return {place_.x + scale_ * r.x, place_.y + scale_ * r.y, scale_ * r.width, scale_ * r.height};
  }
  static PixelRect common(const PixelRect& a, const PixelRect& b) {
    const double x = std::max(a.x, b.x);
    const double y = std::max(a.y, b.y);
    return {x, y, std::min(a.x + a.width, b.x + b.width) - x, std::min(a.y + a.height, b.y + b.height) - y};
  }

  FrameDescription& page_;
  PixelRect place_;
  double scale_;
  bool hidden_ = false;
};

}  // namespace

PixelRect fitted(PixelSize picture, const PixelRect& place) {
  if (picture.width <= 0 || picture.height <= 0 || !(place.width > 0.0) || !(place.height > 0.0)) return {};
  const double scale = std::min(place.width / picture.width, place.height / picture.height);
  const double width = scale * picture.width;
  const double height = scale * picture.height;
  return {place.x + (place.width - width) / 2.0, place.y + (place.height - height) / 2.0, width, height};
}

void place_frame(FrameDescription& page, const FrameDescription& picture, const PixelRect& place) {
  const PixelRect lies = fitted(picture.size, place);
  if (!(lies.width > 0.0)) return;
  page.items.emplace_back(ClipItem{lies});
  if (picture.background != page.background) page.items.emplace_back(rectangle_item(lies, picture.background));
  Placing placing(page, picture.size, lies);
  for (const auto& item : picture.items) {
    std::visit([&](const auto& one) { placing.add(one); }, item);
  }
  page.items.emplace_back(ClipItem{});
}

}  // namespace sonar
