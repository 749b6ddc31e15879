// SPDX-License-Identifier: Apache-2.0
#include "school/seabed/seabed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/check.h"
#include "base/units.h"
#include "model/school.h"
#include "school/beam_axes.h"
#include "school/seabed/seabed_echoes.h"
#include "school/seabed/seabed_hills.h"
#include "school/seabed/seabed_plane.h"

namespace sonar {
namespace {

constexpr double kTwoWayHalfPower_db = 6.02;  ///< half a one-way -3 dB width off the axis

class SeabedFinder {
 public:
  SeabedFinder(const SeabedWater& water, const std::vector<double>& vertical_width_deg)
      : water_(water),
        sv_(water.sv),
        sector_(water.sector),
        axes_(water.sector),
        width_deg_(vertical_width_deg),
        params_(water.params),
        long_(long_echoes(water)),
        echoes_(seabed_echoes(water, long_)) {}

  Seabed find() {
    Seabed seabed;
    seabed.first_sample.assign(sv_.shape().rows(), sv_.shape().samples);
    double seen = 0.0;
    const std::optional<SeabedPlane> plane = seen_plane(seen);
    if (!plane) return seabed;
    seabed.found = true;
    seabed.offset_m = plane->offset;
    seabed.slope_x = plane->slope_x;
    seabed.slope_y = plane->slope_y;
    seabed.confidence = seen;
    seabed.roughness_m = roughness_m(*plane);
    bounds(*plane, seabed);
    const double strength = strength_db(*plane);
    for (int row = 0; row < static_cast<int>(sv_.shape().rows()); ++row) {
      const int first = seabed_sample(*plane, row);
      seabed.first_sample[static_cast<std::size_t>(row)] = first;
      seabed.heard_sample.push_back(std::min(first, onset(*plane, strength, row)));
    }
    if (params_.hills) add_hills(*plane, strength, seabed);
    return seabed;
  }

 private:
  [[nodiscard]] Point<Sonar> axis(int row, double lower_by_rad = 0.0) const { return axes_.of(row, lower_by_rad); }
  [[nodiscard]] double inlier_m(double range_m) const {
    return std::max(params_.inlier_m, params_.inlier_share * range_m);
  }

  [[nodiscard]] int support(const SeabedPlane& plane) const {
    int beams = 0;
    int last_row = -1;
    for (const SeabedEcho& echo : echoes_) {
      if (echo.row == last_row) continue;
      if (!is_of(echo, plane)) continue;
      ++beams;
      last_row = echo.row;
    }
    return beams;
  }

  /// The first plane that is seen wherever it should be. Schools of many beams at one depth support a plane of their own
  /// better than a seabed that only the lowest fans reach: what lies on a plane that is not seen is left out of the next.
  [[nodiscard]] std::optional<SeabedPlane> seen_plane(double& seen) {
    const std::vector<SeabedEcho> all = echoes_;
    for (int tried = 0; tried < SeabedParams::planes; ++tried) {
      const std::vector<SeabedEcho> left = echoes_;
      const std::optional<SeabedPlane> plane = robust_plane();
      echoes_ = all;
      if (!plane) break;
      seen = coverage(*plane);
      if (seen >= params_.min_coverage) return plane;
      echoes_ = left;
      std::erase_if(echoes_, [&](const SeabedEcho& echo) { return is_of(echo, *plane); });
    }
    echoes_ = all;
    return std::nullopt;
  }

