// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "session/live/live_picture.h"
#include "view/figures/figure_page.h"

namespace sonar {

/// Pictures that have been drawn for a page, so that a changed caption draws none of them again.
/// threads  one at a time
class DrawnPanels {
 public:
  struct Panel {
    PictureLook look;
    std::int64_t version = 0;
    FrameDescription frame;
    double scale = 1.0;
  };
  /// Null where it would look otherwise now.
  [[nodiscard]] const Panel* find(const std::string& id, const PictureLook& look, std::int64_t version) const;
  void keep(const std::string& id, Panel panel) { panels_[id] = std::move(panel); }

 private:
  std::map<std::string, Panel> panels_;
};

/// Everything that a page is drawn from, as it was when it was asked for.
struct FigureJob {
  struct Panel {
    std::string id;
    std::string title;
    PictureLook look;
    std::int64_t version = 0;
    bool refines = false;
    LivePicture::Panel draw;  ///< empty = there is nothing to show
    std::string why_empty;
  };
  FigureParams params;
  FigureLayout layout;
  bool legend = true;  ///< the layout has room for it
  std::string source;
  PictureOrigin origin;
  std::vector<Panel> panels;
  Rgba8 behind;  ///< the page in its preview
  std::shared_ptr<DrawnPanels> drawn;
  std::int64_t wish = 0;  ///< its number
};

struct DrawnFigure {
  FrameDescription page;
  bool bars = false;  ///< it needs colour bars
  bool done = false;  ///< it gets no better
  std::int64_t wish = 0;
};

/// Draws the panels one after another, those that get better and better last, and shows the page with a preview of it
/// as soon as there is something in every panel. A panel that cannot be drawn says why.
/// view    pixels of the preview
/// errors  cancelled
[[nodiscard]] Result<void> draw_figure(
    const FigureJob& job, PixelSize view, const CancelToken& token,
    const std::function<void(FrameDescription preview, std::shared_ptr<const DrawnFigure> figure)>& show);

}  // namespace sonar
