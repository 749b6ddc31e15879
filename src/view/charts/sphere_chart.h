// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/describe.h"
#include "base/result.h"
#include "view/axes.h"
#include "view/frame_description.h"
#include "view/theme.h"

namespace sonar {

/// What a sphere run tells of a beam.
enum class SphereFigure : std::uint8_t { gain, sa_correction, psi, width_along, width_athwart };
inline constexpr std::array<std::string_view, 5> kSphereFigureNames{"gain", "sa_correction", "psi", "width_along",
                                                                    "width_athwart"};

/// Which figure a picture of a sphere run shows, and how.
struct SphereLook {
  SphereFigure figure = SphereFigure::gain;
  bool errors = false;
  friend bool operator==(const SphereLook&, const SphereLook&) = default;
};

template <class Visitor>
void describe(Visitor& v, SphereLook& p) {
  v.choice("figure", p.figure, kSphereFigureNames, "figure of each beam that the picture shows before and after");
  v.field("errors", p.errors, {.text = "colour the beams by the figure's standard error instead of by its change"});
}

/// One beam of a sphere run; figures in dB, widths in degrees.
struct SphereChartBeam {
  enum class State : std::uint8_t { left, near_null, crossed };
  struct Figure {
    double before = 0.0;
    double after = 0.0;
    double se = 0.0;
  };
  int channel = 0;  ///< as calibration tables count, from 0
  int fan = 0;
  int beam = 0;
  double frequency_khz = 0.0;
  State state = State::left;
  int hits = 0;
  double rms_db = 0.0;
  std::array<Figure, kSphereFigureNames.size()> figures{};  ///< of crossed beams

  [[nodiscard]] bool crossed() const { return state == State::crossed; }
};
/// A level of the sphere that was measured in a beam, less that of the fitted model.
struct SphereChartResidual {
  std::size_t beam = 0;  ///< its place in SphereChartData::beams
  double off_axis_deg = 0.0;
  double residual_db = 0.0;
};

struct SphereChartData {
  std::string title;
  std::string words;  ///< below it
  int fans = 0;
  int beams_a_fan = 0;
  std::vector<SphereChartBeam> beams;  ///< by fan, then beam: all that there are
  std::vector<SphereChartResidual> residuals;
};

struct SphereChartStyle {
  SphereLook look;
  std::optional<std::size_t> beam;  ///< stands out in all three plots
};

struct SphereChart {
  FrameDescription frame;
  PlotFrame map;
  PlotFrame residuals;
  PlotFrame figures;
  std::vector<std::size_t> crossed;  ///< beams in the order of `figures`, at 0, 1, 2, ...
  /// The beam under a place of the map, or the crossed one nearest to it along `figures`.
  [[nodiscard]] std::optional<std::size_t> beam_at(const SphereChartData& data, PixelPoint at) const;
};

/// A map of the beams, coloured by how far a figure changed or by its standard error, with a colour bar; what the sphere's
/// levels are off the fitted pattern against the angle off the beam's axis; and the figure of each crossed beam before and
/// after, with a bar of one standard error.
/// cost    linear in residuals; those that fall on one another are drawn once
/// errors  bad_parameter: too small a picture; not_found: no beam was crossed
[[nodiscard]] Result<SphereChart> sphere_chart(const SphereChartData& data, const SphereChartStyle& style,
                                               PixelSize size, const Theme& theme);

/// What is known of a beam, in lines.
[[nodiscard]] std::string sphere_beam_text(const SphereChartBeam& beam);

}  // namespace sonar
