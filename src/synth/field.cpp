// SPDX-License-Identifier: Apache-2.0
#include "synth/field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/units.h"

namespace sonar::synth {
namespace {

/// Gaussians are cut where they fall below exp(-10), -43 dB.
constexpr double kCutExponent = 10.0;
constexpr double kSideLobeCutExponent = 4.5;
constexpr double kSideLobeWidth = 4.0;
constexpr int kStepsPerUnit = 1024;
constexpr double kNoSideLobe_db = -200.0;

/// The pulse is four samples long, so a sample's echo comes from two samples' length on either side of its range.
constexpr std::array<float, 5> kPulse = {0.125F, 0.25F, 0.25F, 0.25F, 0.125F};
constexpr int kPulseReach = 2;

class ExpTable {
 public:
  ExpTable() {
    for (std::size_t i = 0; i < values_.size(); ++i) {
      values_[i] = static_cast<float>(std::exp(-(static_cast<double>(i) + 0.5) / kStepsPerUnit));
    }
  }
  /// exp(-q) for 0 <= q < kCutExponent.
  [[nodiscard]] float operator()(double q) const { return values_[static_cast<std::size_t>(q * kStepsPerUnit)]; }

 private:
  std::array<float, static_cast<std::size_t>(kCutExponent) * kStepsPerUnit + 1> values_{};
};

const ExpTable& exp_table() {
  static const ExpTable table;
  return table;
}

/// A line's two-way pattern by its distance from the axis.
class LineTable {
 public:
  LineTable(BeamPattern pattern, PatternPart part) : reach_(pattern_reach(pattern, part)) {
    for (int i = 0; i < static_cast<int>(reach_ * kStepsPerUnit) + 1; ++i) {
      values_.push_back(static_cast<float>(pattern_value(pattern, part, (i + 0.5) / kStepsPerUnit)));
    }
  }
  [[nodiscard]] float operator()(double off_axis) const {
    const double z = std::abs(off_axis);
    return z < reach_ ? values_[static_cast<std::size_t>(z * kStepsPerUnit)] : 0.0F;
  }

 private:
  double reach_;
  std::vector<float> values_;
};

struct LineTables {
  explicit LineTables(BeamPattern pattern)
      : vertical(pattern, PatternPart::vertical), horizontal(pattern, PatternPart::horizontal) {}
  LineTable vertical;
  LineTable horizontal;
};

/// The Gaussian has none, and looks into none.
const LineTables& line_tables(BeamPattern pattern) {
  static const LineTables line(BeamPattern::uniform_line);
  static const LineTables wide_transmit(BeamPattern::wide_transmit);
  static const LineTables wide_fan(BeamPattern::wide_fan);
  if (pattern == BeamPattern::wide_transmit) return wide_transmit;
  return pattern == BeamPattern::wide_fan ? wide_fan : line;
}

struct Lobe {
  double inverse_v;  ///< Gaussian: 1 / (2 sigma_v^2); line: 1 / sigma_v
  double inverse_h;
  double norm;  ///< energy over the integral of the pattern
};

struct Pattern {
  std::vector<Lobe> lobes;  ///< [row]
  BeamPattern shape;
  double cut;  ///< Gaussian only
  double reach_v_rad;
  double reach_h_rad;
};

Pattern pattern(const Layout& layout, double width, double energy, double cut) {
  Pattern p{{},
            BeamPattern::gaussian,
            cut,
            width * layout.max_sigma_v_rad * std::sqrt(2.0 * cut),
            width * layout.max_sigma_h_rad * std::sqrt(2.0 * cut)};
  for (const RowBeam& row : layout.rows) {
    const double v = width * row.sigma_v_rad;
    const double h = width * row.sigma_h_rad;
    p.lobes.push_back({1.0 / (2.0 * v * v), 1.0 / (2.0 * h * h), energy / (2.0 * std::numbers::pi * v * h)});
  }
  return p;
}

Pattern line_pattern(const Layout& layout) {
  const BeamPattern shape = layout.pattern;
  const double integral =
      pattern_integral(shape, PatternPart::vertical) * pattern_integral(shape, PatternPart::horizontal);
  Pattern p{{},
            shape,
            0.0,
            layout.max_sigma_v_rad * pattern_reach(shape, PatternPart::vertical),
            layout.max_sigma_h_rad * pattern_reach(shape, PatternPart::horizontal)};
  for (const RowBeam& row : layout.rows) {
    p.lobes.push_back(
        {1.0 / row.sigma_v_rad, 1.0 / row.sigma_h_rad, 1.0 / (integral * row.sigma_v_rad * row.sigma_h_rad)});
  }
  return p;
}

Pattern main_pattern(const Layout& layout) {
  return layout.pattern == BeamPattern::gaussian ? pattern(layout, 1.0, 1.0, kCutExponent) : line_pattern(layout);
}

/// Neighbouring indices [first, last).
struct IndexRange {
  int first = 0;
  int last = 0;
  [[nodiscard]] bool empty() const { return first >= last; }
  [[nodiscard]] int size() const { return last - first; }
  void include(const IndexRange& other) {
    if (other.empty()) return;
    *this = empty() ? other : IndexRange{std::min(first, other.first), std::max(last, other.last)};
  }
};

class Splatter {
 public:
  explicit Splatter(const Layout& layout) : layout_(layout), line_(line_tables(layout.pattern)) {
    for (int fan = 0; fan < layout.shape.fans; ++fan) elevations_.push_back(row(fan, 0).elevation_rad);
    for (int beam = 0; beam < layout.shape.beams; ++beam) azimuths_.push_back(row(0, beam).azimuth_rad);
  }

