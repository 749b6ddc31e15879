// SPDX-License-Identifier: Apache-2.0
#include "publish/noise_steps_picture.h"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "publish/reports/sample_looks.h"
#include "publish/slice_pictures.h"
#include "publish/volumes/drawn_schools.h"
#include "view/axes.h"

namespace sonar {
namespace {

/// "takes out 0.4 % of ping", "and 1.2 % of slice": short lines, for a fifth of a picture's width.
void add_shares(std::vector<std::string>& words, const std::string& does, std::int64_t NoiseEffect::*what,
                const NoiseEffect& ping, const NoiseEffect& slice) {
  const auto share = [&](const NoiseEffect& of) {
    if (of.*what == 0) return std::string("0 %");
    const double percent =
        100.0 * static_cast<double>(of.*what) / static_cast<double>(std::max<std::int64_t>(1, of.recorded));
    return percent < 0.01 ? std::string("< 0.01 %") : fmt::format("{:.{}f} %", percent, percent < 1.0 ? 2 : 1);
  };
  words.push_back(fmt::format("{} {} of ping", does, share(ping)));
  if (ping.*what != 0) words.push_back(fmt::format("and {} of slice", share(slice)));
}

std::string decibels(double db) { return (db > 0.0 ? "+" : "") + tick_text(db, 1) + " dB"; }

std::vector<std::string> median_words(const NoiseEffect& ping, const NoiseEffect& slice) {
  std::vector<std::string> words;
  add_shares(words, "changes", &NoiseEffect::changed, ping, slice);
  if (slice.change_db) {
    words.push_back("by " + decibels(*slice.change_db) + " (median)");
  } else if (ping.change_db) {
    words.push_back("by " + decibels(*ping.change_db) + " in the ping (median)");
  }
  if (ping.filled_in > 0) add_shares(words, "fills in", &NoiseEffect::filled_in, ping, slice);
  return words;
}

}  // namespace

std::vector<std::string> noise_effect_words(NoiseStep step, bool on, const NoiseEffect& ping,
                                            const NoiseEffect& slice) {
  if (step == NoiseStep::unfiltered) return {"as recorded, calibrated"};
  std::vector<std::string> words;
  if (!on) words.emplace_back("off in the recipe");
  if (step == NoiseStep::median) {
    if (on) return median_words(ping, slice);
    // Without the filter what was faulty stands in filtered Sv as it was recorded.
    if (ping.filled_in > 0) add_shares(words, "puts back", &NoiseEffect::filled_in, ping, slice);
    return words;
  }
  if (!on && ping.taken_out == 0) return words;
  add_shares(words, on ? "takes out" : "even so out:", &NoiseEffect::taken_out, ping, slice);
  if (step == NoiseStep::background) words.emplace_back("below the noise");
  if (ping.replaced_db) words.push_back("median filter: " + decibels(*ping.replaced_db) + " there");
  return words;
}

SliceStepsData noise_steps_data(const NoiseSteps& steps, const Recipe& recipe, const Sector& sector,
                                const Slice& slice) {
  const std::vector<std::int32_t> in_slice = samples_in(sector, slice);
  SliceStepsData data;
  data.flags = steps.flags();
  for (std::size_t i = 0; i < kNoiseStepNames.size(); ++i) {
    const auto step = static_cast<NoiseStep>(i);
    const bool on = is_on(step, recipe);
    SliceStep& shown = data.steps.emplace_back();
    shown.name = noise_step_words(step);
    shown.words = noise_effect_words(step, on, steps.effect(step), steps.effect(step, in_slice));
    shown.off = !on;
    shown.sv = steps.counts(step);
    shown.taken_out = NoiseSteps::out(step);
  }
  return data;
}

std::optional<std::pair<std::size_t, std::size_t>> compared_steps(const NoiseStepsParams& params) {
  if (params.after == 0 && params.before == 0) return std::nullopt;
  constexpr std::size_t kLast = kNoiseStepNames.size() - 1;
  const std::size_t after = params.after > 0 ? params.after - 1U : kLast;
  const std::size_t before = params.before > 0 ? params.before - 1U : after - std::min<std::size_t>(after, 1);
  return std::pair{before, after};
}

SliceStepsStyle noise_steps_style(const NoiseStepsParams& params, const DisplayParams& display, SvColours colours) {
  const SliceStyle slice = slice_style(display, std::move(colours));
  SliceStepsStyle style;
  style.colours = slice.colours;
  style.masks = slice.masks;
  style.north_up = slice.north_up;
  style.mark = params.mark;
  style.mark_db = params.mark_db;
  style.difference_db = params.difference_db;
  style.compared = compared_steps(params);
  return style;
}

Result<FrameDescription> noise_steps_frame(DrawnObservation& observation, const PictureOptions& options, Work& work) {
  if (!observation.has_raw()) {
    return fail(ErrorCode::not_found,
                "noise steps are of samples: name the raw files of " + observation.name() + " too");
  }
  if (auto known = require_schools(observation, options); !known) return pass_on(known);
  const auto index = chosen_ping(observation, options);
  if (!index) return pass_on(index);
  const auto sector = observation.sector();
  if (!sector) return pass_on(sector);
  const auto ping = observation.ping(*index, work);
  if (!ping) return pass_on(ping);
  const auto slice = chosen_slice(PictureKind::noise_steps, *ping, *sector, options);
  if (!slice) return pass_on(slice);
  const NoiseSteps steps(ping->staged);
  SliceStepsData data = noise_steps_data(steps, observation.engine()->recipe(), *sector, *slice);
  data.masks = mask_layers(*ping, options);
  SliceStepsStyle style = noise_steps_style(options.kind.noise_steps, options.display, colours_of(options));
  style.north_up = style.north_up && seen_from_above(*slice);
  auto picture = slice_steps(*sector, data, titled_ping(observation, *ping), drawn_view(*slice, *ping, options), style,
                             theme_of(options), options.size);
  if (!picture) return pass_on(picture);
  picture->frame.title = observation.title() + ": " + picture->frame.title;
  return std::move(picture->frame);
}

}  // namespace sonar
