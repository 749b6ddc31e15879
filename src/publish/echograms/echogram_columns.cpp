// SPDX-License-Identifier: Apache-2.0
#include "publish/echograms/echogram_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/units.h"
#include "geo/shells.h"
#include "pipeline/stages/channel_sv.h"
#include "pipeline/stages/weak_samples.h"
#include "publish/reports/sample_looks.h"

namespace sonar {
namespace {

constexpr double kHz = 1000.0;

const ChannelTransmit* settings_of(const ObservationFiles& observation, int channel) {
  const auto index = static_cast<std::size_t>(channel);
  if (index >= observation.transmit.size() || !observation.transmit[index].seen()) return nullptr;
  return &observation.transmit[index];
}

double frequency_khz(const ObservationFiles& observation, int channel) {
  if (const ChannelTransmit* settings = settings_of(observation, channel)) return settings->frequency_hz / kHz;
  return observation.config.beams[static_cast<std::size_t>(channel)].frequency_hz / kHz;
}

std::string channels_there(const ObservationFiles& observation) {
  constexpr std::size_t kNamed = 12;
  const std::size_t count = observation.config.beams.size();
  std::string out;
  for (std::size_t c = 0; c < std::min(count, kNamed); ++c) {
    const double khz = frequency_khz(observation, static_cast<int>(c));
    out += fmt::format("{}{} ({:g} kHz)", out.empty() ? "" : ", ", c + 1, khz);
  }
  return count > kNamed ? fmt::format("{} and more, up to {}", out, count) : out;
}

std::optional<double> number_of(std::string_view text) {
  double value = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

EchogramSamples echogram_samples(const DisplayParams& display) {
  EchogramSamples out;
  out.filtered = display.filtered;
  out.put_back = put_back(display);
  if (display.removed != NoiseLook::shown) {
    out.hidden = static_cast<SampleFlags>(static_cast<unsigned>(kNotFiltered) & ~static_cast<unsigned>(out.put_back));
  }
  return out;
}

std::vector<EchogramCell> echogram_column(const StagedPing& ping, const Sector& sector, const Placement& placement,
                                          const EchogramOf& of, const EchogramSamples& shown,
                                          const EchogramRange& range) {
  const std::vector<EchogramRow> rows = echogram_rows(sector, placement, of);
  const auto flags = static_cast<const Volume&>(*ping.filtered).flags.view();
  if (shown.filtered && any(shown.put_back)) {
    const Array3<std::int16_t> restored = counts_put_back(ping, shown.put_back);
    return echogram_column(sector, restored.view(), flags, shown.hidden, rows, range);
  }
  const Volume& volume = shown.filtered ? *ping.filtered : ping.sv;
  return echogram_column(sector, volume.counts.view(), flags, shown.hidden, rows, range);
}

std::string echogram_text(const Sector& sector, std::span<const double> frequency_hz, const EchogramOf& of) {
  if (!of.fan) return "all beams";
  const auto fan = static_cast<std::size_t>(*of.fan);
  const std::string frequency =
      fan < frequency_hz.size() ? fmt::format("{:.1f} kHz, ", frequency_hz[fan] / kHz) : std::string();
  const std::string place =
      fmt::format("{}elevation {:.1f} deg", frequency, deg_from_rad(sector.elevation_rad(*of.fan)));
  if (!of.beam) return fmt::format("fan {}, mean of its {} beams: {}", *of.fan, sector.beams(), place);
  return fmt::format("beam {} of fan {}: {}, azimuth {:.1f} deg from the bow", *of.beam, *of.fan, place,
                     wrap_360(deg_from_rad(sector.azimuth_rad(*of.beam))));
}

Result<int> named_channel(const ObservationFiles& observation, std::string_view name) {
  const auto count = static_cast<int>(observation.config.beams.size());
  if (count == 0) return fail(ErrorCode::unsupported, observation.name + " has no channels to draw");
  if (name.empty()) return 0;
  std::string_view digits = name;
  const bool told_khz = digits.ends_with("kHz");
  if (told_khz) digits.remove_suffix(3);
  while (digits.ends_with(' ')) digits.remove_suffix(1);
  if (const auto value = number_of(digits)) {
    if (!told_khz && *value == std::floor(*value) && *value >= 1.0 && *value <= count) {
      return static_cast<int>(*value) - 1;
    }
    for (int channel = 0; channel < count; ++channel) {
      const double khz = frequency_khz(observation, channel);
      // As people say it: 38 kHz may be 37.878 in the file.
      if (std::abs(khz - *value) <= std::max(0.5, 0.01 * *value)) return channel;
    }
  }
  return fail(ErrorCode::usage, fmt::format("no channel {} in {}: expected a number or a frequency in kHz of {}", name,
                                            observation.name, channels_there(observation)));
}

std::string channel_text(const ObservationFiles& observation, int channel) {
  return fmt::format("channel {} of {}: {:g} kHz", channel + 1, observation.config.beams.size(),
                     frequency_khz(observation, channel));
}

ChannelEchogram::ChannelEchogram(const SurveyFiles& survey, const ObservationFiles& observation, const Recipe& recipe,
                                 int channel, EchogramHeight height)
    : survey_(survey), observation_(observation), recipe_(recipe), channel_(channel), height_(height) {
  const auto index = static_cast<std::size_t>(channel);
  RangeAxis first;
  double bin_m = 0.0;
  double deepest_m = 0.0;
  for (std::size_t i = 0; i < observation.pings.size(); ++i) {
    for (const SurveyPing& part : survey.parts(observation.pings[i])) {
      const TransmitSet& set = survey.transmit(part);
      if (index >= set.size() || !set[index].seen()) continue;
      const RangeAxis range = channel_range(observation, recipe.survey, set[index], set[index].max_samples);
      if (!(range.spacing_m > 0.0)) continue;
      if (bin_m == 0.0) first = range;
      bin_m = std::max(bin_m, range.spacing_m);
      deepest_m = std::max(deepest_m, range.range_m(range.count - 0.5) + offset_m(static_cast<std::int64_t>(i)));
    }
  }
  if (bin_m == 0.0) return;  // the channel was never seen: one bin a metre, all of them empty
  const Sector along({-1.0}, {0.0}, first);
  range_ = echogram_range(along, {}, {0, 0, EchogramHeight::range});
  if (height == EchogramHeight::depth) range_.first_m = 0.0;
  const double length_m = std::max(bin_m, deepest_m - range_.first_m);
  const int bins = std::max(1, static_cast<int>(std::ceil(length_m / bin_m - 1e-6)));
  range_.bins = std::min(bins, kMostBeamBins);
  range_.bin_m = bins > range_.bins ? length_m / range_.bins : bin_m;
}

double ChannelEchogram::offset_m(std::int64_t ping_index) const {
  if (height_ == EchogramHeight::range) return 0.0;
  return observation_.navigation[static_cast<std::size_t>(ping_index)].transducer_depth_m;
}

Result<std::vector<EchogramCell>> ChannelEchogram::column(std::int64_t ping_index) const {
  const auto sv = load_channel_sv(survey_, observation_, static_cast<std::size_t>(ping_index), channel_, recipe_);
  if (!sv) return pass_on(sv);
  if (sv->counts.empty()) return std::vector<EchogramCell>{};
  EchogramColumn column(range_, static_cast<int>(sv->counts.size()));
  const std::vector<double> shells = shells_m3_per_sr(sv->range);
  const std::vector<SampleFlags> flags(sv->counts.size(), SampleFlags::none);
  column.lay(sv->range.first_m + offset_m(ping_index), sv->range.spacing_m);
  column.add({sv->counts, flags, shells}, SampleFlags::none);
  return column.cells();
}

}  // namespace sonar
