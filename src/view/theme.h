// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>

#include "view/frame_description.h"
#include "view/image.h"
#include "view/units.h"

namespace sonar {

/// Colours and sizes that all 2-D pictures share.
struct Theme {
  Rgba8 background;  ///< of the picture
  Rgba8 plot;        ///< inside the axes, where there is no data
  Rgba8 water;       ///< inside the sector, where a sample is too weak to be shown
  Rgba8 no_data;     ///< inside the sector, where a sample was not recorded or is hidden
  Rgba8 text;
  Rgba8 muted;    ///< secondary text
  Rgba8 axis;     ///< frame and ticks
  Rgba8 grid;     ///< translucent
  Rgba8 ring;     ///< range rings, bearings
  Rgba8 outline;  ///< the sector's outline
  Rgba8 ship;     ///< fill of the ship's symbol
  Rgba8 hatch;    ///< over flagged samples
  Rgba8 halo;     ///< behind text over data
  Rgba8 land;     ///< of maps
  Rgba8 track;    ///< the ship's path
  Rgba8 accent;   ///< what is current
  double text_px = 12.0;
  double title_px = 14.0;
  double line_px = 1.0;
  bool titles = true;          ///< false: pictures leave out the lines above their plot
  bool bars = true;            ///< false: colour bars are left to the page, in FrameDescription::bars
  float least_text_px = 0.0F;  ///< no text is smaller
  Units units{};               ///< that lengths and speeds are read in
  friend bool operator==(const Theme&, const Theme&) = default;
};

/// Text and lines sized for a picture: readable at 640 x 480, not tiny at 3840 x 2160.
[[nodiscard]] Theme light_theme(PixelSize size);
/// Text as large as this at least.
[[nodiscard]] Theme with_text(Theme theme, double least_px);
/// Of secondary words: a share of the text's size, but no less than the theme allows.
[[nodiscard]] inline double small_text_px(const Theme& theme, double share) {
  return std::max(share * theme.text_px, static_cast<double>(theme.least_text_px));
}
[[nodiscard]] Theme dark_theme(PixelSize size);

/// A picture as a panel of a page: text is as large in every panel, however large it is, and colour bars are the page's.
struct PanelLook {
  double text_px = 12.0;
  double line_px = 1.0;
  bool titles = false;
  friend bool operator==(const PanelLook&, const PanelLook&) = default;
};
[[nodiscard]] Theme panel_theme(const PanelLook& look, bool dark);

/// Colours of schools, one after another, told apart on both themes and by colour-blind eyes (from Okabe and Ito 2008).
inline constexpr int kSchoolColours = 24;
/// The colour of a school's number in every kind of picture: schools share one only where their numbers differ by
/// a whole number of kSchoolColours.
[[nodiscard]] Rgba8 school_colour(int number);

/// Text as wide as this at most, for layout without a font: DejaVu Sans, characters counted, not bytes.
[[nodiscard]] double text_width_px(const char* utf8, double size_px);

/// The text, or as much of its beginning as is no wider, with an ellipsis behind it; empty where not even that has room.
[[nodiscard]] std::string elided(std::string text, double size_px, double width_px);

/// The same of lines that tell one thing after another: by whole parts between commas or semicolons, else by whole words, so
/// that no figure or unit is cut; empty where not even the first word has room.
[[nodiscard]] std::string elided_line(const std::string& text, double size_px, double width_px);

[[nodiscard]] inline Rgba8 with_alpha(Rgba8 c, int alpha) {
  c.a = static_cast<std::uint8_t>(alpha);
  return c;
}

}  // namespace sonar
