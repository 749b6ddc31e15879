// SPDX-License-Identifier: Apache-2.0
#include "synth/array/pattern.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "base/units.h"
#include "synth/random.h"

namespace sonar::synth::array {
namespace {

constexpr double kNodesInLobe = 12.0;  ///< in wavelength / aperture; bilinear between them errs by 0.03 dB at most

using Complex = std::complex<double>;

double half_power_width(const std::function<double(double)>& power) {
  constexpr double kStep = 1e-4;
  double peak = 0.0;
  double at = 0.0;
  for (double x = -0.03; x <= 0.03; x += kStep) {
    if (power(x) > peak) {
      peak = power(x);
      at = x;
    }
  }
  double low = at;
  double high = at;
  while (low > -1.0 && power(low) > peak / 2.0) low -= kStep;
  while (high < 1.0 && power(high) > peak / 2.0) high += kStep;
  return high - low;
}

}  // namespace

std::complex<float> Pattern::Table::at(double bow, double up) const {
  const double x = std::clamp((bow - bow_first) * per_bow, 0.0, bows - 1.001);
  const double y = std::clamp((up - up_first) * per_up, 0.0, ups - 1.001);
  const int i = static_cast<int>(x);
  const int j = static_cast<int>(y);
  const auto fx = static_cast<float>(x - i);
  const auto fy = static_cast<float>(y - j);
  const std::complex<float>* row = values.data() + static_cast<std::ptrdiff_t>(j) * bows + i;
  const std::complex<float>* above = row + bows;
  return (row[0] * (1.0F - fx) + row[1] * fx) * (1.0F - fy) + (above[0] * (1.0F - fx) + above[1] * fx) * fy;
}

Pattern::Pattern(const Elements& params, const std::vector<Beam>& beams, std::uint64_t seed, Work& work)
    : fans_(make_fans(beams)), psi_sr_(beams.size()) {
  const std::vector<Element> elements = make_elements(params, seed);
  const std::size_t n = fans_.size();
  send_.resize(n);
  receive_.resize(n);
  axis_.resize(n);
  most_axis_.resize(n);
  width_bow_.resize(n);
  width_up_.resize(n);
  work.for_each(static_cast<std::int64_t>(n), [&](std::int64_t f) {
    const int fan = static_cast<int>(f);
    fill(fan, elements, params);
    set_axes(fan);
    measure_widths(fan);
    integrate(fan);
  });
}

void Pattern::fill(int f, const std::vector<Element>& elements, const Elements& params) {
  const Fan& fan = fans_[static_cast<std::size_t>(f)];
  const double wavelength = 2.0 * std::numbers::pi / fan.wave_number;
  const double along_m = params.columns * params.column_spacing_mm * 1e-3;
  const double upright_m = params.rows * params.row_spacing_mm * 1e-3;
  const double half_m = along_m / 2.0;
  const auto make = [&](double bow_first, double bow_last, bool sending) {
    Table t;
    t.bow_first = bow_first;
    t.up_first = -1.0 - fan.up;
    t.per_bow = kNodesInLobe * along_m / wavelength;
    t.per_up = kNodesInLobe * upright_m / wavelength;
    t.bows = static_cast<int>(std::ceil((bow_last - bow_first) * t.per_bow)) + 2;
    t.ups = static_cast<int>(std::ceil(2.0 * t.per_up)) + 2;
    t.values.resize(static_cast<std::size_t>(t.bows) * static_cast<std::size_t>(t.ups));
    t.most.resize(static_cast<std::size_t>(t.ups));
    // Rows of elements first: [row][bow].
    std::vector<Complex> rows(static_cast<std::size_t>(params.rows) * static_cast<std::size_t>(t.bows));
    for (int r = 0; r < params.rows; ++r) {
      for (int c = 0; c < params.columns; ++c) {
        const Element& e = elements[static_cast<std::size_t>(r * params.columns + c)];
        const double widening = sending ? params.transmit_reach * e.along_m * e.along_m / (2.0 * half_m) : 0.0;
        Complex value =
            (sending ? e.send : e.receive) * std::polar(1.0, fan.wave_number * (e.along_m * bow_first + widening));
        const Complex turn = std::polar(1.0, fan.wave_number * e.along_m / t.per_bow);
        for (int i = 0; i < t.bows; ++i, value *= turn) rows[static_cast<std::size_t>(r * t.bows + i)] += value;
      }
    }
    std::vector<Complex> line(static_cast<std::size_t>(t.bows));
    for (int j = 0; j < t.ups; ++j) {
      std::fill(line.begin(), line.end(), Complex());
      for (int r = 0; r < params.rows; ++r) {
        const double up_m = elements[static_cast<std::size_t>(r * params.columns)].up_m;
        const Complex phase = std::polar(1.0, fan.wave_number * up_m * (t.up_first + j / t.per_up));
        for (int i = 0; i < t.bows; ++i) {
          line[static_cast<std::size_t>(i)] += phase * rows[static_cast<std::size_t>(r * t.bows + i)];
        }
      }
      for (int i = 0; i < t.bows; ++i) {
        const std::complex<float> value(line[static_cast<std::size_t>(i)]);
        t.values[static_cast<std::size_t>(j * t.bows + i)] = value;
        t.most[static_cast<std::size_t>(j)] = std::max(t.most[static_cast<std::size_t>(j)], std::abs(value));
      }
    }
    return t;
  };
  const auto [least, most] = std::minmax_element(fan.bow.begin(), fan.bow.end());
  send_[static_cast<std::size_t>(f)] = make(-1.0, 1.0, true);
  receive_[static_cast<std::size_t>(f)] = make(-1.0 - *most, 1.0 - *least, false);
}

void Pattern::set_axes(int f) {
  const auto i = static_cast<std::size_t>(f);
  const Fan& fan = fans_[i];
  for (const double bow : fan.bow) {
    const double abeam = std::sqrt(std::max(1e-6, 1.0 - bow * bow - fan.up * fan.up));
    const double axis = static_cast<double>(std::abs(send_[i].at(bow, 0.0))) *
                        static_cast<double>(std::abs(receive_[i].at(0.0, 0.0))) * abeam;
    axis_[i].push_back(static_cast<float>(1.0 / std::max(axis, 1e-12)));
  }
  most_axis_[i] = *std::max_element(axis_[i].begin(), axis_[i].end());
}

void Pattern::measure_widths(int f) {
  const auto i = static_cast<std::size_t>(f);
  const Table& t = receive_[i];
  const auto power = [](std::complex<float> a) { return static_cast<double>(std::norm(a)); };
  width_bow_[i] = half_power_width([&](double x) { return power(t.at(x, 0.0)); });
  width_up_[i] = half_power_width([&](double x) { return power(t.at(0.0, x)); });
}

Pattern::TwoWayWidths Pattern::two_way_widths(int f, int beam) const {
  const Fan& fan = fans_[static_cast<std::size_t>(f)];
  std::vector<std::complex<float>> amplitude(fan.bow.size());
  // half_power_width() looks where the power is half of its most: the root of a two-way power of a quarter.
  const auto root = [&](double bow, double up) {
    const double abeam = std::sqrt(std::max(0.0, 1.0 - bow * bow - up * up));
    if (!two_way(f, {bow, up, abeam}, 0.0, amplitude)) return 0.0;
    return static_cast<double>(std::abs(amplitude[static_cast<std::size_t>(beam)]));
  };
  const double bow = fan.bow[static_cast<std::size_t>(beam)];
  return {half_power_width([&](double x) { return root(bow + x, fan.up); }),
          half_power_width([&](double x) { return root(bow, fan.up + x); })};
}

bool Pattern::two_way(int f, const Direction& to, double least, std::span<std::complex<float>> out) const {
  if (to.abeam <= 0.0) return false;
  const auto n = static_cast<std::size_t>(f);
  const Fan& fan = fans_[n];
  const Table& t = receive_[n];
  const double up = to.up - fan.up;
  // One face, both ways: sqrt(abeam) for each.
  const std::complex<float> sent = send_[n].at(to.bow, up) * static_cast<float>(to.abeam);
  const double y = std::clamp((up - t.up_first) * t.per_up, 0.0, t.ups - 1.001);
  const int j = static_cast<int>(y);
  const float most = std::max(t.most[static_cast<std::size_t>(j)], t.most[static_cast<std::size_t>(j) + 1]);
  if (static_cast<double>(std::abs(sent) * most * most_axis_[n]) < least) return false;
  const auto fy = static_cast<float>(y - j);
  const std::complex<float>* row = t.values.data() + static_cast<std::ptrdiff_t>(j) * t.bows;
  const std::complex<float>* above = row + t.bows;
  const float sent_re = sent.real();
  const float sent_im = sent.imag();
  for (std::size_t b = 0; b < fan.bow.size(); ++b) {
    const double x = (to.bow - fan.bow[b] - t.bow_first) * t.per_bow;
    const int i = std::clamp(static_cast<int>(x), 0, t.bows - 2);
    const auto fx = static_cast<float>(x - i);
    const float w11 = fx * fy;
    const float w10 = fx - w11;
    const float w01 = fy - w11;
    const float w00 = 1.0F - fx - w01;
    const float re = w00 * row[i].real() + w10 * row[i + 1].real() + w01 * above[i].real() + w11 * above[i + 1].real();
    const float im = w00 * row[i].imag() + w10 * row[i + 1].imag() + w01 * above[i].imag() + w11 * above[i + 1].imag();
    const float scale = axis_[n][b];
    out[b] = {scale * (sent_re * re - sent_im * im), scale * (sent_re * im + sent_im * re)};
  }
  return true;
}

void Pattern::receive(const Direction& from, int f, std::span<std::complex<float>> out) const {
  const auto n = static_cast<std::size_t>(f);
  const float axis = std::abs(receive_[n].at(0.0, 0.0));
  const auto element = static_cast<float>(std::sqrt(std::max(0.0, from.abeam)));
  for (std::size_t b = 0; b < fans_[n].bow.size(); ++b) {
    out[b] = receive_[n].at(from.bow - fans_[n].bow[b], from.up - fans_[n].up) * (element / axis);
  }
}

void Pattern::integrate(int f) {
  const Fan& fan = fans_[static_cast<std::size_t>(f)];
  constexpr int kElevations = 360;
  constexpr int kAzimuths = 360;
  const double step_e = std::numbers::pi / kElevations;
  const double step_a = std::numbers::pi / kAzimuths;
  std::vector<std::complex<float>> amplitude(fan.bow.size());
  std::vector<double> sums(fan.bow.size());
  for (int e = 0; e < kElevations; ++e) {
    const double elevation = -std::numbers::pi / 2.0 + (e + 0.5) * step_e;
    for (int a = 0; a < kAzimuths; ++a) {
      const Direction to = direction(elevation, -std::numbers::pi / 2.0 + (a + 0.5) * step_a);
      if (!two_way(f, to, 0.0, amplitude)) continue;
      for (std::size_t b = 0; b < sums.size(); ++b) {
        sums[b] += static_cast<double>(std::norm(amplitude[b])) * std::cos(elevation);
      }
    }
  }
  for (std::size_t b = 0; b < sums.size(); ++b) {
    psi_sr_[static_cast<std::size_t>(fan.channel[b])] = sums[b] * step_e * step_a;
  }
}

double psi_error_db(const Elements& params, double elevation_deg) {
  if (params.psi_law == PsiLaw::exact) return 0.0;
  constexpr double kAt45 = 6.0205999132796239;  // -40 log10(cos 45 deg)
  return params.psi_excess_db * -40.0 * std::log10(std::cos(rad_from_deg(elevation_deg))) / kAt45;
}

std::vector<Beam> stated_beams(std::vector<Beam> beams, const Pattern& pattern, const Elements& params,
                               double effective_pulse_s) {
  for (std::size_t f = 0; f < pattern.fans().size(); ++f) {
    for (const int channel : pattern.fans()[f].channel) {
      Beam& beam = beams[static_cast<std::size_t>(channel)];
      const int fan = static_cast<int>(f);
      beam.psi_db = db_from_linear(pattern.psi_sr(channel)) + psi_error_db(params, beam.elevation_deg);
      beam.vertical_width_deg =
          deg_from_rad(pattern.width_up(fan)) / std::max(0.1, std::cos(rad_from_deg(beam.elevation_deg)));
      beam.horizontal_width_deg =
          deg_from_rad(pattern.width_bow(fan)) / std::max(0.1, std::cos(rad_from_deg(beam.azimuth_deg)));
      beam.sa_correction_db = db_from_linear(effective_pulse_s / kPulseLength_s) / 2.0;
    }
  }
  return beams;
}

std::vector<Beam> with_errors(std::vector<Beam> beams, const Elements& params, std::uint64_t seed) {
  for (std::size_t i = 0; i < beams.size(); ++i) {
    RandomStream random(seed, Purpose::stated, 0, 0, static_cast<std::uint32_t>(i));
    beams[i].gain_db += params.gain_error_db * random.normal();
    beams[i].sa_correction_db += params.sa_error_db * random.normal();
  }
  return beams;
}

}  // namespace sonar::synth::array
