// SPDX-License-Identifier: Apache-2.0
#include "synth/array/receiver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/units.h"
#include "synth/random.h"

namespace sonar::synth::array {
namespace {

std::vector<Beam> three_beams() {
  std::vector<Beam> beams;
  for (const double azimuth : {-2.5, 0.0, 2.5}) {
    Beam b = ms70_beams()[262];  // in the middle of the middle fan
    b.azimuth_deg = azimuth;
    b.count = 600;
    beams.push_back(b);
  }
  return beams;
}

/// A small sonar of three beams.
struct Sounding {
  Work work{1};
  Elements params;
  std::vector<Beam> beams = three_beams();
  Pattern pattern{params, beams, 7, work};
  Pulse pulse{kPulseLength_s, kSampleInterval_s, params.pulse_taper};
  Receiver receiver{pattern, pulse, beams};
  [[nodiscard]] Direction axis(int beam) const {
    const Beam& b = beams[static_cast<std::size_t>(beam)];
    return direction(rad_from_deg(b.elevation_deg), rad_from_deg(b.azimuth_deg));
  }
};

TEST(Receiver, AFishOnTheAxisGivesThePointTargetEquation) {
  const Sounding s;
  constexpr int kSample = 400;
  const double r = s.receiver.range().range_m(kSample);
  constexpr double kTs_db = -42.0;
  Array3<std::complex<float>> field(s.receiver.shape());
  s.receiver.add({s.axis(1), r, std::sqrt(linear_from_db(kTs_db)), linear_from_db(kTs_db)}, field.view(), nullptr);
  double most = 0.0;
  int at_beam = -1;
  int at_sample = -1;
  for (int b = 0; b < 3; ++b) {
    for (int i = 0; i < 600; ++i) {
      const double power = static_cast<double>(std::norm(field(0, b, i)));
      if (power <= most) continue;
      most = power;
      at_beam = b;
      at_sample = i;
    }
  }
  EXPECT_EQ(at_beam, 1);
  EXPECT_EQ(at_sample, kSample);
  // By hand, with the table's numbers of this beam; the sonar equation in dB.
  const Beam& b = s.beams[1];
  const double wavelength = kSoundSpeed_mps / b.frequency_hz;
  const double by_hand_db = 10.0 * std::log10(b.power_w) + 2.0 * b.gain_db +
                            20.0 * std::log10(wavelength / (4.0 * std::numbers::pi)) + kTs_db - 40.0 * std::log10(r) -
                            2.0 * b.absorption_db_per_m * r;
  EXPECT_NEAR(db_from_linear(most), by_hand_db, 0.02);
}

TEST(Receiver, FishThatFillTheWaterGiveTheSonarEquationOfVolumes) {
  const Sounding s;
  // n sigma psi c tau / 2 r^2, with psi the pattern's integral and tau the received pulse's: summed over single fish.
  constexpr double kNear_m = 95.0;
  constexpr double kFar_m = 107.0;
  constexpr int kFish = 600'000;
  const double volume =
      2.0 * std::numbers::pi / 3.0 * (std::pow(kFar_m, 3) - std::pow(kNear_m, 3));  // the half space in front
  const double sv = kFish / volume * 1e-4;
  RandomStream random(1, Purpose::fish);
  ExpectedBox box{0, Array3<float>(s.receiver.shape())};
  Array3<std::complex<float>> field(s.receiver.shape());
  for (int i = 0; i < kFish; ++i) {
    const double up = random.uniform(-1.0, 1.0);
    const double azimuth = random.uniform(-std::numbers::pi / 2.0, std::numbers::pi / 2.0);
    const double r = std::cbrt(random.uniform(std::pow(kNear_m, 3), std::pow(kFar_m, 3)));
    s.receiver.add({direction(std::asin(up), azimuth), r, 1e-2, 1e-4}, field.view(), &box);
  }
  const RangeAxis& range = s.receiver.range();
  double expected_ratio = 0.0;
  double heard_ratio = 0.0;
  int n = 0;
  for (int b = 0; b < 3; ++b) {
    for (int i = static_cast<int>(range.sample_at(kNear_m)) + 6; i < static_cast<int>(range.sample_at(kFar_m)) - 6;
         ++i) {
      const Beam& beam = s.beams[static_cast<std::size_t>(b)];
      const double r = range.range_m(i);
      const double wavelength = kSoundSpeed_mps / beam.frequency_hz;
      const double power_db = 10.0 * std::log10(beam.power_w * sv * kSoundSpeed_mps * s.pulse.effective_s() / 2.0) +
                              2.0 * beam.gain_db + 20.0 * std::log10(wavelength / (4.0 * std::numbers::pi)) +
                              db_from_linear(s.pattern.psi_sr(b)) - 20.0 * std::log10(r) -
                              2.0 * beam.absorption_db_per_m * r;
      expected_ratio += static_cast<double>(box.power_w(0, b, i)) / linear_from_db(power_db);
      heard_ratio += static_cast<double>(std::norm(field(0, b, i))) / linear_from_db(power_db);
      ++n;
    }
  }
  // Some hundred fish in a pulse volume, about 3 x 7 independent ones: 3 % for sums, 22 % for their speckle.
  EXPECT_NEAR(expected_ratio / n, 1.0, 0.08);
  EXPECT_NEAR(heard_ratio / n, 1.0, 0.6);
}

/// Powers of one sample, each of fish placed anew within a pulse volume; `together` of them as one Gaussian echo.
std::vector<double> realisations(const Sounding& s, int echoes, int together, std::uint32_t stream) {
  constexpr int kTimes = 3000;
  const double r0 = s.receiver.range().range_m(300);
  RandomStream random(stream, Purpose::milling);
  std::vector<double> powers;
  Array3<std::complex<float>> field(s.receiver.shape());
  for (int i = 0; i < kTimes; ++i) {
    std::fill(field.all().begin(), field.all().end(), std::complex<float>());
    for (int k = 0; k < echoes; ++k) {
      const double r = r0 + random.uniform(-1.5, 1.5);
      const double off_up = rad_from_deg(random.uniform(-4.0, 4.0));
      const double off = rad_from_deg(random.uniform(-3.0, 3.0));
      const Direction from =
          direction(rad_from_deg(s.beams[1].elevation_deg) + off_up, rad_from_deg(s.beams[1].azimuth_deg) + off);
      std::complex<double> amplitude = 1e-2;
      if (together > 1) {
        const double size = std::sqrt(together * 1e-4 / 2.0);
        const double re = random.normal();
        amplitude = {size * re, size * random.normal()};
      }
      s.receiver.add({from, r, amplitude, 1e-4 * together}, field.view(), nullptr);
    }
    powers.push_back(static_cast<double>(std::norm(field(0, 1, 300))));
  }
  return powers;
}
double mean(const std::vector<double>& v) {
  double sum = 0.0;
  for (const double x : v) sum += x;
  return sum / static_cast<double>(v.size());
}
double share_above(const std::vector<double>& v, double level) {
  return static_cast<double>(std::count_if(v.begin(), v.end(), [level](double x) { return x > level; })) /
         static_cast<double>(v.size());
}

TEST(Receiver, TheSpeckleOfManyFishIsExponential) {
  const Sounding s;
  const auto powers = realisations(s, 80, 1, 11);
  const double m = mean(powers);
  // exp(-1) and exp(-3) of an exponential lie above once and three times its mean; 4 standard errors of 3000.
  EXPECT_NEAR(share_above(powers, m), std::exp(-1.0), 0.035);
  EXPECT_NEAR(share_above(powers, 3.0 * m), std::exp(-3.0), 0.016);
}

// Gathering lets the mean power of a pulse volume vary with where its few places lie, by a variance v of the mean squared
// that falls as one over their number; the share above the mean then lies v / (2 e) below an exponential's. Of 12 places
// that is 0.05, of 60 a hundredth; the simulator's schools have hundreds in a pulse volume.
TEST(Receiver, FishGatheredInOnePlaceEchoAsTheSameFishApart) {
  const Sounding s;
  const auto apart = realisations(s, 600, 1, 21);
  const auto gathered = realisations(s, 60, 10, 22);
  const double m = mean(apart);
  EXPECT_NEAR(mean(gathered) / m, 1.0, 0.11);  // 4 standard errors of a ratio of two such means
  EXPECT_NEAR(share_above(gathered, m), share_above(apart, m), 0.05);
  EXPECT_NEAR(share_above(gathered, 3.0 * m), share_above(apart, 3.0 * m), 0.025);
}

}  // namespace
}  // namespace sonar::synth::array