  /// The plane that most beams support, among planes through triples drawn by a fixed sequence; then least squares.
  [[nodiscard]] std::optional<SeabedPlane> robust_plane() const {
    const std::size_t n = echoes_.size();
    if (n < static_cast<std::size_t>(std::max(params_.min_inliers, 3))) return std::nullopt;
    const double steepest = std::tan(rad_from_deg(params_.max_slope_deg));
    std::uint64_t state = 0x9e3779b97f4a7c15ULL;
    const auto draw = [&] {
      state = state * 6364136223846793005ULL + 1442695040888963407ULL;
      return static_cast<std::size_t>((state >> 33) % n);
    };
    std::optional<SeabedPlane> best;
    int most = 0;
    for (int trial = 0; trial < SeabedParams::trials; ++trial) {
      const std::array<Point<Sonar>, 3> p{echoes_[draw()].place, echoes_[draw()].place, echoes_[draw()].place};
      std::optional<SeabedPlane> plane = plane_through(p, SeabedParams::min_triangle_m2);
      // every third trial a level plane: enough where few beams see the seabed
      if (trial % 3 == 0) plane = SeabedPlane{p[0].z, 0.0, 0.0};
      if (!plane || plane->slope() > steepest || plane->offset <= 0.0) continue;
      const int beams = support(*plane);
      if (beams > most) {
        most = beams;
        best = plane;
      }
    }
    if (most < params_.min_inliers) return std::nullopt;
    for (int round = 0; round < SeabedParams::refinements; ++round) {
      const double reach =
          std::clamp(SeabedParams::fit_spreads * median_off(*best), SeabedParams::fit_least_share, 1.0);
      const std::optional<SeabedPlane> better = least_squares(*best, reach);
      if (!better || better->slope() > steepest || better->offset <= 0.0) break;
      // about a smooth seabed what is lost may be a school; over hills all that supports the plane is seabed
      if (support(*better) < (is_smooth(*better) ? SeabedParams::fit_support : 1.0) * most) break;
      best = better;
    }
    return best;
  }

  /// How far echoes lie from a plane, as a share of what an inlier may: most of them, schools' own and hills aside.
  [[nodiscard]] double median_off(const SeabedPlane& plane) const {
    std::vector<double> off;
    for (const SeabedEcho& echo : echoes_) {
      const double share = std::abs(plane.z(echo.place.x, echo.place.y) - echo.place.z) / inlier_m(echo.range_m);
      if (share < 1.0) off.push_back(share);
    }
    if (off.empty()) return 1.0;
    const auto middle = off.begin() + std::ssize(off) / 2;
    std::nth_element(off.begin(), middle, off.end());
    return *middle;
  }

  [[nodiscard]] bool is_smooth(const SeabedPlane& plane) const {
    return median_off(plane) < SeabedParams::fit_smooth_share;
  }

  /// Weighted fit of the inliers of a plane; Tukey's biweight on the distance in depth, scaled by the median distance: echo
  /// of a school over a smooth seabed has no say.
  [[nodiscard]] std::optional<SeabedPlane> least_squares(const SeabedPlane& start, double reach) const {
    std::array<std::array<double, 4>, 3> m{};
    for (const SeabedEcho& echo : echoes_) {
      const double off = (start.z(echo.place.x, echo.place.y) - echo.place.z) / (reach * inlier_m(echo.range_m));
      if (std::abs(off) >= 1.0) continue;
      const double w = (1.0 - off * off) * (1.0 - off * off) / inlier_m(echo.range_m);
      const std::array<double, 4> v{1.0, echo.place.x, echo.place.y, echo.place.z};
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 4; ++j) m[i][j] += w * v[i] * v[j];
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {  // elimination; the matrix is positive definite or refused
      if (!(m[i][i] > 1e-9)) return std::nullopt;
      for (std::size_t k = i + 1; k < 3; ++k) {
        const double factor = m[k][i] / m[i][i];
        for (std::size_t j = i; j < 4; ++j) m[k][j] -= factor * m[i][j];
      }
    }
    SeabedPlane plane;
    plane.slope_y = m[2][3] / m[2][2];
    plane.slope_x = (m[1][3] - m[1][2] * plane.slope_y) / m[1][1];
    plane.offset = (m[0][3] - m[0][1] * plane.slope_x - m[0][2] * plane.slope_y) / m[0][0];
    return plane;
  }

