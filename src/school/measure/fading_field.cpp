// SPDX-License-Identifier: Apache-2.0
#include "school/measure/fading_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

#include "base/units.h"
#include "school/fading.h"

namespace sonar {
namespace {

constexpr unsigned kBits = 12;
constexpr std::size_t kSteps = std::size_t{1} << kBits;

/// Means of a normal distribution's equal parts, near enough: of variance 1/2, so that two of them make an amplitude of power 1.
std::array<float, kSteps> normal_steps() {
  std::array<double, kSteps> values{};
  double at = -8.0;
  for (std::size_t i = 0; i < kSteps; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(kSteps);
    for (int k = 0; k < 50; ++k) {  // Newton's steps, from below: erf curves the same way up to the middle
      const double off = 0.5 * std::erfc(-at / std::numbers::sqrt2) - share;
      const double step = off * std::sqrt(2.0 * std::numbers::pi) * std::exp(0.5 * at * at);
      at -= std::clamp(step, -0.5, 0.5);
      if (std::abs(step) < 1e-9) break;
    }
    values[i] = at;
  }
  double power = 0.0;
  for (const double value : values) power += value * value / static_cast<double>(kSteps);
  std::array<float, kSteps> out{};
  std::transform(values.begin(), values.end(), out.begin(),
                 [&](double value) { return static_cast<float>(value / std::sqrt(2.0 * power)); });
  return out;
}

/// Sums over so many samples, to the power of one.
void run_sum(std::vector<float>& white, int count, std::span<float> out) {
  const auto length = static_cast<std::size_t>(count);
  const float scale = 1.0F / std::sqrt(static_cast<float>(count));
  float sum = 0.0F;
  for (std::size_t s = 0; s + 1 < length; ++s) sum += white[s];
  for (std::size_t s = 0; s < out.size(); ++s) {
    sum += white[s + length - 1];
    out[s] = sum * scale;
    sum -= white[s];
  }
}

/// out = sum of weights x rows, of which the last is out itself.
void mix(const std::vector<float>& weights, const auto& row_of) {
  const auto last = static_cast<int>(weights.size()) - 1;
  const std::span<float> out = row_of(last);
  for (float& one : out) one *= weights.back();
  for (int k = 0; k < last; ++k) {
    const float weight = weights[static_cast<std::size_t>(k)];
    if (weight == 0.0F) continue;
    const std::span<float> in = row_of(k);
    for (std::size_t s = 0; s < out.size(); ++s) out[s] += weight * in[s];
  }
}

}  // namespace

std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31U);
}

template <class Correlation>
FadingField::Weights FadingField::weights(int count, const Correlation& correlation) {
  constexpr double kNothing = 1e-3;
  std::vector<std::vector<double>> rows(static_cast<std::size_t>(count));
  Weights out(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].assign(i + 1, 0.0);
    for (std::size_t j = 0; j <= i; ++j) {
      double left = correlation(static_cast<int>(i), static_cast<int>(j));
      for (std::size_t k = 0; k < j; ++k) left -= rows[i][k] * rows[j][k];
      // Beams much wider than their spacing leave a row nothing of its own.
      if (i == j) rows[i][j] = std::sqrt(std::max(left, 0.0));
      if (i != j && rows[j][j] > kNothing) rows[i][j] = left / rows[j][j];
    }
    for (const double one : rows[i]) out[i].push_back(std::abs(one) < kNothing ? 0.0F : static_cast<float>(one));
  }
  return out;
}

FadingField::FadingField(const BeamGrid& grid, const IndexBox& box, double sample_m, double pulse_m)
    : size_{box.fans(), box.beams(), box.samples()} {
  if (sample_m > 0.0 && pulse_m > sample_m) {
    pulse_samples_ = static_cast<int>(std::lround(std::min(pulse_m / sample_m, 1.0 * kLongestPulse)));
  }
  const auto row = [&](int fan, int beam) { return (box.first_fan + fan) * grid.beams() + box.first_beam + beam; };
  for (int fan = 0; fan < size_.fans; ++fan) {
    of_beams_.push_back(
        weights(size_.beams, [&](int a, int b) { return amplitude_correlation(grid, row(fan, a), row(fan, b)); }));
  }
  const int middle = size_.beams / 2;
  of_fans_ =
      weights(size_.fans, [&](int a, int b) { return amplitude_correlation(grid, row(a, middle), row(b, middle)); });
}

Array3<std::int16_t> FadingField::draw(std::uint64_t seed) const {
  static const std::array<float, kSteps> kNormal = normal_steps();
  const auto whole = static_cast<std::size_t>(size_.samples + pulse_samples_ - 1);
  std::array<Array3<float>, 2> parts{Array3<float>(size_), Array3<float>(size_)};
  std::vector<float> white[2] = {std::vector<float>(whole), std::vector<float>(whole)};
  std::uint64_t next = mixed(seed);
  for (int row = 0; row < static_cast<int>(size_.rows()); ++row) {
    for (std::size_t s = 0; s < whole; ++s) {
      const std::uint64_t bits = mixed(next++);
      white[0][s] = kNormal[bits >> (64U - kBits)];
      white[1][s] = kNormal[bits & (kSteps - 1)];
    }
    for (std::size_t part = 0; part < 2; ++part) run_sum(white[part], pulse_samples_, parts[part].view().row(row));
  }
  for (Array3<float>& part : parts) {
    const View3<float> view = part.view();
    for (int f = 0; f < size_.fans; ++f) {
      const Weights& weights = of_beams_[static_cast<std::size_t>(f)];
      for (std::size_t b = weights.size(); b-- > 0;) mix(weights[b], [&](int beam) { return view.row(f, beam); });
    }
    for (std::size_t f = of_fans_.size(); f-- > 0;) {
      for (int b = 0; b < size_.beams; ++b) mix(of_fans_[f], [&](int fan) { return view.row(fan, b); });
    }
  }
  Array3<std::int16_t> counts(size_);
  std::transform(parts[0].all().begin(), parts[0].all().end(), parts[1].all().begin(), counts.all().begin(),
                 [](float re, float im) { return count_from_linear(static_cast<double>(re * re + im * im)); });
  return counts;
}

}  // namespace sonar
