// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tasks/other_finds.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include "io/product_file.h"
#include "pipeline/commands/command.h"
#include "pipeline/journal/journals.h"
#include "pipeline/stages/observe.h"
#include "pipeline/tasks/kept_find.h"
#include "pipeline/tasks/plan.h"
#include "pipeline/tasks/run.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

bool same_pings(const ObservationProduct& product, const ObservationFiles& observation) {
  const auto same_time = [](const PingNavigation& a, const PingNavigation& b) { return a.time == b.time; };
  return product.source == source_of(observation) && product.grid && observation.grid &&
         product.grid->grid == *observation.grid && product.grid->range == observation.range &&
         std::ranges::equal(product.pings, observation.navigation, same_time);
}

/// Parameters that were not there yet have their defaults, whatever the text's hash is. Where a recipe looks for no schools by
/// itself, that there are some shows that they were looked for.
bool same_recipe(const ObservationProduct& product, Recipe recipe) {
  auto made_under = recipe_from_text(product.recipe_json);
  if (!made_under || (!made_under->automatic && product.schools.empty())) return false;
  made_under->automatic = recipe.automatic = true;
  return recipe_hash(*made_under) == recipe_hash(recipe);
}

Result<Plan> plan_of(const fs::path& folder) {
  std::error_code absent;
  const fs::path plan = folder / "plan.json";
  return fs::is_regular_file(plan, absent) ? read_plan(plan) : Result<Plan>(fail(ErrorCode::not_found, ""));
}

/// Whether schools were looked for in every ping: `--pings` looks in some.
bool whole_find(const ObservationProduct& product) {
  return std::ranges::none_of(product.diagnostics,
                              [](const Diagnostic& note) { return note.code == DiagnosticCode::pings_left_out; });
}

/// Of the same pings on the same grid under the same recipe.
std::optional<ObservationProduct> product_of(const fs::path& file, const ObservationFiles& observation,
                                             const Recipe& recipe) {
  std::error_code absent;
  if (!fs::exists(file, absent)) return std::nullopt;
  auto product = read_product(file);
  if (!product || !whole_find(*product) || !same_pings(*product, observation) || !same_recipe(*product, recipe)) {
    return std::nullopt;
  }
  return std::move(*product);
}

OtherFind find_in(const fs::path& file, ObservationProduct product) {
  product.background_db = {};
  return {file, std::make_shared<const ObservationProduct>(std::move(product))};
}

/// Under another calibration, masks stay, but the product tells it as its recipe's.
bool leaves_masks(const ReadLine& read) {
  if (read.line.command == "undo" || read.line.command == "redo") return true;
  const Command& command = read.act->command;
  return std::holds_alternative<DetectCommand>(command) || std::holds_alternative<DecideCommand>(command) ||
         std::holds_alternative<EventCommand>(command) || std::holds_alternative<RemoveEventCommand>(command);
}

/// When a journal's lines may have changed masks. Lines are only ever added to a journal: whatever a run was given of it,
/// nothing else was among it. Empty where it cannot be read whole, or nobody knows what a line asks for.
std::optional<std::vector<TimeSpan>> mask_changes(const fs::path& session) {
  const auto journal = read_session(session);
  if (!journal || !journal->diagnostics.empty()) return std::nullopt;
  std::vector<TimeSpan> spans;
  const ReadJournal lines(journal->lines);
  for (const ReadLine& read : lines.lines()) {
    if (!read.act && read.line.command != "undo" && read.line.command != "redo") return std::nullopt;
    if (leaves_masks(read)) continue;
    const std::vector<TimeSpan> of_line = times_of(read);
    spans.insert(spans.end(), of_line.begin(), of_line.end());
  }
  return spans;
}

