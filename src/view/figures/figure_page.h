// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "view/figures/figure_params.h"
#include "view/frame_description.h"
#include "view/theme.h"

namespace sonar {

/// "top_slice,timeline+" taken apart; blanks and empty entries are passed over.
[[nodiscard]] std::vector<FigurePanelName> panel_names(const std::string& panels);
/// Back together.
[[nodiscard]] std::string panels_text(std::span<const FigurePanelName> names);

/// Pixels of a page: millimetres times dots an inch, rounded.
[[nodiscard]] PixelSize page_pixels(const FigureParams& params);

/// Where everything stands on a page, in its pixels. Places that are not needed are empty.
struct FigureLayout {
  PixelSize page;
  PixelRect title;
  std::vector<PixelRect> headings;  ///< [panel] the line above it
  std::vector<PixelRect> panels;
  PixelRect legend;
  bool legend_below = false;
  PixelRect source;
  PixelRect caption;
};

/// Panels fill rows of `columns` in their order; a wide one has a row of its own. Rows of the same kind are equally high.
/// legend  room for colour bars
/// source  what the line below the panels says
/// errors  bad_parameter: no panels, too many pixels, no room for a panel and its text
[[nodiscard]] Result<FigureLayout> figure_layout(const FigureParams& params, std::span<const FigurePanelName> panels,
                                                 bool legend, const std::string& source);

/// How pictures are drawn for a page: with so many pixels an inch, which are fine enough for an eye, and enough for the
/// pictures' own limits; text and lines as large as paper asks for.
struct PanelDrawing {
  double dots_per_inch = 300.0;  ///< of the pictures; not the page's where that is very coarse or very fine
  double on_page = 1.0;          ///< pixels of the page a pixel of the picture
  PanelLook look;                ///< in pixels of the picture
  [[nodiscard]] PixelSize size_in(const PixelRect& place) const;
};
[[nodiscard]] PanelDrawing panel_drawing(const FigureParams& params);

/// A picture that goes on the page.
struct FigurePanel {
  std::string name;                       ///< "Slice from above"
  std::optional<FrameDescription> frame;  ///< empty = there is none
  double scale = 1.0;                     ///< pixels of panel_drawing() a pixel of the frame
  std::string problem;                    ///< why there is none
};

/// A colour bar and the panels that it belongs to.
struct SharedBar {
  ColourBar bar;
  std::vector<std::size_t> panels;
};
/// One bar for all panels of one scale: the same colours, ends, threshold and unit. Where they show different quantities
/// in it, its label says which panel shows which.
[[nodiscard]] std::vector<SharedBar> shared_bars(std::span<const FigurePanel> panels, bool letters);

/// "a", "b", ... "z", "aa": of the panel with this index.
[[nodiscard]] std::string panel_letter(std::size_t index);

/// The page. Its time is that of all its panels together.
[[nodiscard]] FrameDescription figure_page(const FigureParams& params, const FigureLayout& layout,
                                           std::span<const FigurePanel> panels, const std::string& source);

}  // namespace sonar
