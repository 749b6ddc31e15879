// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "base/describe.h"

namespace sonar::synth::array {

/// How the receiving elements are weighted.
enum class Shading { uniform, taylor, dolph };
inline constexpr std::array<std::string_view, 3> kShadingNames = {"uniform", "taylor", "dolph"};

/// What the beam table says of the equivalent beam angle: the true pattern's, or more by psi_excess_db at 45 degrees of
/// elevation, growing as cos^-4 from none at 0.
enum class PsiLaw { exact, cos4 };
inline constexpr std::array<std::string_view, 2> kPsiLawNames = {"exact", "cos4"};

/// The array that sends and receives: a flat one that faces abeam.
struct Elements {
  int columns = 34;  ///< along the ship
  int rows = 21;     ///< upright
  double column_spacing_mm = 8.6;
  double row_spacing_mm = 7.6;
  Shading shading = Shading::taylor;
  double side_lobe_db = -25.0;
  double gain_scatter_db = 0.8;
  double phase_scatter_deg = 8.0;
  double failed = 0.02;
  double transmit_reach = 0.75;
  double transmit_taper = 0.3;
  double pulse_taper = 0.7;
  PsiLaw psi_law = PsiLaw::exact;
  double psi_excess_db = 6.0;
  double gain_error_db = 0.0;
  double sa_error_db = 0.0;
};

template <class Visitor>
void describe(Visitor& v, Elements& p) {
  v.field("columns", p.columns,
          {.min = 2,
           .max = 128,
           .text = "Number of array elements along the ship. Raise it for beams that are narrower in azimuth; lower it "
                   "to test a sonar with wide ones."});
  v.field("rows", p.rows,
          {.min = 2,
           .max = 128,
           .text = "Number of array elements in each upright column. Raise it for beams that are narrower in "
                   "elevation; lower it to test a sonar with wide ones."});
  v.field("column_spacing_mm", p.column_spacing_mm,
          {.unit = "mm",
           .min = 1,
           .max = 50,
           .text = "Distance between array elements along the ship. Raise it for beams that are narrower in azimuth; "
                   "beyond half a wavelength it tests grating lobes."});
  v.field("row_spacing_mm", p.row_spacing_mm,
          {.unit = "mm",
           .min = 1,
           .max = 50,
           .text = "Distance between array elements in the vertical. Raise it for beams that are narrower in "
                   "elevation; beyond half a wavelength it tests grating lobes."});
  v.choice("shading", p.shading, kShadingNames,
           "Weights of the receiving elements. Choose uniform to test narrow beams with strong side lobes, taylor or "
           "dolph for wider beams with weak ones.");
  v.field("side_lobe_db", p.side_lobe_db,
          {.unit = "dB",
           .min = -60,
           .max = -14,
           .text = "Side-lobe level for which the weights taylor and dolph are made. Raise it to test side-lobe "
                   "echoes; lower it for weaker side lobes at the cost of wider beams."});
  v.field("gain_scatter_db", p.gain_scatter_db,
          {.unit = "dB",
           .min = 0,
           .max = 6,
           .text = "Standard deviation of the gains of the array elements. Raise it to test an array in poor order, "
                   "with stronger side lobes; set it to 0 for equal elements."});
  v.field("phase_scatter_deg", p.phase_scatter_deg,
          {.unit = "deg",
           .min = 0,
           .max = 60,
           .text = "Standard deviation of the phases of the array elements. Raise it to test an array in poor order, "
                   "with stronger side lobes; set it to 0 for equal elements."});
  v.field("failed", p.failed,
          {.unit = "1",
           .min = 0,
           .max = 0.5,
           .text = "Share of the array elements that neither send nor receive. Raise it to test a sonar with broken "
                   "elements; set it to 0 for an intact array."});
  v.field("transmit_reach", p.transmit_reach,
          {.unit = "1",
           .min = 0.3,
           .max = 1,
           .text = "Direction cosine along the ship up to which a fan is sent. Raise it for full power in the "
                   "outermost beams; lower it to test fans that weaken towards their ends."});
  v.field("transmit_taper", p.transmit_taper,
          {.unit = "1",
           .min = 0,
           .max = 1,
           .text = "Share of the columns over which the sent amplitude falls off. Lower it to test fans whose level "
                   "ripples with azimuth; raise it for smoother ones."});
  v.field("pulse_taper", p.pulse_taper,
          {.unit = "1",
           .min = 0,
           .max = 1,
           .text = "Share of the pulse that its rise and fall take. Lower it to test a pulse with sharp ends; raise it "
                   "for one that rises and falls gently."});
  v.choice("psi_law", p.psi_law, kPsiLawNames,
           "Equivalent beam angle that the raw file states: the true one (exact), or one in error by more in steeper "
           "fans (cos4). Choose cos4 to test what that does to Sv.");
  v.field("psi_excess_db", p.psi_excess_db,
          {.unit = "dB",
           .min = -10,
           .max = 10,
           .text = "Error of the stated equivalent beam angle at 45 degrees of elevation, with law cos4. Change it to "
                   "test how an angle stated too large or too small biases Sv."});
  v.field("gain_error_db", p.gain_error_db,
          {.unit = "dB",
           .min = 0,
           .max = 6,
           .text = "Standard deviation of the error of each beam's stated gain. Raise it to test a sonar whose "
                   "calibration is out of date; truth/beams.csv has what is stated and what is true."});
  v.field("sa_error_db", p.sa_error_db,
          {.unit = "dB",
           .min = 0,
           .max = 3,
           .text = "Standard deviation of the error of each beam's stated sa correction. Raise it to test the same of "
                   "the other half of a calibration."});
}

}  // namespace sonar::synth::array
