// SPDX-License-Identifier: Apache-2.0
#include "io/layer_styles.h"

#include <fmt/format.h>

#include <array>

namespace sonar {
namespace {

struct Colour {
  int r = 0;
  int g = 0;
  int b = 0;
  int a = 255;
};
constexpr Colour kTrack{31, 62, 110};
constexpr Colour kSwept{90, 140, 200, 46};
constexpr Colour kSweptEdge{90, 140, 200, 128};
constexpr Colour kObservation{60, 60, 60, 0};
constexpr Colour kObservationEdge{60, 60, 60, 160};
constexpr Colour kOutline{20, 20, 20, 140};

/// Classes of mean Sv, 5 dB each, from the lowest limit on; dark is weak (viridis, which the colour-blind read too).
constexpr double kFirstClass_db = -70.0;
constexpr double kClass_db = 5.0;
constexpr double kOpenEnd_db = 100.0;  ///< beyond any Sv: the outermost classes are open
constexpr std::array<Colour, 8> kClasses{{{68, 1, 84},
                                          {70, 50, 126},
                                          {54, 92, 141},
                                          {39, 127, 142},
                                          {31, 161, 135},
                                          {74, 193, 109},
                                          {160, 218, 57},
                                          {253, 231, 37}}};
/// QGIS draws nothing where no class fits, as where mean Sv is unknown (no valid member, or no more than noise): so that such a
/// school is seen, unknown becomes a number that no Sv is, with a class of its own.
constexpr double kUnknown_db = -150.0;
constexpr Colour kUnknownColour{150, 150, 150};

std::string text_of(const Colour& c) { return fmt::format("{},{},{},{}", c.r, c.g, c.b, c.a); }

/// An option as every QGIS 3 reads it.
std::string option(std::string_view name, std::string_view value) {
  return fmt::format("<prop k=\"{}\" v=\"{}\"/>", name, value);
}

std::string symbol(std::string_view type, std::string_view name, std::string_view layer_class,
                   std::string_view options) {
  return fmt::format(
      "<symbol type=\"{}\" name=\"{}\" alpha=\"1\" clip_to_extent=\"1\" force_rhr=\"0\"><layer class=\"{}\" "
      "enabled=\"1\" locked=\"0\" pass=\"0\">{}</layer></symbol>",
      type, name, layer_class, options);
}

std::string line(std::string_view name, const Colour& colour, double width_mm) {
  return symbol("line", name, "SimpleLine",
                option("line_color", text_of(colour)) + option("line_style", "solid") +
                    option("line_width", fmt::format("{}", width_mm)) + option("line_width_unit", "MM"));
}

std::string area(std::string_view name, const Colour& fill, const Colour& edge, double width_mm) {
  return symbol("fill", name, "SimpleFill",
                option("color", text_of(fill)) + option("style", fill.a == 0 ? "no" : "solid") +
                    option("outline_color", text_of(edge)) + option("outline_style", "solid") +
                    option("outline_width", fmt::format("{}", width_mm)) + option("outline_width_unit", "MM"));
}

std::string point(std::string_view name, std::string_view shape, const Colour& fill, double size_mm) {
  return symbol("marker", name, "SimpleMarker",
                option("name", shape) + option("color", text_of(fill)) + option("outline_color", "255,255,255,255") +
                    option("outline_width", "0.2") + option("size", fmt::format("{}", size_mm)) +
                    option("size_unit", "MM"));
}

std::string style(std::string_view renderer, std::string_view labels = {}) {
  return fmt::format(
      "<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>\n<qgis version=\"3.22\" "
      "styleCategories=\"Symbology|Labeling\" labelsEnabled=\"{}\">{}{}</qgis>\n",
      labels.empty() ? 0 : 1, renderer, labels);
}

/// The school's number in the survey, over its middle, with a white rim; none before the survey is merged.
std::string school_numbers() {
  return "<labeling type=\"simple\"><settings><text-style isExpression=\"1\" "
         "fieldName=\"if(survey_school > 0, to_string(survey_school), '')\" fontFamily=\"Sans Serif\" fontSize=\"8\" "
         "fontSizeUnit=\"Point\" textColor=\"20,20,20,255\" textOpacity=\"1\"><text-buffer bufferDraw=\"1\" "
         "bufferSize=\"0.6\" bufferSizeUnits=\"MM\" bufferColor=\"255,255,255,255\" bufferOpacity=\"1\"/></text-style>"
         "<placement placement=\"1\" centroidInside=\"1\"/><rendering drawLabels=\"1\"/></settings></labeling>";
}

std::string single(std::string_view symbol) {
  return style(
      fmt::format("<renderer-v2 type=\"singleSymbol\" symbollevels=\"0\" enableorderby=\"0\" "
                  "forceraster=\"0\"><symbols>{}</symbols></renderer-v2>",
                  symbol));
}

/// draw  the symbol of a class: (name, its colour)
template <class Draw>
std::string by_mean_sv(const Draw& draw, std::string_view labels = {}) {
  std::string ranges;
  std::string symbols;
  for (std::size_t i = 0; i < kClasses.size(); ++i) {
    const double lower = kFirstClass_db + kClass_db * static_cast<double>(i);
    const bool first = i == 0;
    const bool last = i + 1 == kClasses.size();
    const std::string label = first  ? fmt::format("below {} dB", lower + kClass_db)
                              : last ? fmt::format("{} dB and more", lower)
                                     : fmt::format("{} to {} dB", lower, lower + kClass_db);
    ranges += fmt::format("<range lower=\"{}\" upper=\"{}\" symbol=\"{}\" label=\"{}\" render=\"true\"/>",
                          first ? -kOpenEnd_db : lower, last ? kOpenEnd_db : lower + kClass_db, i, label);
    symbols += draw(fmt::format("{}", i), kClasses[i]);
  }
  ranges += fmt::format("<range lower=\"{}\" upper=\"{}\" symbol=\"{}\" label=\"unknown\" render=\"true\"/>",
                        kUnknown_db - 1.0, kUnknown_db + 1.0, kClasses.size());
  symbols += draw(fmt::format("{}", kClasses.size()), kUnknownColour);
  const std::string renderer = fmt::format(
      "<renderer-v2 type=\"graduatedSymbol\" attr=\"coalesce(sv_mean_db, {})\" graduatedMethod=\"GraduatedColor\" "
      "symbollevels=\"0\" enableorderby=\"0\" forceraster=\"0\"><ranges>{}</ranges><symbols>{}</symbols>"
      "<source-symbol>{}</source-symbol></renderer-v2>",
      kUnknown_db, ranges, symbols, draw("0", kClasses.back()));
  return style(renderer, labels);
}

}  // namespace

std::string layer_style_qml(std::string_view layer) {
  if (layer == "vessel_track") return single(line("0", kTrack, 0.5));
  if (layer == "observations") return single(area("0", kObservation, kObservationEdge, 0.26));
  if (layer == "swept") return single(area("0", kSwept, kSweptEdge, 0.1));
  if (layer == "observation_starts") return single(point("0", "triangle", kTrack, 2.6));
  if (layer == "school_outlines") return single(area("0", {0, 0, 0, 0}, kOutline, 0.15));
  if (layer == "schools") {
    return by_mean_sv(
        [](std::string_view name, Colour colour) {
          const Colour edge = colour;
          colour.a = 190;
          return area(name, colour, edge, 0.3);
        },
        school_numbers());
  }
  if (layer == "school_centres") {
    return by_mean_sv([](std::string_view name, const Colour& colour) { return point(name, "circle", colour, 1.4); });
  }
  return {};
}

}  // namespace sonar
