// SPDX-License-Identifier: Apache-2.0
#include "signal/point_echo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/middle.h"
#include "base/units.h"

namespace sonar {
namespace {

constexpr int kGap = 2;      ///< samples between the window and those that tell the noise
constexpr int kBeside = 10;  ///< of these on either side
constexpr std::size_t kLeastInGroup = 5;
constexpr double kErrorOfMiddle = 1.2533;  ///< over that of a mean

/// The middle, and its standard error by the middle deviation: one echo beside another's does not count.
EchoTop top_of(std::vector<double> shares_db) {
  if (shares_db.empty()) return {};
  const double share_db = middle_of(shares_db);
  for (double& share : shares_db) share = std::abs(share - share_db);
  const double n = static_cast<double>(shares_db.size());
  return {share_db, kErrorOfMiddle * kStandardOverMiddleDeviation * middle_of(shares_db) / std::sqrt(n),
          static_cast<int>(shares_db.size())};
}

/// Sums over a group, to take its mean off.
struct GroupSums {
  double n = 0.0, u = 0.0, uu = 0.0, y = 0.0;
};

struct PulseForm {
  double b = 0.0;
  double c = 0.0;
  [[nodiscard]] double top_db(const OffTop& e) const {
    return e.share_db - b * std::abs(e.off_samples) - c * e.off_samples * e.off_samples;
  }
};

/// By least squares over what differs within groups; held near nothing where the echoes all lie alike.
PulseForm form_of(std::span<const OffTop> echoes, std::size_t groups) {
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
  return {(bb * ga - ab * gb) / det, (aa * gb - ab * ga) / det};
}

std::vector<EchoTop> tops_of(std::span<const OffTop> echoes, const PulseForm& form, std::size_t groups) {
  std::vector<std::vector<double>> tops(groups + 1);  // the last: of all
  for (const OffTop& e : echoes) {
    tops[e.group].push_back(form.top_db(e));
    tops[groups].push_back(form.top_db(e));
  }
  const EchoTop all = top_of(tops[groups]);
  std::vector<EchoTop> out;
  for (std::size_t g = 0; g < groups; ++g) {
    out.push_back(tops[g].size() >= kLeastInGroup ? top_of(tops[g]) : all);
    out.back().echoes = static_cast<int>(tops[g].size());
  }
  return out;
}

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
    echo.noise_w = middle_of(std::move(beside)) / std::numbers::ln2;
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
  constexpr int kRounds = 4;
  constexpr double kFar = 4.0;  // standard deviations: another echo overlaps
  std::vector<OffTop> sound(echoes.begin(), echoes.end());
  std::vector<EchoTop> tops;
  for (int round = 0; round < kRounds; ++round) {
    const PulseForm form = form_of(sound, groups);
    tops = tops_of(sound, form, groups);
    std::vector<double> off;
    for (const OffTop& e : sound) off.push_back(std::abs(form.top_db(e) - tops[e.group].share_db));
    if (off.empty()) break;
    const double spread_db = middle_of(std::move(off));
    std::erase_if(sound, [&](const OffTop& e) {
      return std::abs(form.top_db(e) - tops[e.group].share_db) > kFar * kStandardOverMiddleDeviation * spread_db;
    });
  }
  return tops;
}

}  // namespace sonar
