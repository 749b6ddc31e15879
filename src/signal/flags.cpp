// SPDX-License-Identifier: Apache-2.0
#include "signal/flags.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/check.h"
#include "base/units.h"
#include "signal/beam_overlap.h"
#include "signal/block_levels.h"
#include "signal/flag_steps.h"

namespace sonar {

namespace {

/// First sample at or beyond a range, 0..samples.
int first_sample_at(const PingGeometry& geometry, double range_m, int samples) {
  const double at = std::ceil((range_m - geometry.first_range_m) / geometry.spacing_m - 1e-9);
  return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(samples)));
}

bool has_range_axis(const PingGeometry& geometry) {
  return std::isfinite(geometry.first_range_m) && std::isfinite(geometry.spacing_m) && geometry.spacing_m > 0.0;
}

void flag_samples(std::span<SampleFlags> row, int begin, int end, SampleFlags flag) {
  for (int i = std::max(begin, 0); i < std::min(end, static_cast<int>(row.size())); ++i) {
    row[static_cast<std::size_t>(i)] |= flag;
  }
}

/// The topmost fans, never all of them: a lone fan is no surface fan.
std::vector<int> top_fans(const PingGeometry& geometry, int fans, int wanted) {
  if (wanted >= fans) return {};
  std::vector<int> order(static_cast<std::size_t>(fans));
  for (int fan = 0; fan < fans; ++fan) order[static_cast<std::size_t>(fan)] = fan;
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return geometry.elevation_deg[static_cast<std::size_t>(a)] > geometry.elevation_deg[static_cast<std::size_t>(b)];
  });
  order.resize(static_cast<std::size_t>(wanted));
  return order;
}

/// Range where a beam's upper edge comes within the margin of the surface; infinite where it never does.
double surface_range_m(double elevation_deg, double width_deg, double clear_m) {
  const double edge_deg = std::min(elevation_deg + 0.5 * width_deg, 90.0);
  if (!(edge_deg > 0.0)) return std::numeric_limits<double>::infinity();
  return std::max(clear_m, 0.0) / std::sin(rad_from_deg(edge_deg));
}

}  // namespace

void flag_near_field(const PingGeometry& geometry, const NearFieldParams& params, View3<SampleFlags> flags) {
  if (!params.enabled || !has_range_axis(geometry)) return;
  const Shape3 shape = flags.shape();
  const int end = first_sample_at(geometry, params.range_m, shape.samples);
  for (int row = 0; row < static_cast<int>(shape.rows()); ++row) {
    flag_samples(flags.row(row), 0, end, SampleFlags::near_field);
  }
}

namespace {

/// No recipe makes air into water: what has its centre above the water line is flagged whatever the parameters say.
void flag_air(const PingGeometry& geometry, View3<SampleFlags> flags) {
  if (!has_range_axis(geometry) || !std::isfinite(geometry.transducer_depth_m)) return;
  const Shape3 shape = flags.shape();
  for (int row = 0; row < static_cast<int>(shape.rows()); ++row) {
    const double up = std::sin(rad_from_deg(geometry.elevation_deg_of(row / shape.beams, row)));
    if (!(up > 0.0)) continue;
    const double line = (geometry.transducer_depth_m / up - geometry.first_range_m) / geometry.spacing_m;
    const int first = static_cast<int>(std::clamp(std::floor(line) + 1.0, 0.0, static_cast<double>(shape.samples)));
    flag_samples(flags.row(row), first, shape.samples, SampleFlags::surface);
  }
}

}  // namespace

void flag_surface(const PingGeometry& geometry, const SurfaceParams& params, View3<SampleFlags> flags) {
  const Shape3 shape = flags.shape();
  const auto& elevation_deg = geometry.elevation_deg;
  if (elevation_deg.size() != static_cast<std::size_t>(shape.fans)) return;
  const auto unknown = [](double e) { return !std::isfinite(e); };
  if (std::any_of(elevation_deg.begin(), elevation_deg.end(), unknown)) return;
  const auto& level_deg = geometry.level_elevation_deg;
  if (!level_deg.empty() && level_deg.size() != shape.rows()) return;
  if (std::any_of(level_deg.begin(), level_deg.end(), unknown)) return;
  flag_air(geometry, flags);
  if (!params.enabled) return;
  if (params.mode == SurfaceMode::fan) {
    for (const int fan : top_fans(geometry, shape.fans, params.fans)) {
      for (int beam = 0; beam < shape.beams; ++beam) {
        flag_samples(flags.row(fan, beam), 0, shape.samples, SampleFlags::surface);
      }
    }
    return;
  }
  if (!has_range_axis(geometry) || !std::isfinite(geometry.transducer_depth_m)) return;
  const double clear_m = geometry.transducer_depth_m - params.margin_m;
  for (int row = 0; row < static_cast<int>(shape.rows()); ++row) {
    const auto index = static_cast<std::size_t>(row);
    double width_deg = index < geometry.vertical_width_deg.size() ? geometry.vertical_width_deg[index] : 0.0;
    if (!std::isfinite(width_deg)) width_deg = 0.0;
    const double range_m = surface_range_m(geometry.elevation_deg_of(row / shape.beams, row), width_deg, clear_m);
    flag_samples(flags.row(row), first_sample_at(geometry, range_m, shape.samples), shape.samples,
                 SampleFlags::surface);
  }
}

namespace {

/// The steps of flag_ping(); two of them look at the same levels, which are worked out where the first needs them.
class FlagSteps {
 public:
  FlagSteps(View3<const std::int16_t> power, const PingGeometry& geometry, const FlagParams& params,
            const NeighbourPings& neighbours, View3<SampleFlags> flags)
      : power_(power), geometry_(geometry), params_(params), neighbours_(neighbours), flags_(flags) {}

  void take(SampleFlags reason) {
    switch (reason) {
      case SampleFlags::near_field:
        return flag_near_field(geometry_, params_.near_field, flags_);
      case SampleFlags::surface:
        return flag_surface(geometry_, params_.surface, flags_);
      case SampleFlags::dropout:
        return flag_dropouts(power_, params_.dropouts, flags_);
      case SampleFlags::corrupted:
        if (params_.corrupted_packets.enabled || params_.interference.enabled) {
          levels_.emplace(power_, flags_, params_.corrupted_packets);
          flag_corrupted_packets(power_, *levels_, params_.corrupted_packets,
                                 fan_losses_db(geometry_.elevation_deg, geometry_.vertical_width_deg), flags_);
        }
        return;
      case SampleFlags::interference:
        if (levels_) flag_interference(power_, *levels_, params_.interference, flags_);
        return;
      default:
        return flag_impulses(power_, neighbours_, params_.impulse_noise, flags_);
    }
  }

 private:
  View3<const std::int16_t> power_;
  const PingGeometry& geometry_;
  const FlagParams& params_;
  const NeighbourPings& neighbours_;
  View3<SampleFlags> flags_;
  std::optional<BlockLevels> levels_;
};

}  // namespace

void flag_ping(View3<const std::int16_t> power, const PingGeometry& geometry, const FlagParams& params,
               const NeighbourPings& neighbours, View3<SampleFlags> flags) {
  SONAR_CHECK(power.shape() == flags.shape());
  FlagSteps steps(power, geometry, params, neighbours, flags);
  for (const SampleFlags reason : kFlagSteps) steps.take(reason);
}

}  // namespace sonar