  [[nodiscard]] bool is_of(const SeabedEcho& echo, const SeabedPlane& plane) const {
    return std::abs(plane.z(echo.place.x, echo.place.y) - echo.place.z) <= inlier_m(echo.range_m);
  }

  /// What to add to lambert_db(): the median over the echoes that lie on the plane.
  [[nodiscard]] double strength_db(const SeabedPlane& plane) const {
    std::vector<double> strengths;
    for (const SeabedEcho& echo : echoes_) {
      if (is_of(echo, plane)) strengths.push_back(echo.peak_db - plane.lambert_db(axis(echo.row), echo.range_m));
    }
    const auto middle = strengths.begin() + std::ssize(strengths) / 2;
    std::nth_element(strengths.begin(), middle, strengths.end());
    return *middle;
  }

  /// Of echoes in the beam-edge echo of a smooth seabed it is the schools that are loud; over hills it may be the next hill.
  void add_hills(const SeabedPlane& plane, double strength_db, Seabed& seabed) const {
    std::vector<std::int32_t> hills = is_smooth(plane) ? seabed.heard_sample : seabed.first_sample;
    const std::vector<std::int32_t> of_plane = hills;
    find_hills(water_, long_, plane, strength_db, width_deg_, hills);
    for (std::size_t row = 0; row < hills.size(); ++row) {
      if (hills[row] == of_plane[row]) continue;
      seabed.first_sample[row] = std::min(seabed.first_sample[row], hills[row]);
      seabed.heard_sample[row] = std::min(seabed.heard_sample[row], hills[row]);
    }
  }

  /// Whether a beam should see the plane: its peak comes clearly above what is loud at that range.
  [[nodiscard]] bool visible(const SeabedPlane& plane, int row, double strength_db) const {
    const Point<Sonar> u = axis(row);
    const double range_m = plane.range(u);
    const int sample = std::clamp(static_cast<int>(sector_.range().sample_at(range_m)), 0, sv_.shape().samples - 1);
    const int limit = loud_limit(water_, row)(sample);
    return strength_db + plane.lambert_db(u, range_m) >= db_from_counts(limit) + SeabedParams::visible_db;
  }

  /// Share of the beams whose axis meets the plane well inside their range, and that a seabed so strong should show in,
  /// that have an echo there. Where the record ends soon behind the seabed few do: then a fan beyond counts as well, if
  /// (almost) all its beams see the plane.
  [[nodiscard]] double coverage(const SeabedPlane& plane) const {
    std::vector<bool> sees(sv_.shape().rows(), false);
    for (const SeabedEcho& echo : echoes_) {
      if (is_of(echo, plane)) sees[static_cast<std::size_t>(echo.row)] = true;
    }
    const double strength = strength_db(plane);
    const double reach = SeabedParams::reach_share * sector_.range().range_m(sv_.shape().samples - 1);
    const auto beams = static_cast<std::size_t>(sector_.beams());
    int expected = 0;
    int seen = 0;
    for (std::size_t first = 0; first < sees.size(); first += beams) {
      const auto fan = sees.begin() + static_cast<std::ptrdiff_t>(first);
      const auto seeing = std::count(fan, fan + sector_.beams(), true);
      const bool whole = static_cast<double>(seeing) >= SeabedParams::whole_fan_share * sector_.beams();
      for (std::size_t row = first; row < first + beams; ++row) {
        const Point<Sonar> u = axis(static_cast<int>(row));
        if (u.z < SeabedParams::min_dip || (plane.range(u) > reach && !(whole && sees[row]))) continue;
        if (!sees[row] && !visible(plane, static_cast<int>(row), strength)) continue;
        ++expected;
        if (sees[row]) ++seen;
      }
    }
    return expected >= params_.min_inliers ? static_cast<double>(seen) / expected : 0.0;
  }

