// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include "base/work.h"
#include "synth/array/params.h"
#include "synth/beam_table.h"

namespace sonar::synth::array {

/// A direction as the array sees it: cosines to the bow, up, and abeam (what it faces).
struct Direction {
  double bow = 0.0;
  double up = 0.0;
  double abeam = 1.0;
};
/// azimuth_rad  from abeam, positive towards the bow
[[nodiscard]] Direction direction(double elevation_rad, double azimuth_rad);

/// Beams of the same elevation and frequency, sent at once.
struct Fan {
  double frequency_hz = 0.0;
  double wave_number = 0.0;  ///< rad/m
  double up = 0.0;           ///< steering
  std::vector<int> channel;  ///< [beam], by rising azimuth
  std::vector<double> bow;   ///< [beam], steering
};

/// One element: where it stands on the face and what it does. Errors are the same for every beam.
struct Element {
  double along_m = 0.0;
  double up_m = 0.0;
  std::complex<double> send;     ///< without phases that steer or widen
  std::complex<double> receive;  ///< shading included
};
/// errors of gain and phase for sending and receiving, failed elements, shading
[[nodiscard]] std::vector<Element> make_elements(const Elements& params, std::uint64_t seed);
/// Fans by rising elevation.
/// beams  each elevation must have the same azimuths and one frequency
[[nodiscard]] std::vector<Fan> make_fans(const std::vector<Beam>& beams);

/// What the elements send and receive, by direct summation over them: the definition, slow.
[[nodiscard]] std::complex<double> sent_by_elements(const std::vector<Element>& elements, const Elements& params,
                                                    const Fan& fan, const Direction& to);
[[nodiscard]] std::complex<double> received_by_elements(const std::vector<Element>& elements, const Fan& fan,
                                                        double steered_bow, const Direction& from);

/// Two-way patterns of all beams out of the array's elements. Sums over elements depend on the direction cosines less
/// the steering alone, so that one table a fan, made once, serves all of its beams.
class Pattern {
 public:
  Pattern(const Elements& params, const std::vector<Beam>& beams, std::uint64_t seed, Work& work);

  [[nodiscard]] const std::vector<Fan>& fans() const { return fans_; }
  /// Amplitudes of the beams of a fan towards a direction, of size 1 on each beam's own axis.
  /// out      [beam of the fan]
  /// returns  false, with nothing written, where none can be above `least`
  bool two_way(int fan, const Direction& to, double least, std::span<std::complex<float>> out) const;
  /// Receiving amplitudes alone, of size 1 where a beam looks straight at the direction.
  void receive(const Direction& from, int fan, std::span<std::complex<float>> out) const;
  /// Equivalent two-way beam angle by integrating over the half space in front, sr.
  [[nodiscard]] double psi_sr(int channel) const { return psi_sr_[static_cast<std::size_t>(channel)]; }
  /// One-way receiving -3 dB widths in direction cosine, full.
  [[nodiscard]] double width_bow(int fan) const { return width_bow_[static_cast<std::size_t>(fan)]; }
  [[nodiscard]] double width_up(int fan) const { return width_up_[static_cast<std::size_t>(fan)]; }
  /// Full widths at which the two-way pattern is down by 6.02 dB, through its top; in direction cosine.
  struct TwoWayWidths {
    double bow, up;
  };
  [[nodiscard]] TwoWayWidths two_way_widths(int fan, int beam) const;

 private:
  struct Table {
    double bow_first = 0.0;
    double up_first = 0.0;
    double per_bow = 0.0;  ///< nodes in a unit
    double per_up = 0.0;
    int bows = 0;
    int ups = 0;
    std::vector<std::complex<float>> values;  ///< [up][bow]
    std::vector<float> most;                  ///< [up], the largest size
    [[nodiscard]] std::complex<float> at(double bow, double up) const;
  };
  void fill(int fan, const std::vector<Element>& elements, const Elements& params);
  void set_axes(int fan);
  void measure_widths(int fan);
  void integrate(int fan);

  std::vector<Fan> fans_;
  std::vector<Table> send_;
  std::vector<Table> receive_;
  std::vector<std::vector<float>> axis_;  ///< [fan][beam]: what brings the axis to 1
  std::vector<float> most_axis_;          ///< [fan]
  std::vector<double> psi_sr_;            ///< [channel]
  std::vector<double> width_bow_;
  std::vector<double> width_up_;
};

/// The beam table of this array: stated widths are the receiving pattern's, the equivalent beam angle is stated by the
/// law, the Sa correction is that of the received pulse.
[[nodiscard]] std::vector<Beam> stated_beams(std::vector<Beam> beams, const Pattern& pattern, const Elements& params,
                                             double effective_pulse_s);
/// The table as a calibration that is out of date has it: gains and sa corrections err.
[[nodiscard]] std::vector<Beam> with_errors(std::vector<Beam> beams, const Elements& params, std::uint64_t seed);
/// Stated minus true equivalent beam angle, dB.
[[nodiscard]] double psi_error_db(const Elements& params, double elevation_deg);

}  // namespace sonar::synth::array
