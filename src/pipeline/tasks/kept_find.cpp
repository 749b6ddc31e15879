// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tasks/kept_find.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <system_error>
#include <variant>
#include <vector>

#include "base/hash.h"
#include "io/product_file.h"
#include "pipeline/commands/command.h"
#include "pipeline/journal/earlier.h"
#include "pipeline/tasks/plan.h"
#include "pipeline/tasks/run.h"

namespace sonar {
namespace {

/// Whether lines say more of an observation, in which schools are looked for, than that.
bool decides(const ReadJournal& journal, const std::vector<TimeNs>& times) {
  return std::ranges::any_of(journal.lines(), [&](const ReadLine& read) {
    if (read.act && std::holds_alternative<DetectCommand>(read.act->command)) return false;
    return std::ranges::any_of(times_of(read), [&](const TimeSpan& span) {
      return !times.empty() && span.first <= times.back() && span.last >= times.front();
    });
  });
}

void forget_find(const std::filesystem::path& file) {
  if (!require_own_folder(file.parent_path())) return;
  std::error_code absent;
  std::filesystem::remove(file, absent);
  std::filesystem::remove(file.parent_path(), absent);  // if that was the last
}

/// Between the key of a plan and that of masks.
constexpr char kMasksKept = '-';

}  // namespace

std::optional<Recipe> recipe_of_find(const SurveyFiles& survey, const ObservationFiles& observation, Recipe recipe,
                                     const ReadJournal& journal) {
  const std::vector<TimeNs> times = datagram_times(survey, observation);
  recipe.automatic |= asks_for_detection(journal.lines(), times);
  if (!recipe.automatic || !observation.grid || !decides(journal, times)) return std::nullopt;
  return recipe;
}

Result<void> keep_find(const SurveyFiles& survey, const ObservationFiles& observation,
                       const std::optional<Recipe>& recipe, ObserveOptions options, const std::filesystem::path& out,
                       Work& work) {
  const std::filesystem::path file = found_path(out, observation.name);
  if (!recipe) {
    forget_find(file);
    return {};
  }
  options.journal = {};
  const auto there = read_product_key(file);
  if (there && there->input_hash == observation_key(survey, observation, *recipe, options)) return {};
  const auto found = observe(survey, observation, *recipe, options, work);
  if (!found) return pass_on(found);
  return write_product(*found, file, Beside::own_folder);
}

Result<void> remeasure_find(const SurveyFiles& survey, const ObservationFiles& observation, const Recipe& recipe,
                            ObserveOptions options, const std::filesystem::path& out, Work& work) {
  options.journal = {};
  const std::filesystem::path file = found_path(out, observation.name);
  const auto before = read_product(file);
  if (!before || !has_pings(*before, source_of(observation), datagram_times(survey, observation))) return {};
  Recipe looked = recipe;
  looked.automatic = true;
  const std::string found = observation_key(survey, observation, looked, options);
  const std::string key = remeasured_key(found, *before);
  if (before->input_hash == found || before->input_hash == key) return {};
  auto made = remeasure(survey, observation, *before, looked, options, work);
  if (!made) return pass_on(made);
  made->input_hash = key;
  return write_product(*made, file, Beside::own_folder);
}

std::string remeasured_key(const std::string& key, const ObservationProduct& before) {
  Hasher hasher;
  for (const SchoolMask& mask : before.masks) {
    hasher.add(fmt::format("{} {} ", mask.school_id, mask.ping_index));
    hasher.add(std::as_bytes(std::span(mask.mask.runs)));
    hasher.add(std::as_bytes(std::span(mask.mask.confidence)));
  }
  return key + kMasksKept + to_hex(hasher.value());
}

bool is_remeasured(const ObservationProduct& product) {
  return product.input_hash.find(kMasksKept) != std::string::npos;
}

}  // namespace sonar