  void bounds(const SeabedPlane& plane, Seabed& seabed) const {
    seabed.min_x = seabed.min_y = std::numeric_limits<double>::infinity();
    seabed.max_x = seabed.max_y = -std::numeric_limits<double>::infinity();
    for (const SeabedEcho& echo : echoes_) {
      if (!is_of(echo, plane)) continue;
      seabed.min_x = std::min(seabed.min_x, echo.place.x);
      seabed.max_x = std::max(seabed.max_x, echo.place.x);
      seabed.min_y = std::min(seabed.min_y, echo.place.y);
      seabed.max_y = std::max(seabed.max_y, echo.place.y);
    }
  }

  /// Where along a beam the plane is expected: flat beams see it loudest by their lower edge, where it is nearer and
  /// steeper.
  struct Expected {
    double loudest_m = std::numeric_limits<double>::infinity();
    double first_m = std::numeric_limits<double>::infinity();  ///< as loud as the onset
  };
  [[nodiscard]] Expected expected(const SeabedPlane& plane, double strength_db, int row, double width_rad) const {
    constexpr int kSteps = 24;
    Expected out;
    double best_db = -std::numeric_limits<double>::infinity();
    for (int k = 0; k <= kSteps; ++k) {
      const double off_rad = SeabedParams::edge_widths * width_rad * k / kSteps;
      const Point<Sonar> u = axis(row, off_rad);
      const double range_m = plane.range(u);
      if (!std::isfinite(range_m)) continue;
      const double off_widths = off_rad / width_rad;
      const double level_db =
          strength_db + plane.lambert_db(u, range_m) - 4.0 * kTwoWayHalfPower_db * off_widths * off_widths;
      if (level_db > best_db) {
        best_db = level_db;
        out.loudest_m = range_m;
      }
      if (level_db >= SeabedParams::onset_db) out.first_m = range_m;  // later ones are nearer
    }
    return out;
  }

  /// First sample of the seabed in a beam: from the axis' meeting point back along the echo, but not nearer than the
  /// beam's lower edge could see it, and the margin before that.
  [[nodiscard]] int onset(const SeabedPlane& plane, double strength_db, int row) const {
    const auto r = static_cast<std::size_t>(row);
    const int samples = sv_.shape().samples;
    const double width = rad_from_deg(r < width_deg_.size() ? width_deg_[r] : SeabedParams::unknown_width_deg);
    const RangeAxis& axis_m = sector_.range();
    const double nearest_m = plane.range(axis(row, SeabedParams::edge_widths * width));
    const double on_axis_m = plane.range(axis(row));
    if (!(nearest_m <= axis_m.range_m(samples - 1))) return samples;
    const double last_m = axis_m.range_m(samples - 1);
    const Expected expect = expected(plane, strength_db, row, width);
    const int from = static_cast<int>(axis_m.sample_at(std::min(expect.loudest_m, last_m)));
    const int to = std::max(0, static_cast<int>(axis_m.sample_at(nearest_m)));
    const auto counts = sv_.row(row);
    const int level = static_cast<int>(std::lround(counts_from_db(SeabedParams::onset_db)));
    const int gap = std::max(1, static_cast<int>(SeabedParams::onset_gap_m / axis_m.spacing_m));
    int first = on_axis_m <= last_m ? static_cast<int>(axis_m.sample_at(on_axis_m)) : samples;
    for (int s = std::min(from, samples - 1), quiet = 0; s >= to && quiet <= gap; --s) {
      const bool loud = counts[static_cast<std::size_t>(s)] >= level;
      if (loud) first = s;
      quiet = loud ? 0 : quiet + 1;
    }
    // speckle hides parts of the beam-edge echo, and schools must not be made of the rest
    if (expect.first_m <= last_m) first = std::min(first, static_cast<int>(axis_m.sample_at(expect.first_m)));
    if (first >= samples) return samples;
    return std::max(0, first - static_cast<int>(std::ceil(params_.margin_m / axis_m.spacing_m)));
  }

