// SPDX-License-Identifier: Apache-2.0
#include "signal/point_echo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/units.h"

namespace sonar {
namespace {

constexpr int kGap = 2;      ///< samples between the window and those that tell the noise
constexpr int kBeside = 10;  ///< of these on either side
constexpr int kLeastInGroup = 5;

/// Sums over a group, to take its mean off.
struct GroupSums {
  double n = 0.0, u = 0.0, uu = 0.0, y = 0.0;
};

}  // namespace

PointEcho point_echo(std::span<const std::int16_t> counts, int around, int half_width) {
  const int size = static_cast<int>(counts.size());
  const int begin = around - half_width;
  const int end = around + half_width + 1;
  PointEcho echo;
  if (begin < 0 || end > size) return echo;
  std::vector<double> beside;
  const auto power = [&](int i) { return linear_from_count(counts[static_cast<std::size_t>(i)]); };
  for (int i = std::max(0, begin - kGap - kBeside); i < begin - kGap; ++i) beside.push_back(power(i));
  for (int i = end + kGap; i < std::min(size, end + kGap + kBeside); ++i) beside.push_back(power(i));
  if (!beside.empty()) {
    const auto middle = beside.begin() + static_cast<std::ptrdiff_t>(beside.size() / 2);
    std::nth_element(beside.begin(), middle, beside.end());
    echo.noise_w = *middle / std::numbers::ln2;
  }
  double moment = 0.0;
  for (int i = begin; i < end; ++i) {
    const double w = power(i) - echo.noise_w;
    echo.sum_w += w;
    moment += w * i;
  }
  if (!(echo.sum_w > 0.0)) return echo;
  echo.centre_sample = std::clamp(moment / echo.sum_w, static_cast<double>(begin), end - 1.0);
  const double nearest = power(static_cast<int>(std::lround(echo.centre_sample))) - echo.noise_w;
  echo.nearest_share_db = nearest > 0.0 ? db_from_linear(nearest / echo.sum_w) : -100.0;
  return echo;
}

std::vector<EchoTop> echo_tops(std::span<const OffTop> echoes, std::size_t groups) {
  // b and c by least squares over what differs within groups, held near nothing where the echoes all lie alike.
  std::vector<GroupSums> sums(groups);
  for (const OffTop& e : echoes) {
    GroupSums& s = sums[e.group];
    const double u = std::abs(e.off_samples);
    s.n += 1.0;
    s.u += u;
    s.uu += u * u;
    s.y += e.share_db;
  }
  constexpr double kHeld = 1e-3;
  double aa = kHeld, ab = 0.0, bb = kHeld, ga = 0.0, gb = 0.0;
  for (const OffTop& e : echoes) {
    const GroupSums& s = sums[e.group];
    const double u = std::abs(e.off_samples) - s.u / s.n;
    const double uu = e.off_samples * e.off_samples - s.uu / s.n;
    const double y = e.share_db - s.y / s.n;
    aa += u * u;
    ab += u * uu;
    bb += uu * uu;
    ga += u * y;
    gb += uu * y;
  }
  const double det = aa * bb - ab * ab;
  const double b = (bb * ga - ab * gb) / det;
  const double c = (aa * gb - ab * ga) / det;
  double squares = 0.0;
  double sum = 0.0;
  const auto at_top = [&](const OffTop& e) {
    return e.share_db - b * std::abs(e.off_samples) - c * e.off_samples * e.off_samples;
  };
  std::vector<double> tops(groups);
  for (const OffTop& e : echoes) {
    tops[e.group] += at_top(e) / sums[e.group].n;
    sum += at_top(e);
  }
  for (const OffTop& e : echoes) squares += std::pow(at_top(e) - tops[e.group], 2);
  const auto all = static_cast<double>(echoes.size());
  const double spread = all > 1.0 ? std::sqrt(squares / (all - 1.0)) : 0.0;
  std::vector<EchoTop> out(groups);
  for (std::size_t g = 0; g < groups && all > 0.0; ++g) {
    const bool own = sums[g].n >= kLeastInGroup;
    out[g] = {own ? tops[g] : sum / all, spread / std::sqrt(own ? sums[g].n : all), static_cast<int>(sums[g].n)};
  }
  return out;
}

}  // namespace sonar
