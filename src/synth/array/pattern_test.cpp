// SPDX-License-Identifier: Apache-2.0
#include "synth/array/pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/units.h"

namespace sonar::synth::array {
namespace {

/// Few elements and beams, so that the definition can be summed over the half space.
Elements small_array() {
  Elements e;
  e.columns = 12;
  e.rows = 8;
  e.column_spacing_mm = 9.0;
  e.row_spacing_mm = 8.0;
  return e;
}
std::vector<Beam> few_beams() {
  std::vector<Beam> beams;
  for (const double elevation : {-30.0, -5.0}) {
    for (const double azimuth : {-20.0, 0.0, 10.0}) {
      Beam b = ms70_beams()[400];
      b.elevation_deg = elevation;
      b.azimuth_deg = azimuth;
      b.frequency_hz = elevation < -10.0 ? 95e3 : 80e3;
      beams.push_back(b);
    }
  }
  return beams;
}

TEST(Pattern, TheTableIsTheSumOverElements) {
  Work work(1);
  const Elements params = small_array();
  const Pattern pattern(params, few_beams(), 5, work);
  const auto elements = make_elements(params, 5);
  std::vector<std::complex<float>> out(3);
  for (int f = 0; f < 2; ++f) {
    const Fan& fan = pattern.fans()[static_cast<std::size_t>(f)];
    for (const double elevation : {-60.0, -31.0, -12.3, 4.0, 20.0}) {
      for (const double azimuth : {-55.0, -19.0, 1.0, 33.0}) {
        const Direction to = direction(rad_from_deg(elevation), rad_from_deg(azimuth));
        ASSERT_TRUE(pattern.two_way(f, to, 0.0, out));
        for (std::size_t b = 0; b < 3; ++b) {
          const Direction axis{fan.bow[b], fan.up, std::sqrt(1.0 - fan.bow[b] * fan.bow[b] - fan.up * fan.up)};
          const auto both = [&](const Direction& d) {
            return sent_by_elements(elements, params, fan, d) * received_by_elements(elements, fan, fan.bow[b], d);
          };
          const double expected = std::abs(both(to)) / std::abs(both(axis));
          EXPECT_NEAR(static_cast<double>(std::abs(out[b])), expected, 0.004)
              << f << " " << elevation << " " << azimuth;
        }
      }
    }
  }
}

TEST(Pattern, PsiIsTheIntegralOfTheElementsOwnPattern) {
  Work work(1);
  const Elements params = small_array();
  const auto beams = few_beams();
  const Pattern pattern(params, beams, 5, work);
  const auto elements = make_elements(params, 5);
  const Fan& fan = pattern.fans()[0];
  constexpr std::size_t kBeam = 2;
  const Direction axis{fan.bow[kBeam], fan.up, std::sqrt(1.0 - fan.bow[kBeam] * fan.bow[kBeam] - fan.up * fan.up)};
  const auto power = [&](const Direction& d) {
    return std::norm(sent_by_elements(elements, params, fan, d) *
                     received_by_elements(elements, fan, fan.bow[kBeam], d));
  };
  // Over direction cosines, dOmega = d bow d up / abeam: another quadrature than the program's.
  constexpr double kStep = 0.02;
  double sum = 0.0;
  for (double bow = -1.0 + kStep / 2.0; bow < 1.0; bow += kStep) {
    for (double up = -1.0 + kStep / 2.0; up < 1.0; up += kStep) {
      const double rest = 1.0 - bow * bow - up * up;
      if (rest <= 0.0) continue;
      sum += power({bow, up, std::sqrt(rest)}) / std::sqrt(rest) * kStep * kStep;
    }
  }
  const double psi_db = db_from_linear(sum / power(axis));
  const int channel = fan.channel[kBeam];
  EXPECT_NEAR(db_from_linear(pattern.psi_sr(channel)), psi_db, 0.05);

  Elements wrong = params;
  EXPECT_NEAR(stated_beams(beams, pattern, wrong, 1e-3)[static_cast<std::size_t>(channel)].psi_db, psi_db, 0.05);
  wrong.psi_law = PsiLaw::cos4;
  wrong.psi_excess_db = 6.0205999132796239;  // cos^-4 itself: 40 log10(1 / cos 30) = 2.499 dB more
  EXPECT_NEAR(stated_beams(beams, pattern, wrong, 1e-3)[static_cast<std::size_t>(channel)].psi_db - psi_db, 2.4988,
              0.05);
}

TEST(Pattern, AUniformFaceHasItsKnownWidths) {  // 0.886 wavelengths over the aperture
  Work work(1);
  Elements params;
  params.shading = Shading::uniform;
  params.gain_scatter_db = params.phase_scatter_deg = params.failed = 0.0;
  const Pattern pattern(params, few_beams(), 1, work);
  const double wavelength = kSoundSpeed_mps / pattern.fans()[1].frequency_hz;
  EXPECT_NEAR(pattern.width_bow(1), 0.886 * wavelength / (34 * 8.6e-3), 0.001);
  EXPECT_NEAR(pattern.width_up(1), 0.886 * wavelength / (21 * 7.6e-3), 0.002);
}

TEST(Pattern, FansAreSentWithTheRippleOfARealOne) {  // 0.5 .. 2.4 dB over the beams of an MS70's fan
  Work work(2);
  const Elements params;
  const auto elements = make_elements(params, 3);
  const auto fans = make_fans(ms70_beams());
  std::vector<double> ripples;
  for (const std::size_t f : {0U, 10U, 19U}) {
    double least = 1e9;
    double most = -1e9;
    for (const double bow : fans[f].bow) {
      const Direction to{bow, fans[f].up, std::sqrt(1.0 - bow * bow - fans[f].up * fans[f].up)};
      // The elements' own directivity is no ripple.
      const double db = db_from_linear(std::norm(sent_by_elements(elements, params, fans[f], to)) / to.abeam);
      least = std::min(least, db);
      most = std::max(most, db);
    }
    ripples.push_back(most - least);
  }
  for (const double ripple : ripples) {
    EXPECT_GT(ripple, 0.5);
    EXPECT_LT(ripple, 2.4);
  }
}

}  // namespace
}  // namespace sonar::synth::array
