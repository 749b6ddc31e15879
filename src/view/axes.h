// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "view/frame_description.h"
#include "view/theme.h"

namespace sonar {

/// Places of ticks along an axis, rising.
struct Ticks {
  std::vector<double> major;
  std::vector<double> minor;  ///< between them, without the major ones
  double step = 1.0;          ///< between major ticks
  int decimals = 0;           ///< that the labels need
};

/// Ticks at multiples of 1, 2 or 5 times a power of ten; `most` major ticks or fewer, ends included where they fall on
/// one. Low and high in any order; equal or not finite = no ticks.
[[nodiscard]] Ticks nice_ticks(double low, double high, int most);
/// The same with steps for degrees: 1, 2, 5, 10, 15, 30, 45, 90; below 1 decimal.
[[nodiscard]] Ticks degree_ticks(double low, double high, int most);
/// Ticks at every multiple of a step (whole colour steps), thinned to a multiple of it where there would be over `most`.
[[nodiscard]] Ticks step_ticks(double low, double high, double first, double step, int most);
/// Fixed decimals, a true minus sign, no "-0".
[[nodiscard]] std::string tick_text(double value, int decimals);

/// One axis of a plot: values at its two ends. `first` is at the left or the top.
struct PlotAxis {
  double first = 0.0;
  double last = 1.0;
  std::string label;  ///< with unit
  bool degrees = false;
  bool both_ways = false;  ///< distances to either side of 0, which the label names: ticks have no sign
  double unit = 1.0;       ///< ticks stand at round numbers of it and are read in it: m in a foot, say
  friend bool operator==(const PlotAxis&, const PlotAxis&) = default;
};

/// A plot's place in the picture and its linear axes.
struct PlotFrame {
  PixelRect place;
  PlotAxis x;
  PlotAxis y;  ///< first = top
  [[nodiscard]] PixelPoint at(double x_value, double y_value) const;
  [[nodiscard]] double x_at(double pixel_x) const;
  [[nodiscard]] double y_at(double pixel_y) const;
  friend bool operator==(const PlotFrame&, const PlotFrame&) = default;
};

/// "depth (ft)" over a length, in the unit that the theme reads lengths in.
[[nodiscard]] PlotAxis length_axis(double first_m, double last_m, std::string_view what, const Theme& theme);
/// The same place of the picture, its axes in the units that they are read in.
[[nodiscard]] PlotFrame as_read(PlotFrame plot);

struct AxesStyle {
  bool grid = false;
  bool minor = true;
};

/// Ticks that the lower axis is drawn with, in the unit that it is read in.
[[nodiscard]] Ticks x_ticks(const PlotFrame& axes, const Theme& theme);
/// Frame, ticks outside, tick labels, axis labels.
void add_axes(FrameDescription& frame, const PlotFrame& axes, const Theme& theme, const AxesStyle& style = {});

/// Widens the axis that has room, about its middle, until one unit of x is as long as one of y.
void make_isotropic(PlotFrame& plot);

// --- layout -------------------------------------------------------------------------------------------------------

inline constexpr double kFootLine_em = 1.5;

/// What a picture has beside its plot.
struct LayoutNeeds {
  int title_lines = 2;  ///< the first large
  bool colour_bar = true;
  bool x_axis = true;
  bool y_axis = true;
  int y_label_characters = 5;  ///< of its longest tick label
  int foot_lines = 0;          ///< of a key below the plot and its axis
};

/// Where things go; margins follow the theme's text. Where little height is left to the plot the title has fewer lines.
struct Layout {
  PixelRect title;
  PixelRect plot;
  PixelRect colour_bar;  ///< the bar alone, its labels to its right; empty without
  PixelRect foot;        ///< below the plot and its axis; empty without
};
[[nodiscard]] Layout lay_out(PixelSize size, const Theme& theme, const LayoutNeeds& needs = {});

/// Where a map begins, below its title where it has one.
[[nodiscard]] double map_top_px(const Theme& theme);

/// First line large, the others muted below it; the right-hand text (may be empty) stands at the right of the first.
/// Lines that the title's place has no room for are left out. Nothing leaves the picture: a first line without room becomes smaller, then lines are shortened; SYNTHETIC is never
/// shortened away.
void add_title(FrameDescription& frame, const Layout& layout, const Theme& theme, const std::vector<std::string>& lines,
               const std::string& right = {});

}  // namespace sonar
