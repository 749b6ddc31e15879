// SPDX-License-Identifier: Apache-2.0
#include "pipeline/live/follow.h"

#include <algorithm>
#include <chrono>
#include <span>
#include <system_error>
#include <utility>

#include "io/atomic_file.h"
#include "io/product_file.h"
#include "pipeline/journal/earlier.h"
#include "pipeline/journal/journals.h"
#include "pipeline/stages/observe.h"
#include "pipeline/tasks/kept_find.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

/// Before what failed is tried again.
constexpr std::chrono::seconds kBetweenTries{10};

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

Follow::Which Follow::which(const SurveyFiles& survey, const ObservationFiles& observation) {
  return {sounder_of(observation.config), survey.ping_time(observation, 0)};
}

/// Whether the journal says more than before.
bool Follow::read_session() {
  if (options_.session.empty()) return false;
  std::error_code absent;
  std::uintmax_t size = 0;
  const bool several = fs::is_directory(options_.session, absent);
  for (const OneJournal& one :
       several ? journals_in(std::span(&options_.session, 1)) : std::vector<OneJournal>{{options_.session, 0}}) {
    const auto its_size = fs::file_size(one.path, absent);
    if (absent) return false;
    size += its_size;
  }
  if (size == journal_size_) return false;
  const auto journal = sonar::read_session(options_.session);
  if (!journal) return false;  // its first line is being written
  journal_size_ = size;
  journal_ = effective_lines(journal->lines);
  return true;
}

Result<Follow::Look> Follow::look(LiveClock::time_point now, Work& work) {
  Look look;
  auto news = live_.look(now, work);
  if (!news) return pass_on(news);
  look.news = std::move(*news);
  const bool said = read_session();
  const bool again = unworked_ && now - tried_at_ >= kBetweenTries;
  if (!look.news.changed && !said && !again) return look;
  unworked_ = unwritten_ = true;
  if (look.news.replaced) {
    for (auto& [of, at_work] : at_work_) at_work.memory = std::make_unique<ObserveMemory>();
  }
  forget_vanished();
  const auto survey = live_.survey();
  for (const ObservationFiles& observation : survey->observations) {
    auto worked = work_on(observation, look, work);
    if (work.cancelled()) {
      tried_at_ = {};  // the next look takes it up at once
      return fail(ErrorCode::cancelled, "stopped on request");
    }
    if (!worked) look.failures.push_back({observation.name, worked.error()});
  }
  unworked_ = !look.failures.empty();
  tried_at_ = now;
  let_go();
  return look;
}

/// What stood on a file that is gone, or is a part of another observation now.
void Follow::forget_vanished() {
  const auto survey = live_.survey();
  std::erase_if(at_work_, [&](const auto& entry) {
    return std::none_of(survey->observations.begin(), survey->observations.end(),
                        [&](const ObservationFiles& there) { return which(*survey, there) == entry.first; });
  });
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
  if (over) {
    const auto finding = recipe_of_find(*survey, observation, recipe_, journal_);
    if (auto kept = keep_find(*survey, observation, finding, options, options_.out, work); !kept) return pass_on(kept);
  }
  return observe(*survey, observation, recipe_, options, work);
}

Result<void> Follow::work_on(const ObservationFiles& observation, Look& look, Work& work) {
  const auto survey = live_.survey();
  AtWork& at_work = at_work_[which(*survey, observation)];
  const ObserveOptions options{{}, journal_, options_.program_version};
  const std::string key = observation_key(*survey, observation, recipe_, options);
  if (key == at_work.key) return {};
  at_work.task = task_of(*survey, observation, recipe_, options);
  if (live_.over(observation)) return end_one(observation, at_work, look, work);
  at_work.task.key.clear();  // no product of it is right yet
  at_work.key.clear();
  return look_at_one(observation, at_work, look, work);
}

Result<void> Follow::look_at_one(const ObservationFiles& observation, AtWork& at_work, Look& look, Work& work) {
  auto product = observed(observation, at_work, false, work);
  if (!product) return pass_on(product);
  mark_provisional(*product);
  const auto before = std::exchange(at_work.product, std::move(*product));
  for (LiveSchool& school : live_schools(*at_work.product, before ? &*before : nullptr)) {
    look.schools.push_back(std::move(school));
  }
  return {};
}

/// A right product of other files or another recipe keeps the numbers of its schools, as run() does it.
Result<void> Follow::hold_other(const fs::path& product, const std::string& key) const {
  const auto there = read_product_key(product);
  if (!there || there->input_hash.empty() || there->input_hash == key) return {};
  return hold(options_.out, product, *there);
}

Result<void> Follow::end_one(const ObservationFiles& observation, AtWork& at_work, Look& look, Work& work) {
  const fs::path path = product_path(options_.out, observation.name);
  const std::string key = at_work.task.key;
  const auto there = read_product_key(path);
  if (!there || there->input_hash != key) {
    if (auto held = hold_other(path, key); !held) return held;
    // Its last pings may bring schools of which nobody was told.
    if (auto told = look_at_one(observation, at_work, look, work); !told) return told;
    auto product = observed(observation, at_work, true, work);
    if (!product) return pass_on(product);
    if (auto written = write_product(*product, path, Beside::own_folder); !written) return written;
  }
  at_work.key = key;
  at_work.product.reset();
  at_work.memory = std::make_unique<ObserveMemory>();
  look.finished.push_back(observation.name);
  return {};
}

/// Of each sounder, what is over, but for the last of it: a file of its may go on after all.
void Follow::let_go() {
  const auto before = live_.survey();
  std::map<Sounder, std::pair<std::string, bool>> kept;  // the name, and whether one before it was over
  for (const ObservationFiles& observation : before->observations) {
    const Which of = which(*before, observation);
    auto& [name, ended] = kept[of.first];
    if (ended) continue;
    ended = at_work_[of].key.empty();
    if (name.empty() || !ended) name = observation.name;
  }
  for (const auto& [sounder, until] : kept) live_.let_go_before(until.first);
  const auto now = live_.survey();
  for (const ObservationFiles& observation : before->observations) {
    const Which of = which(*before, observation);
    const bool stays = std::any_of(now->observations.begin(), now->observations.end(),
                                   [&](const ObservationFiles& there) { return which(*now, there) == of; });
    if (stays) continue;
    let_go_.push_back(at_work_[of].task);
    at_work_.erase(of);
  }
}

Result<MergeReport> Follow::write(Work& work) {
  if (auto own = require_own_folder(options_.out / "products"); !own) return pass_on(own);
  for (const auto& [of, at_work] : at_work_) {
    if (!at_work.product) continue;
    const fs::path path = product_path(options_.out, at_work.product->observation);
    if (auto held = hold_other(path, ""); !held) return pass_on(held);
    if (auto written = write_product(*at_work.product, path, Beside::own_folder); !written) return pass_on(written);
  }
  Plan plan = plan_without_tasks(*live_.survey(), options_.survey, options_.session, recipe_, {});
  plan.tasks = let_go_;
  for (const auto& [of, at_work] : at_work_) plan.tasks.push_back(at_work.task);
  std::sort(plan.tasks.begin(), plan.tasks.end(),
            [](const PlanTask& a, const PlanTask& b) { return name_less(a.observation, b.observation); });
  if (auto written = write_file(options_.out / "plan.json", plan_text(plan)); !written) return pass_on(written);
  auto merged = merge_folder(options_.out, {}, work);
  if (merged) unwritten_ = false;
  return merged;
}

}  // namespace sonar
