// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tasks/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>
#include <vector>

#include "io/atomic_file.h"
#include "io/product_file.h"
#include "pipeline/journal/earlier.h"
#include "pipeline/stages/observe_memory.h"
#include "pipeline/tasks/kept_find.h"

namespace sonar {
namespace {

/// Room on the disk that is asked for before work begins: tables and the map, and for each ping its background levels
/// and masks.
constexpr std::uint64_t kSpaceForTables = 32U << 20U;
constexpr std::uint64_t kSpacePerPing = 16U << 10U;

std::uint64_t space_needed(const std::vector<PlanTask>& tasks) {
  std::uint64_t pings = 0;
  for (const PlanTask& task : tasks) pings += static_cast<std::uint64_t>(task.pings);
  return kSpaceForTables + pings * kSpacePerPing;
}

Result<std::vector<PlanTask>> chosen_tasks(const Plan& plan, const RunOptions& options) {
  if (options.task) {
    if (*options.task >= plan.tasks.size()) {
      return fail(ErrorCode::usage,
                  fmt::format("no task {}: the plan has {}, counted from 0", *options.task, plan.tasks.size()));
    }
    return std::vector<PlanTask>{plan.tasks[*options.task]};
  }
  if (!options.only) return plan.tasks;
  for (const PlanTask& task : plan.tasks) {
    if (task.observation == *options.only) return std::vector<PlanTask>{task};
  }
  return fail(ErrorCode::usage, fmt::format("no observation {} in this survey", *options.only));
}

bool is_right(const std::filesystem::path& product, const std::string& key) {
  const auto there = read_product_key(product);
  return there && there->input_hash == key;
}

/// The product whose masks are kept: that of this name, or where names have shifted the one with these pings.
Result<ObservationProduct> product_before(const SurveyFiles& survey, const ObservationFiles& observation,
                                          const std::filesystem::path& path, const EarlierProducts& earlier) {
  auto there = read_product(path);
  const std::vector<TimeNs> times = datagram_times(survey, observation);
  if (there && has_pings(*there, source_of(observation), times)) return there;
  auto elsewhere = earlier.of_pings(source_of(observation), times);
  return elsewhere ? Result<ObservationProduct>{std::move(*elsewhere)} : there;
}

/// The product that is to be written; empty where the one that is there is right.
Result<std::optional<ObservationProduct>> make_product(const SurveyFiles& survey, const ObservationFiles& observation,
                                                       const Recipe& recipe, ObserveOptions options,
                                                       const RunOptions& run, const std::string& key,
                                                       const EarlierProducts& earlier, Work& work) {
  const std::filesystem::path path = product_path(run.out, observation.name);
  if (!run.remeasure) {
    if (is_right(path, key)) return std::optional<ObservationProduct>{};
    const auto numbers = earlier.schools_of(source_of(observation), datagram_times(survey, observation));
    if (numbers) options.earlier = &*numbers;
    ObserveMemory memory;  // what is known of the find by then is not worked out again
    const auto finding = recipe_of_find(survey, observation, recipe, options.journal);
    if (finding) options.memory = &memory;
    if (auto kept = keep_find(survey, observation, finding, options, run.out, work); !kept) return pass_on(kept);
    auto made = observe(survey, observation, recipe, options, work);
    if (!made) return pass_on(made);
    return std::optional<ObservationProduct>{std::move(*made)};
  }
  const auto before = product_before(survey, observation, path, earlier);
  if (!before) return pass_on(before);
  const std::string kept_key = remeasured_key(key, *before);
  if (before->input_hash == kept_key) return std::optional<ObservationProduct>{};
  auto made = remeasure(survey, observation, *before, recipe, options, work);
  if (!made) return pass_on(made);
  made->input_hash = kept_key;
  if (auto found = remeasure_find(survey, observation, recipe, options, run.out, work); !found) return pass_on(found);
  return std::optional<ObservationProduct>{std::move(*made)};
}

Result<void> work_on(const SurveyFiles& survey, const PlanTask& task, const Plan& plan, const ObserveOptions& options,
                     const RunOptions& run, const EarlierProducts& earlier, RunReport& report, Work& work) {
  const ObservationFiles* observation = survey.find(task.observation);
  if (observation == nullptr) {
    return fail(ErrorCode::mismatch, "is not in the survey any more: plan again");
  }
  const std::string key = observation_key(survey, *observation, plan.recipe, options);
  if (run.task && key != task.key) {
    return fail(ErrorCode::mismatch, "changed since the plan was made: plan again");
  }
  const auto product = make_product(survey, *observation, plan.recipe, options, run, key, earlier, work);
  if (!product) return pass_on(product);
  if (!*product) {
    report.skipped.push_back(task.observation);
    return {};
  }
  if (auto written = write_product(**product, product_path(run.out, task.observation), Beside::own_folder); !written) {
    return written;
  }
  report.done.push_back(task.observation);
  return {};
}

/// Those of the chosen tasks that have some of the chosen pings: observations are not equally long.
Result<std::vector<PlanTask>> possible_tasks(const Plan& plan, const RunOptions& options) {
  auto tasks = chosen_tasks(plan, options);
  if (!tasks || tasks->empty() || !options.pings) return tasks;
  const PlanTask longest = *std::max_element(tasks->begin(), tasks->end(),
                                             [](const PlanTask& a, const PlanTask& b) { return a.pings < b.pings; });
  std::erase_if(*tasks, [&](const PlanTask& task) { return !has_pings(task, options.pings); });
  if (!tasks->empty()) return tasks;
  return fail(ErrorCode::usage,
              fmt::format("--pings {}:{}: {} has pings 0 to {}{}", options.pings->first, options.pings->last,
                          longest.observation, longest.pings - 1, options.only ? "" : ", no observation more"));
}

}  // namespace

Result<void> require_possible(const Plan& plan, const RunOptions& options) {
  if (auto tasks = possible_tasks(plan, options); !tasks) return pass_on(tasks);
  return {};
}

std::filesystem::path product_path(const std::filesystem::path& out, const std::string& observation) {
  return out / "products" / (observation + ".nc");
}

std::filesystem::path found_path(const std::filesystem::path& out, const std::string& observation) {
  return out / "found" / (observation + ".nc");
}

Result<RunReport> run_plan(const Plan& plan, const SurveyFiles& survey, const ReadJournal& journal,
                           const RunOptions& options, Work& work) {
  const auto tasks = possible_tasks(plan, options);
  if (!tasks) return pass_on(tasks);
  if (auto space = require_free_space(options.out, space_needed(*tasks)); !space) return pass_on(space);
  for (const auto& folder : {product_path(options.out, "").parent_path(), found_path(options.out, "").parent_path()}) {
    if (require_own_folder(folder)) remove_leftovers(folder);
  }
  ObserveOptions observe_options{options.pings, journal, options.program_version};
  const EarlierProducts earlier(options.out);
  RunReport report;
  for (const PlanTask& task : *tasks) {
    work.progress(kObservations, static_cast<std::int64_t>(&task - tasks->data()), std::ssize(*tasks));
    auto worked = work_on(survey, task, plan, observe_options, options, earlier, report, work);
    if (work.cancelled()) return fail(ErrorCode::cancelled, "interrupted; finished observations are kept");
    if (!worked) report.failures.push_back({task.observation, worked.error()});
  }
  work.progress(kObservations, std::ssize(*tasks), std::ssize(*tasks));
  return report;
}

}  // namespace sonar