  [[nodiscard]] IndexRange fans(const SeenScatterer& s, const Pattern& p) const {
    if (!layout_.grid) return {0, layout_.shape.fans};
    return within(elevations_, s.elevation_rad, p.reach_v_rad);
  }
  [[nodiscard]] IndexRange beams(const SeenScatterer& s, const Pattern& p) const {
    if (!layout_.grid) return {0, layout_.shape.beams};
    return within(azimuths_, s.azimuth_rad, p.reach_h_rad / std::max(0.05, std::cos(s.elevation_rad)));
  }

  /// Adds one scatterer to the box, shared out between the two samples round its range.
  void add(const SeenScatterer& s, const Pattern& p, SchoolField& box) const {
    const double cos_e = std::cos(s.elevation_rad);
    const double whole = std::floor(s.sample);
    const auto later = static_cast<float>(s.sample - whole);
    const int at = static_cast<int>(whole) - box.first_sample;
    if (at < 0 || at + 1 >= box.sv.shape().samples) return;
    const IndexRange fan_range = fans(s, p);
    const IndexRange beam_range = beams(s, p);
    for (int fan = fan_range.first; fan < fan_range.last; ++fan) {
      for (int beam = beam_range.first; beam < beam_range.last; ++beam) {
        const auto r = static_cast<std::size_t>(fan * layout_.shape.beams + beam);
        const Lobe& lobe = p.lobes[r];
        const double de = s.elevation_rad - layout_.rows[r].elevation_rad;
        const double da = (s.azimuth_rad - layout_.rows[r].azimuth_rad) * cos_e;
        const float directivity = towards(p, lobe, de, da);
        if (directivity <= 0.0F) continue;
        const float value = static_cast<float>(s.weight * lobe.norm) * directivity;
        float* out = &box.sv(fan - box.first_fan, beam - box.first_beam, at);
        out[0] += value * (1.0F - later);
        out[1] += value * later;
      }
    }
  }

 private:
  [[nodiscard]] float towards(const Pattern& p, const Lobe& lobe, double de, double da) const {
    if (p.shape != BeamPattern::gaussian) {
      return line_.vertical(de * lobe.inverse_v) * line_.horizontal(da * lobe.inverse_h);
    }
    const double q = de * de * lobe.inverse_v + da * da * lobe.inverse_h;
    return q < p.cut ? exp_(q) : 0.0F;
  }
  [[nodiscard]] const RowBeam& row(int fan, int beam) const {
    return layout_.rows[static_cast<std::size_t>(fan * layout_.shape.beams + beam)];
  }
  static IndexRange within(const std::vector<double>& centres, double value, double reach) {
    const auto first = std::lower_bound(centres.begin(), centres.end(), value - reach);
    const auto last = std::upper_bound(first, centres.end(), value + reach);
    return {static_cast<int>(first - centres.begin()), static_cast<int>(last - centres.begin())};
  }

