// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/units.h"
#include "synth/array/pattern.h"
#include "synth/array/shading.h"
#include "synth/random.h"

namespace sonar::synth::array {
namespace {

std::complex<double> error_of(const Elements& params, RandomStream& random) {
  const double gain = std::pow(10.0, params.gain_scatter_db * random.normal() / 20.0);
  const double phase = rad_from_deg(params.phase_scatter_deg) * random.normal();
  return std::polar(gain, phase);
}

/// Falling amplitude towards both ends of the sending aperture.
double sending_taper(double x, double taper) {
  const double inside = (1.0 - std::abs(x)) / std::max(1e-9, taper);
  return inside >= 1.0 ? 1.0 : 0.5 * (1.0 - std::cos(std::numbers::pi * std::max(0.0, inside)));
}

}  // namespace

Direction direction(double elevation_rad, double azimuth_rad) {
  const double level = std::cos(elevation_rad);
  return {level * std::sin(azimuth_rad), std::sin(elevation_rad), level * std::cos(azimuth_rad)};
}

std::vector<Element> make_elements(const Elements& params, std::uint64_t seed) {
  const auto across = shading_weights(params.shading, params.columns, params.side_lobe_db);
  const auto upright = shading_weights(params.shading, params.rows, params.side_lobe_db);
  std::vector<Element> elements;
  for (int row = 0; row < params.rows; ++row) {
    for (int column = 0; column < params.columns; ++column) {
      RandomStream random(seed, Purpose::element, 0, static_cast<std::uint32_t>(row),
                          static_cast<std::uint32_t>(column));
      Element e;
      e.along_m = (column - (params.columns - 1) / 2.0) * params.column_spacing_mm * 1e-3;
      e.up_m = (row - (params.rows - 1) / 2.0) * params.row_spacing_mm * 1e-3;
      const bool failed = random.uniform() < params.failed;
      const double x = 2.0 * (column + 0.5) / params.columns - 1.0;
      e.send = failed ? 0.0 : error_of(params, random) * sending_taper(x, params.transmit_taper);
      e.receive = failed ? 0.0
                         : error_of(params, random) * across[static_cast<std::size_t>(column)] *
                               upright[static_cast<std::size_t>(row)];
      elements.push_back(e);
    }
  }
  return elements;
}

std::vector<Fan> make_fans(const std::vector<Beam>& beams) {
  std::map<double, std::vector<int>> by_elevation;
  for (std::size_t i = 0; i < beams.size(); ++i) by_elevation[beams[i].elevation_deg].push_back(static_cast<int>(i));
  std::vector<Fan> fans;
  for (auto& [elevation_deg, channels] : by_elevation) {
    std::sort(channels.begin(), channels.end(), [&](int a, int b) {
      return beams[static_cast<std::size_t>(a)].azimuth_deg < beams[static_cast<std::size_t>(b)].azimuth_deg;
    });
    Fan fan;
    fan.frequency_hz = beams[static_cast<std::size_t>(channels.front())].frequency_hz;
    fan.wave_number = 2.0 * std::numbers::pi * fan.frequency_hz / kSoundSpeed_mps;
    fan.up = std::sin(rad_from_deg(elevation_deg));
    for (const int channel : channels) {
      const Beam& beam = beams[static_cast<std::size_t>(channel)];
      fan.bow.push_back(direction(rad_from_deg(elevation_deg), rad_from_deg(beam.azimuth_deg)).bow);
    }
    fan.channel = channels;
    fans.push_back(std::move(fan));
  }
  return fans;
}

std::complex<double> sent_by_elements(const std::vector<Element>& elements, const Elements& params, const Fan& fan,
                                      const Direction& to) {
  const double half_m = params.columns * params.column_spacing_mm * 1e-3 / 2.0;
  std::complex<double> sum;
  for (const Element& e : elements) {
    // A phase that grows with the square of the place sends each part of the aperture another way: a broad fan.
    const double widening = params.transmit_reach * e.along_m * e.along_m / (2.0 * half_m);
    sum += e.send * std::polar(1.0, fan.wave_number * (e.along_m * to.bow + e.up_m * (to.up - fan.up) + widening));
  }
  return sum * std::sqrt(std::max(0.0, to.abeam));
}

std::complex<double> received_by_elements(const std::vector<Element>& elements, const Fan& fan, double steered_bow,
                                          const Direction& from) {
  std::complex<double> sum;
  for (const Element& e : elements) {
    sum += e.receive *
           std::polar(1.0, fan.wave_number * (e.along_m * (from.bow - steered_bow) + e.up_m * (from.up - fan.up)));
  }
  return sum * std::sqrt(std::max(0.0, from.abeam));
}

}  // namespace sonar::synth::array