/// Whether spans meet the pings of an observation.
bool meet(const std::vector<TimeSpan>& spans, const SurveyFiles& survey, const ObservationFiles& observation) {
  const std::vector<TimeNs> times = datagram_times(survey, observation);
  return std::ranges::any_of(spans, [&](const TimeSpan& span) {
    return !times.empty() && span.first <= times.back() && span.last >= times.front();
  });
}

/// Another journal may lie where the run's lay.
bool shaped_by_hand(const SchoolRow& school) { return school.origin != "automatic" || school.status == "corrected"; }

bool decided_on(const SchoolRow& school) {
  return shaped_by_hand(school) || school.status != "unreviewed" || !school.species.empty() || !school.comment.empty();
}

/// Whether a product's masks are those of a run before that may have had another journal: some have decisions, or they lie
/// beside what was found without them (a school that was deleted leaves nothing else).
/// find  where a run keeps what it found beside a product that holds decisions
bool keeps_decided_masks(const ObservationProduct& product, const fs::path& find) {
  std::error_code absent;
  return is_remeasured(product) && (fs::exists(find, absent) || std::ranges::any_of(product.schools, decided_on));
}

/// Without decisions.
std::optional<OtherFind> found_alone(const fs::path& file, const ObservationFiles& observation, const Recipe& recipe,
                                     const std::string& version, const fs::path& find) {
  auto product = product_of(file, observation, recipe);
  if (!product || (file != find && keeps_decided_masks(*product, find))) return std::nullopt;
  const bool of_now = product->program_version == version && product->stage_versions == kStageVersions;
  return of_now && !is_remeasured(*product) ? std::nullopt : std::optional(find_in(file, std::move(*product)));
}

/// With decisions that changed no mask.
std::optional<OtherFind> decided(const fs::path& file, const ObservationFiles& observation, const Recipe& recipe,
                                 const fs::path& find) {
  auto product = product_of(file, observation, recipe);
  if (!product || keeps_decided_masks(*product, find) || std::ranges::any_of(product->schools, shaped_by_hand)) {
    return std::nullopt;
  }
  // Figures then hang on which of the ping's schools are rejected: another word on one would leave the others' as they were.
  const auto rejected = [](const SchoolRow& school) { return school.status == "rejected"; };
  if (recipe.measure.extinction.correct && std::ranges::any_of(product->schools, rejected)) return std::nullopt;
  // What was lost of the decisions is told where they are carried out here.
  std::erase_if(product->diagnostics, [](const Diagnostic& note) {
    return note.code == DiagnosticCode::decision_lost || note.code == DiagnosticCode::decision_carried;
  });
  return find_in(file, std::move(*product));
}

}  // namespace

std::map<std::size_t, OtherFind> other_finds(std::span<const fs::path> work_folders, const SurveyFiles& survey,
                                             const Recipe& recipe, const std::string& version,
                                             const std::set<std::size_t>& known) {
  std::map<std::size_t, OtherFind> finds;
  for (const fs::path& folder : work_folders) {
    const auto plan = plan_of(folder);
    if (!plan) continue;
    const bool has_decisions = !plan->session.empty();
    const auto changed = has_decisions ? mask_changes(plan->session) : std::nullopt;
    for (std::size_t i = 0; i < survey.observations.size(); ++i) {
      if (known.contains(i) || finds.contains(i)) continue;
      const ObservationFiles& observation = survey.observations[i];
      const fs::path product = product_path(folder, observation.name);
      const fs::path kept = found_path(folder, observation.name);
      // With the extinction correction, figures hang on which of the ping's schools are rejected: those of the find then
      // are none of any decided state.
      const bool may_be_alone = !has_decisions || !recipe.measure.extinction.correct;
      auto find =
          may_be_alone ? found_alone(has_decisions ? kept : product, observation, recipe, version, kept) : std::nullopt;
      if (!find && changed && !meet(*changed, survey, observation)) find = decided(product, observation, recipe, kept);
      if (find) finds.emplace(i, std::move(*find));
    }
  }
  return finds;
}

}  // namespace sonar
