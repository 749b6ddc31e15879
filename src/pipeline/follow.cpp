// SPDX-License-Identifier: Apache-2.0
#include "pipeline/follow.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "io/atomic_file.h"
#include "io/product.h"
#include "pipeline/earlier.h"
#include "pipeline/observe.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

/// What a product says that pings to come may change: nothing names it right.
void mark_provisional(ObservationProduct& product) {
  for (SchoolPingRow& row : product.school_pings) row.provisional = 1;
  product.input_hash.clear();
}

}  // namespace

Follow::Follow(FollowOptions options, Recipe recipe)
    : options_(std::move(options)),
      recipe_(std::move(recipe)),
      live_(options_.survey, recipe_.survey, recipe_.navigation, options_.cache) {}

void Follow::read_session() {
  if (options_.session.empty()) return;
  std::error_code absent;
  const auto size = fs::file_size(options_.session, absent);
  if (absent || size == journal_size_) return;
  const auto journal = read_journal(options_.session.string());
  if (!journal) return;  // its first line is being written
  journal_size_ = size;
  journal_ = effective_lines(journal->lines);
}

Result<Follow::Look> Follow::look(LiveClock::time_point now, Work& work) {
  Look look;
  auto news = live_.look(now, work);
  if (!news) return pass_on(news);
  look.news = std::move(*news);
  const std::uintmax_t said_before = journal_size_;
  read_session();
  if (!look.news.changed && journal_size_ == said_before) return look;
  if (look.news.replaced) {
    for (auto& [name, at_work] : at_work_) at_work.memory = std::make_unique<ObserveMemory>();
  }
  unwritten_ = true;
  const auto survey = live_.survey();
  for (const ObservationFiles& observation : survey->observations) {
    auto worked = work_on(observation, look, work);
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    if (worked) continue;
    if (worked.error().code == ErrorCode::no_space) return pass_on(worked);
    look.failures.push_back({observation.name, worked.error()});
  }
  let_go();
  return look;
}

Result<ObservationProduct> Follow::observed(const ObservationFiles& observation, AtWork& at_work, bool over,
                                            Work& work) {
  const auto survey = live_.survey();
  ObserveOptions options{{}, journal_, options_.program_version};
  options.memory = at_work.memory.get();
  std::optional<EarlierSchools> earlier;
  if (over) {
    // As run() does it, so that both give one product.
    earlier = EarlierProducts(options_.out).schools_of(source_of(observation), datagram_times(*survey, observation));
  } else if (at_work.product) {
    earlier = numbers_of(*at_work.product);
  }
  if (earlier) options.earlier = &*earlier;
  return observe(*survey, observation, recipe_, options, work);
}

Result<void> Follow::work_on(const ObservationFiles& observation, Look& look, Work& work) {
  const auto survey = live_.survey();
  AtWork& at_work = at_work_[observation.name];
  const ObserveOptions options{{}, journal_, options_.program_version};
  const std::string key = observation_key(*survey, observation, recipe_, options);
  if (key == at_work.key) return {};
  tasks_[observation.name] = task_of(*survey, observation, recipe_, options);
  if (live_.over(observation)) return end_one(observation, at_work, look, work);
  tasks_[observation.name].key.clear();  // no product of it is right yet
  auto product = observed(observation, at_work, false, work);
  if (!product) return pass_on(product);
  mark_provisional(*product);
  const auto before = std::exchange(at_work.product, std::move(*product));
  for (LiveSchool& school : live_schools(*at_work.product, before ? &*before : nullptr)) {
    look.schools.push_back(std::move(school));
  }
  return {};
}

Result<void> Follow::end_one(const ObservationFiles& observation, AtWork& at_work, Look& look, Work& work) {
  auto product = observed(observation, at_work, true, work);
  if (!product) return pass_on(product);
  const fs::path path = product_path(options_.out, observation.name);
  const auto there = read_product_key(path);
  if (!there || there->input_hash != product->input_hash) {
    if (auto written = write_product(*product, path, Beside::own_folder); !written) return written;
  }
  at_work.key = product->input_hash;
  at_work.product.reset();
  at_work.memory = std::make_unique<ObserveMemory>();
  look.finished.push_back(observation.name);
  return {};
}

void Follow::let_go() {
  // One that is over stays before the first that goes on: a file of its may go on after all.
  const auto survey = live_.survey();
  std::string first_kept;
  for (const ObservationFiles& observation : survey->observations) {
    if (at_work_[observation.name].key.empty()) break;
    first_kept = observation.name;
  }
  if (first_kept.empty() || first_kept == survey->observations.front().name) return;
  for (const ObservationFiles& observation : survey->observations) {
    if (observation.name == first_kept) break;
    at_work_.erase(observation.name);
  }
  live_.let_go_before(first_kept);
}

Result<MergeReport> Follow::write(Work& work) {
  if (auto own = require_own_folder(options_.out / "products"); !own) return pass_on(own);
  for (const auto& [name, at_work] : at_work_) {
    if (!at_work.product) continue;
    auto written = write_product(*at_work.product, product_path(options_.out, name), Beside::own_folder);
    if (!written) return pass_on(written);
  }
  Plan plan = make_plan(*live_.survey(), options_.survey, options_.session, recipe_, {});
  plan.tasks.clear();
  for (const auto& [name, task] : tasks_) plan.tasks.push_back(task);
  std::sort(plan.tasks.begin(), plan.tasks.end(),
            [](const PlanTask& a, const PlanTask& b) { return name_less(a.observation, b.observation); });
  if (auto written = write_file(options_.out / "plan.json", plan_text(plan)); !written) return pass_on(written);
  auto merged = merge_folder(options_.out, {}, work);
  if (merged) unwritten_ = false;
  return merged;
}

}  // namespace sonar