  /// Of the seabed about the plane: spread of the depths of each beam's echo that is nearest to it.
  [[nodiscard]] double roughness_m(const SeabedPlane& plane) const {
    std::vector<double> nearest;
    int row = -1;
    for (const SeabedEcho& echo : echoes_) {
      const double off_m = std::abs(plane.z(echo.place.x, echo.place.y) - echo.place.z);
      if (echo.row != row) nearest.push_back(off_m);
      if (off_m < nearest.back()) nearest.back() = off_m;
      row = echo.row;
    }
    constexpr double kOneSigma = 0.6827;
    const auto last = static_cast<double>(nearest.size() - 1);
    const auto rank = nearest.begin() + static_cast<std::ptrdiff_t>(kOneSigma * last);
    std::nth_element(nearest.begin(), rank, nearest.end());
    return *rank;
  }

  /// From where on a beam's axis is within the margin of the plane.
  [[nodiscard]] int seabed_sample(const SeabedPlane& plane, int row) const {
    const Point<Sonar> u = axis(row);
    const double range_m = plane.range(u);
    const double steep = u.z - plane.slope_x * u.x - plane.slope_y * u.y;
    if (!std::isfinite(range_m) || !(steep > 0.0)) return sv_.shape().samples;
    const double sample = sector_.range().sample_at(range_m - params_.margin_m / steep);
    return static_cast<int>(std::clamp(sample, 0.0, static_cast<double>(sv_.shape().samples)));
  }

  const SeabedWater& water_;
  View3<const std::int16_t> sv_;
  const Sector& sector_;
  BeamAxes axes_;
  const std::vector<double>& width_deg_;
  const SeabedParams& params_;
  std::vector<SeabedEcho> long_;    ///< of all beams
  std::vector<SeabedEcho> echoes_;  ///< that may be the seabed
};

}  // namespace

Seabed find_seabed(View3<const std::int16_t> sv, View3<const SampleFlags> flags, const Background& background,
                   const Sector& sector, const std::vector<double>& vertical_width_deg, const SeabedParams& params) {
  SONAR_CHECK(sv.shape() == flags.shape());
  if (!params.enabled) {
    Seabed none;
    none.first_sample.assign(sv.shape().rows(), sv.shape().samples);
    return none;
  }
  const SeabedWater water{sv, flags, background, sector, params};
  return SeabedFinder(water, vertical_width_deg).find();
}

namespace {

void flag_from(const std::vector<std::int32_t>& first_sample, View3<SampleFlags> flags) {
  SONAR_CHECK(first_sample.size() == flags.shape().rows());
  for (int row = 0; row < static_cast<int>(flags.shape().rows()); ++row) {
    const auto samples = flags.row(row);
    for (auto s = static_cast<std::size_t>(first_sample[static_cast<std::size_t>(row)]); s < samples.size(); ++s) {
      if (!any(samples[s] & SampleFlags::dropout)) samples[s] |= SampleFlags::seabed;
    }
  }
}

}  // namespace

void flag_seabed(const Seabed& seabed, View3<SampleFlags> flags) {
  if (seabed.found) flag_from(seabed.heard_sample.empty() ? seabed.first_sample : seabed.heard_sample, flags);
}

void flag_seabed_itself(const Seabed& seabed, View3<SampleFlags> flags) {
  if (seabed.found) flag_from(seabed.first_sample, flags);
}

double bottom_depth_m(const Seabed& seabed, const Point<Sonar>& place, const Placement& placement, double beyond_share,
                      double beyond_m) {
  if (!seabed.found) return kUnknown;
  const double beyond_x = beyond_share * (seabed.max_x - seabed.min_x) + beyond_m;
  const double beyond_y = beyond_share * (seabed.max_y - seabed.min_y) + beyond_m;
  if (place.x < seabed.min_x - beyond_x || place.x > seabed.max_x + beyond_x) return kUnknown;
  if (place.y < seabed.min_y - beyond_y || place.y > seabed.max_y + beyond_y) return kUnknown;
  return placement.transducer_depth_m + seabed.offset_m + seabed.slope_x * place.x + seabed.slope_y * place.y;
}

}  // namespace sonar