  const Layout& layout_;
  const ExpTable& exp_ = exp_table();
  const LineTables& line_;
  std::vector<double> elevations_;
  std::vector<double> azimuths_;
};

void spread_over_pulse(std::span<float> row, std::vector<float>& scratch) {
  scratch.assign(row.begin(), row.end());
  const int n = static_cast<int>(row.size());
  for (int i = 0; i < n; ++i) {
    float sum = 0.0F;
    for (int k = -kPulseReach; k <= kPulseReach; ++k) {
      if (i + k < 0 || i + k >= n) continue;
      sum += kPulse[static_cast<std::size_t>(k + kPulseReach)] * scratch[static_cast<std::size_t>(i + k)];
    }
    row[static_cast<std::size_t>(i)] = sum;
  }
}

/// Azimuth of the sector's middle, about which all azimuths are unwrapped.
double middle_rad(const Layout& layout) {
  double sum = 0.0;
  for (const RowBeam& row : layout.rows) sum += row.azimuth_rad;
  return sum / static_cast<double>(layout.rows.size());
}

double unwrapped(double azimuth, double middle) {
  const double turn = 2.0 * std::numbers::pi;
  return azimuth - turn * std::round((azimuth - middle) / turn);
}

}  // namespace

void append_seen(std::vector<SeenScatterer>& seen, const Layout& layout, const Scatterers& body,
                 const Point<Enu>& centre_from_transducer, double heading_rad) {
  const double middle = middle_rad(layout);
  const double dr = layout.range.spacing_m;
  seen.reserve(seen.size() + body.points.size());
  for (const Scatterer& scatterer : body.points) {
    const Point<Sonar> p = to_sonar(centre_from_transducer + scatterer.offset_m, heading_rad);
    const double r = std::max(dr, norm(p));
    seen.push_back({std::asin(std::clamp(-p.z / r, -1.0, 1.0)), unwrapped(std::atan2(p.y, p.x), middle),
                    layout.range.sample_at(r), scatterer.backscatter_m2 / (r * r * dr)});
  }
}

bool out_of_reach(const Layout& layout, const Scatterers& body, const Point<Enu>& centre_from_transducer,
                  double heading_rad) {
  const double r = norm(centre_from_transducer);
  if (r - body.reach_m > layout.range.range_m(layout.range.count + kPulseReach)) return true;
  if (!layout.grid || r <= body.reach_m) return false;
  constexpr double kSideReach_rad = 0.3;
  const Point<Sonar> p = to_sonar(centre_from_transducer, heading_rad);
  const double azimuth = unwrapped(std::atan2(p.y, p.x), middle_rad(layout));
  const double level = std::sqrt(p.x * p.x + p.y * p.y);
  const double half_size = level > body.reach_m ? std::asin(body.reach_m / level) : std::numbers::pi;
  const auto& azimuths = layout.grid->grid.azimuth_deg;
  return azimuth + half_size < rad_from_deg(azimuths.front()) - kSideReach_rad ||
         azimuth - half_size > rad_from_deg(azimuths.back()) + kSideReach_rad;
}

SchoolField school_field(const Layout& layout, const std::vector<SeenScatterer>& seen, int school_id,
                         double side_lobe_db) {
  std::vector<Pattern> patterns{main_pattern(layout)};
  if (side_lobe_db > kNoSideLobe_db) {
    patterns.push_back(pattern(layout, kSideLobeWidth, linear_from_db(side_lobe_db), kSideLobeCutExponent));
  }
  const Splatter splatter(layout);
  IndexRange fans;
  IndexRange beams;
  IndexRange samples;
  for (const SeenScatterer& s : seen) {
    const IndexRange fan_range = splatter.fans(s, patterns.back());
    const IndexRange beam_range = splatter.beams(s, patterns.back());
    if (fan_range.empty() || beam_range.empty()) continue;
    fans.include(fan_range);
    beams.include(beam_range);
    const int at = static_cast<int>(std::floor(s.sample));
    samples.include({at - kPulseReach, at + kPulseReach + 2});
  }
  // One sample more on either side, so that what lies just outside still reaches in through the pulse.
  samples = {std::max(samples.first, -kPulseReach), std::min(samples.last, layout.shape.samples + kPulseReach)};
  SchoolField field{school_id, fans.first, beams.first, samples.first, {}};
  if (fans.empty() || beams.empty() || samples.empty()) return field;
  field.sv = Array3<float>({fans.size(), beams.size(), samples.size()});
  for (const Pattern& p : patterns) {
    for (const SeenScatterer& s : seen) splatter.add(s, p, field);
  }
  std::vector<float> scratch;
  for (int row = 0; row < static_cast<int>(field.sv.shape().rows()); ++row) {
    spread_over_pulse(field.sv.view().row(row), scratch);
  }
  return field;
}

}  // namespace sonar::synth
