// SPDX-License-Identifier: Apache-2.0
#include "view/maps/survey_map_legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "view/colour_bar.h"
#include "view/maps/map_items.h"
#include "view/shapes.h"

namespace sonar {
namespace {

/// "depth.tif (elevation, negative down)": how the sign was told, and a variable of the same name, say nothing more.
std::string brief_source(std::string source) {
  if (const auto why = source.rfind(" (told by "); why != std::string::npos) source.resize(why);
  const auto colon = source.rfind(": ");
  if (colon == std::string::npos) return source;
  std::string head = source.substr(0, colon);
  const std::string meaning = source.substr(colon + 2);
  if (const auto comma = head.rfind(", "); comma != std::string::npos && meaning.starts_with(head.substr(comma + 2))) {
    head.resize(comma);
  }
  return head + " (" + meaning + ")";
}

/// What the legend says below its colour bars, line by line.
class Legend {
 public:
  Legend(const SurveyMapDrawing& d, const PixelRect& place, double y) : d_(d), place_(place), y_(y) {}

  [[nodiscard]] PixelPoint symbol() const { return {place_.x + 1.1 * d_.em, y_}; }
  [[nodiscard]] bool full() const { return y_ > place_.y + place_.height - 0.6 * d_.em; }
  void text(const std::string& words) {
    d_.frame.items.emplace_back(text_item({place_.x + 2.8 * d_.em, y_}, words, d_.em, d_.theme.text));
    y_ += 1.6 * d_.em;
  }
  /// A note that has no room for all of its lines is left out.
  void small(const std::string& words) {
    const double size = small_text_px(d_.theme, 0.82);
    const std::vector<std::string> lines = wrapped(words, place_.width, size);
    if (y_ + 1.25 * size * (static_cast<double>(lines.size()) - 0.5) > place_.y + place_.height) return;
    for (const std::string& line : lines) {
      d_.frame.items.emplace_back(text_item({place_.x, y_}, line, size, d_.theme.muted));
      y_ += 1.25 * size;
    }
    y_ += 0.5 * d_.em;
  }
  void gap() { y_ += 0.5 * d_.em; }

 private:
  const SurveyMapDrawing& d_;
  PixelRect place_;
  double y_;
};

/// Circles of the map have their school's colour or none; those of the legend tell the size alone.
void add_sizes(const SurveyMapDrawing& d, Legend& legend) {
  for (const double size : d.look.sizes()) {
    if (legend.full()) return;
    d.frame.items.emplace_back(
        circle_item(legend.symbol(), d.look.radius_px(size), {0, 0, 0, 0}, {d.theme.text, 0.8 * d.theme.line_px, {}}));
    legend.text(fmt::format("{:g} m² backscatter", size));
  }
}

void add_symbols(const SurveyMapDrawing& d, Legend& legend, const SurveyMapStyle& style) {
  const double em = d.em;
  const auto at = [&] { return legend.symbol(); };
  d.frame.items.emplace_back(
      ship_item(at(), 1.9 * em, 0.5 * 3.14159, d.theme.ship, d.theme.background, d.theme.line_px));
  legend.text("ship, last position");
  d.frame.items.emplace_back(
      line_item({at().x - em, at().y}, {at().x + em, at().y}, d.theme.track, 1.6 * d.theme.line_px));
  legend.text("ship's track");
  d.frame.items.emplace_back(circle_item(at(), 0.5 * em, kStartColour, {d.theme.text, d.theme.line_px, {}}));
  legend.text("start of an observation");
  if (style.swept) {
    d.frame.items.emplace_back(rectangle_item({at().x - em, at().y - 0.55 * em, 2.0 * em, 1.1 * em}, kSweptColour));
    legend.text("search volume");
  }
  for (const auto& [colour, name] : d.look.entries()) {
    if (legend.full()) return;
    d.frame.items.emplace_back(rectangle_item({at().x - em, at().y - 0.45 * em, 2.0 * em, 0.9 * em}, colour,
                                              d.theme.text, 0.8 * d.theme.line_px));
    legend.text(name);
  }
}

}  // namespace

std::vector<ColourBar> survey_bars(const SurveyMapDrawing& d, const DepthBands& bands, const SurveyMapStyle& style,
                                   bool schools) {
  std::vector<ColourBar> bars;
  if (schools && style.colouring == SchoolColouring::mean_sv) {
    bars.push_back(colour_bar(d.look.map(), style.sv_low_db, style.sv_high_db, "mean Sv (dB)"));
  }
  if (bands.levels_m.size() > 1) {
    const Unit unit = d.theme.units.length();
    bars.push_back(colour_bar(bands.map, unit.of(bands.levels_m.front()), unit.of(bands.levels_m.back()),
                              with_unit("depth", unit), true));
  }
  return bars;
}

void add_survey_legend(const SurveyMapDrawing& d, const PixelRect& place, const DepthBands& bands,
                       const SurveyMapStyle& style, const DepthGrid* depths, bool schools,
                       const std::vector<std::string>& notes) {
  const double em = d.em;
  const double height = std::clamp(0.3 * place.height, 6.0 * em, 15.0 * em);
  double x = place.x + 0.4 * em;
  const double y = place.y + 1.8 * em;
  const std::vector<ColourBar> bars = survey_bars(d, bands, style, schools);
  for (const ColourBar& bar : bars) {
    if (d.theme.bars) add_colour_bar(d.frame, {x, y, 1.3 * em, height}, bar, d.theme);
    x += 8.4 * em;
  }
  Legend legend(d, place, d.theme.bars && !bars.empty() ? y + height + 2.2 * em : place.y + em);
  add_symbols(d, legend, style);
  if (bands.land) {
    d.frame.items.emplace_back(
        rectangle_item({legend.symbol().x - em, legend.symbol().y - 0.55 * em, 2.0 * em, 1.1 * em}, d.theme.land,
                       d.theme.text, 0.5 * d.theme.line_px));
    legend.text("land");
  }
  add_sizes(d, legend);
  legend.gap();
  // An empty circle alone would be a school without echo.
  if (schools) {
    legend.small("Circles have their school's colour, empty where its outline is seen; numbers as in the tables.");
  }
  legend.small(d.map.projection.name());
  if (depths != nullptr) {
    legend.small("Depths: " + brief_source(depths->source));
    if (bands.levels_m.empty()) legend.small("The raster has no depths here.");
    if (bands.unknown && !bands.levels_m.empty()) legend.small("Plain where the raster has no depths.");
  } else {
    legend.small("No depth raster: plain sea.");
  }
  for (const std::string& note : notes) {
    if (!note.empty()) legend.small(note);
  }
}

}  // namespace sonar
