// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/engine.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/units.h"
#include "pipeline/stages/placements.h"
#include "pipeline/stages/reduced_ping.h"
#include "school/detect/detect_params.h"
#include "school/detect/thresholder.h"
#include "school/evidence/block_means.h"
#include "school/evidence/null_model.h"
#include "signal/beam_overlap.h"
#include "signal/calibrate.h"
#include "signal/median.h"

namespace sonar {
namespace {

/// Power volumes of neighbouring pings that are kept, 25 of an MS70: enough for a few threads and both neighbours of each.
constexpr std::size_t kPowerBytes = 48U << 20U;
constexpr std::size_t kLeastPower = 3;
/// Stages that are kept from detecting to measuring: most of a short observation. With it a run stays below 600 MB.
constexpr std::size_t kStagedBytes = 200U << 20U;

std::size_t bytes_of(const Volume& volume) {
  return volume.counts.all().size_bytes() + volume.flags.all().size_bytes();
}
std::size_t bytes_of(const StagedPing& ping) {
  return bytes_of(ping.sv) + bytes_of(*ping.filtered) + ping.means.all().size_bytes();
}

/// A sonar whose rows are not calibrated has no Sv there.
void apply_tables(const Array3<std::int16_t>& table, Volume& volume) {
  const int rows = static_cast<int>(volume.counts.shape().rows());
  for (int row = 0; row < rows; ++row) apply_sv_table(volume.counts.view().row(row), table.view().row(row));
}

/// A channel that the sonar equation cannot be worked out for says nothing: its samples count as dropouts.
void flag_uncalibrated(const Array3<std::int16_t>& table, Volume& volume) {
  const int rows = static_cast<int>(volume.flags.shape().rows());
  for (int row = 0; row < rows; ++row) {
    const auto calibration = table.view().row(row);
    if (calibration.empty() || calibration.back() != kNoData) continue;
    for (SampleFlags& flags : volume.flags.view().row(row)) flags |= SampleFlags::dropout;
  }
}

}  // namespace

Engine::Engine(const SurveyFiles& survey, const ObservationFiles& observation, const Recipe& recipe, KnownPings* known)
    : survey_(survey),
      observation_(observation),
      recipe_(recipe),
      grid_(calibrated_grid(*observation.grid, recipe.calibration)),
      figures_(sonar::beam_figures(observation.config, grid_, recipe.calibration)),
      sector_(grid_.sector(observation.range)),
      tables_(observation, recipe.calibration),
      rays_(rays_of(recipe.survey.sound_speed_profile, observation.navigation, observation.range,
                    observation.sound_speed_mps)),
      reckoned_(dead_reckoning(observation.navigation)),
      known_(known),
      levels_(observation.pings.size()),
      background_db_(observation.pings.size()) {
  for (std::size_t i = 0; i < reckoned_.pings.size(); ++i) {
    const Placement recorded = placement(static_cast<std::int64_t>(i));
    reckoned_.pings[i].roll_rad = recorded.roll_rad;
    reckoned_.pings[i].pitch_rad = recorded.pitch_rad;
    reckoned_.pings[i].rays = recorded.rays;
  }
  if (known_ != nullptr) keys_.emplace(survey, observation, recipe);
  const auto voxels = static_cast<std::size_t>(grid().fans()) * static_cast<std::size_t>(grid().beams()) *
                      static_cast<std::size_t>(std::max(1, observation.range.count));
  power_limit_ = std::clamp(kPowerBytes / (voxels * 3), kLeastPower, std::size_t{64});
}

Placement Engine::placement(std::int64_t ping_index) const {
  return placement_under(recipe_, observation_.navigation[static_cast<std::size_t>(ping_index)], rays_);
}

Result<Engine::Power> Engine::power(std::int64_t ping_index) {
  {
    const std::scoped_lock lock(mutex_);
    if (const auto found = power_.find(ping_index); found != power_.end()) return found->second;
  }
  auto loaded = load_volume(survey_, observation_, static_cast<std::size_t>(ping_index));
  if (!loaded) {
    const std::scoped_lock lock(mutex_);
    if (refusal_ && is_of_system(loaded.error().code)) refusal_ = pass_on(loaded);
    return pass_on(loaded);
  }
  auto made = std::make_shared<const PowerVolume>(std::move(*loaded));
  const std::scoped_lock lock(mutex_);
  if (power_.emplace(ping_index, made).second) power_order_.push_back(ping_index);
  if (power_order_.size() > power_limit_) {
    power_.erase(power_order_.front());
    power_order_.erase(power_order_.begin());
  }
  return made;
}

Result<void> Engine::refusal() const {
  const std::scoped_lock lock(mutex_);
  return refusal_;
}

namespace {

/// A ping and so many on either side, as far as there are any; both inclusive.
std::pair<std::int64_t, std::int64_t> round_of(std::int64_t ping_index, std::int64_t side, std::int64_t pings) {
  return {std::max<std::int64_t>(0, ping_index - side), std::min(pings - 1, ping_index + side)};
}

/// [fan][beam] above the horizon of beams that the hull turns; empty where it does not.
std::vector<double> level_elevation_deg(const Sector& sector, const Placement& placement) {
  std::vector<double> level;
  if (placement.roll_rad == 0.0 && placement.pitch_rad == 0.0) return level;
  for (int fan = 0; fan < sector.fans(); ++fan) {
    for (int beam = 0; beam < sector.beams(); ++beam) {
      const Point<Sonar> at = Sector::direction(sector.elevation_rad(fan), sector.azimuth_rad(beam));
      level.push_back(-deg_from_rad(std::asin(std::clamp(levelled_direction(at, placement).z, -1.0, 1.0))));
    }
  }
  return level;
}

}  // namespace

PingGeometry Engine::ping_geometry(std::int64_t ping_index) const {
  PingGeometry geometry;
  geometry.first_range_m = observation_.range.first_m;
  geometry.spacing_m = observation_.range.spacing_m;
  geometry.transducer_depth_m = placement(ping_index).transducer_depth_m;
  geometry.elevation_deg = grid().elevation_deg;
  geometry.vertical_width_deg = grid().vertical_width_deg;
  geometry.level_elevation_deg = level_elevation_deg(sector(), placement(ping_index));
  return geometry;
}

Array3<std::int16_t> Engine::levels_of(const PowerVolume& power) const {
  // Crops alone: interference, corrupted packets and schools are a minority of a beam's far samples, and the median over pings sees to
  // the rest.
  Array3<SampleFlags> flags = power.volume.flags;
  flag_near_field(ping_geometry(0), recipe_.flags.near_field, flags.view());
  return background_levels(power.volume.counts.view(), flags.view(), recipe_.background);
}

KnownPings::Background Engine::background_of(std::int64_t ping_index) {
  if (known_ != nullptr) {
    if (const auto before = known_->backgrounds.find(keys().background(ping_index))) return *before;
  }
  const auto loaded = power(ping_index);
  if (!loaded) return {};
  KnownPings::Background background;
  if (is_reduced((*loaded)->heads)) {
    background.given = reduced_background_db((*loaded)->heads, grid().row_of_channel());
  } else {
    background.levels = levels_of(**loaded);
  }
  if (known_ != nullptr) {
    known_->backgrounds.put(keys().background(ping_index), std::make_shared<KnownPings::Background>(background));
  }
  return background;
}

Result<void> Engine::estimate_background(std::int64_t first, std::int64_t last, Work& work) {
  if (!recipe_.background_window.enabled) return {};
  if (block_gain_.all().empty()) {
    block_gain_ = block_gain(std::as_const(*tables_.of_first_ping()).view(), recipe_.background);
  }
  last = std::min(last, pings() - 1);
  const std::int64_t side = recipe_.background_window.pings_each_side;
  const std::int64_t from = round_of(first, side, pings()).first;
  const std::int64_t to = round_of(last, side, pings()).second;
  std::atomic<std::int64_t> done{0};
  work.for_each(to - from + 1, [&](std::int64_t i) {
    auto& levels = levels_[static_cast<std::size_t>(from + i)];
    auto& given = background_db_[static_cast<std::size_t>(from + i)];
    if (levels.all().empty() && given.empty() && !is_bad(from + i)) {
      KnownPings::Background background = background_of(from + i);
      levels = std::move(background.levels);
      given = std::move(background.given);
    }
    work.progress("background", ++done, to - from + 1);
  });
  if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
  const auto is_known = [&](std::int64_t i) {
    return is_bad(i) || !levels_[static_cast<std::size_t>(i)].all().empty();
  };
  // Worked out once for all who ask; not where a neighbour could not be read, which may be readable the next time.
  work.for_each(last - first + 1, [&](std::int64_t i) {
    auto& of_ping = background_db_[static_cast<std::size_t>(first + i)];
    if (!of_ping.empty()) return;
    bool all_known = true;
    const auto [begin, end] = round_of(first + i, side, pings());
    for (std::int64_t near = begin; near <= end; ++near) all_known &= is_known(near);
    if (!all_known) return;
    if (auto told = background_told_round(first + i); !told.empty()) of_ping = std::move(told);
  });
  if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
  return {};
}

void Engine::give_background(std::int64_t ping_index, std::vector<float> background_db) {
  background_db_[static_cast<std::size_t>(ping_index)] = std::move(background_db);
}

std::vector<float> Engine::background_db(std::int64_t ping_index) const {
  if (!recipe_.background_window.enabled) return {};
  const auto& known = background_db_[static_cast<std::size_t>(ping_index)];
  return known.empty() ? background_told_round(ping_index) : known;
}

std::vector<float> Engine::background_told_round(std::int64_t ping_index) const {
  const auto [from, to] = round_of(ping_index, recipe_.background_window.pings_each_side, pings());
  std::vector<const Array3<std::int16_t>*> window;
  for (std::int64_t i = from; i <= to; ++i) {
    const auto& of_ping = levels_[static_cast<std::size_t>(i)];
    if (!of_ping.all().empty()) window.push_back(&of_ping);
  }
  if (window.empty()) return {};
  Array3<std::int16_t> levels = levels_over_pings(window, recipe_.background);
  const double spread =
      recipe_.background.method == BackgroundMethod::low_quantile
          ? level_spread(window, std::as_const(levels).view(), observation_.range.count, recipe_.background)
          : 0.0;
  const auto& own = levels_[static_cast<std::size_t>(ping_index)];
  if (!own.all().empty()) keep_quieter(own.view(), recipe_.background_window.quiet_db, levels.view());
  const std::vector<double> combined =
      noise_power_db(std::as_const(levels).view(), spread, block_gain_.view(), recipe_.background);
  std::vector<float> rounded(combined.size());
  std::transform(combined.begin(), combined.end(), rounded.begin(), [](double v) { return static_cast<float>(v); });
  return rounded;
}

void Engine::flag(std::int64_t ping_index, const PowerVolume& power, Volume& volume) {
  if (is_reduced(power.heads)) {
    open_reduced(power.heads, grid().row_of_channel(), volume);
    flag_near_field(ping_geometry(ping_index), recipe_.flags.near_field, volume.flags.view());
    flag_surface(ping_geometry(ping_index), recipe_.flags.surface, volume.flags.view());
    return;
  }
  NeighbourPings neighbours;
  Power before;
  Power after;
  if (recipe_.flags.impulse_noise.enabled && ping_index > 0 && !is_bad(ping_index - 1)) {
    if (auto loaded = this->power(ping_index - 1)) before = *loaded;
  }
  if (recipe_.flags.impulse_noise.enabled && ping_index + 1 < pings() && !is_bad(ping_index + 1)) {
    if (auto loaded = this->power(ping_index + 1)) after = *loaded;
  }
  if (before) neighbours.before = before->volume.counts.view();
  if (after) neighbours.after = after->volume.counts.view();
  flag_ping(power.volume.counts.view(), ping_geometry(ping_index), recipe_.flags, neighbours, volume.flags.view());
}

Volume Engine::calibrated(std::int64_t ping_index, const PowerVolume& power, const Array3<std::int16_t>& table) {
  Volume volume = power.volume;
  flag(ping_index, power, volume);
  apply_tables(table, volume);
  if (is_reduced(power.heads)) {
    fill_reduced(volume);
  } else {
    flag_uncalibrated(table, volume);
  }
  return volume;
}

MedianParams Engine::filter_box() const {
  // Where beams hardly overlap, a school's next beam is no second look at it, and a box over beams would take it away.
  return fitted(recipe_.median, grid().elevation_deg, grid().azimuth_deg, grid().vertical_width_deg,
                grid().horizontal_width_deg);
}

WaterLevels Engine::own_water(const StagedPing& ping) const {
  if (ping.water) return *ping.water;
  const WaterPing alone{&ping.means, &ping.seabed, ping.background()};
  return water_levels({&alone, 1}, sector_, kLeastEvidence).front();
}

PingEcho Engine::echo(const StagedPing& ping, const WaterLevels& water) const {
  constexpr int kPeakRows = 9;  // of fewer beams the loudest filtered voxels are fading
  const MedianParams box = filter_box();
  return {std::as_const(ping.filtered->counts).view(),
          std::as_const(ping.sv.counts).view(),
          std::as_const(ping.sv.flags).view(),
          sector_,
          ping.background(),
          ping.seabed,
          water,
          box.kernel_fans * box.kernel_beams >= kPeakRows};
}

Result<StagedPing> Engine::staged(std::int64_t ping_index) {
  const auto loaded = power(ping_index);
  if (!loaded) return pass_on(loaded);
  StagedPing ping;
  ping.ping_index = ping_index;
  ping.calibration = tables_.of((*loaded)->heads);
  ping.sv = calibrated(ping_index, **loaded, *ping.calibration);
  ping.filtered = std::make_shared<Volume>(Volume{Array3<std::int16_t>(ping.sv.counts.shape()), ping.sv.flags});
  median_into(ping.sv.counts.view(), ping.sv.flags.view(), filter_box(), ping.filtered->counts.view());
  for (const float level_db : background_db(ping_index)) {
    ping.background_db.push_back(static_cast<double>(level_db));
  }
  if (is_reduced((*loaded)->heads)) {
    WaterLevels water = reduced_water((*loaded)->heads, ping.sv.counts.shape());
    // files that were reduced earlier do not tell it: then what was left out counts as silent
    if (water.known()) ping.water = std::move(water);
  }
  if (recipe_.seabed.enabled && is_reduced((*loaded)->heads)) {
    ping.seabed = reduced_seabed((*loaded)->heads, grid().row_of_channel(), ping.filtered->counts.shape().samples);
    flag_reduced_seabed((*loaded)->heads, grid().row_of_channel(), ping.sv.flags.view());
    ping.filtered->flags = ping.sv.flags;
    flag_seabed(ping.seabed, ping.filtered->flags.view());
  } else if (recipe_.seabed.enabled) {
    ping.seabed = find_seabed(ping.filtered->counts.view(), ping.filtered->flags.view(), ping.background(), sector_,
                              grid().vertical_width_deg, recipe_.seabed);
    flag_seabed(ping.seabed, ping.filtered->flags.view());
    flag_seabed_itself(ping.seabed, ping.sv.flags.view());
  }
  if (!ping.water) {
    ping.means = block_means(std::as_const(ping.sv.counts).view(), std::as_const(ping.sv.flags).view(),
                             block_samples(sector_.range()));
  }
  return ping;
}

void Engine::keep(std::shared_ptr<const StagedPing> ping) {
  const std::scoped_lock lock(mutex_);
  const std::size_t bytes = bytes_of(*ping);
  if (staged_bytes_ + bytes > kStagedBytes) return;
  if (staged_.emplace(ping->ping_index, std::move(ping)).second) staged_bytes_ += bytes;
}

void Engine::rest() {
  const std::scoped_lock lock(mutex_);
  power_.clear();
  power_order_.clear();
  staged_.clear();
  staged_bytes_ = 0;
}

Result<std::shared_ptr<const StagedPing>> Engine::kept_or_staged(std::int64_t ping_index) {
  {
    const std::scoped_lock lock(mutex_);
    if (const auto found = staged_.find(ping_index); found != staged_.end()) return found->second;
  }
  auto ping = staged(ping_index);
  if (!ping) return pass_on(ping);
  return std::shared_ptr<const StagedPing>(std::make_shared<StagedPing>(std::move(*ping)));
}

FilteredPing Engine::filtered(const StagedPing& ping) const {
  FilteredPing out;
  out.volume = ping.filtered;
  out.placement = tracking_placement(ping.ping_index);
  out.time = observation_.navigation[static_cast<std::size_t>(ping.ping_index)].time;
  out.bad = is_bad(ping.ping_index);
  out.above_background = [this, volume = ping.filtered, table = ping.calibration, noise = ping.background_db,
                          known = ping.water, means = ping.means, seabed = ping.seabed](double margin_db, Above above) {
    const Background background{noise, table->view()};
    const auto runs = [&](const WaterLevels* water) {
      return Thresholder(std::as_const(volume->counts).view(), std::as_const(volume->flags).view(), background, water)
          .above_background(margin_db);
    };
    if (above == Above::noise) return runs(nullptr);
    if (known) return runs(&*known);
    const WaterPing alone{&means, &seabed, background};
    const WaterLevels water = water_levels({&alone, 1}, sector_, kLeastEvidence).front();
    return runs(&water);
  };
  return out;
}

Result<FilteredPing> Engine::filtered(std::int64_t ping_index) {
  const auto ping = staged(ping_index);
  if (!ping) return pass_on(ping);
  return filtered(*ping);
}

}  // namespace sonar
