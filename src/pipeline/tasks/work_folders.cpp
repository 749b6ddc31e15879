// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tasks/work_folders.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "base/number_text.h"
#include "io/product_file.h"
#include "pipeline/tasks/merge.h"
#include "pipeline/tasks/plan.h"
#include "pipeline/tasks/run.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPlan = "plan.json";

bool has_plan(const fs::path& folder) {
  std::error_code absent;
  return fs::is_regular_file(folder / kPlan, absent);
}

/// A folder of raw files may have a folder `products` of its own.
bool is_work_folder(const fs::path& path) {
  if (has_plan(path)) return true;
  std::error_code absent;
  if (!fs::is_directory(path / "products", absent)) return false;
  const auto raw = list_survey(std::span(&path, 1));
  return raw && raw->empty();
}

/// Names of the files that a plan's observations are in, without folder.
std::set<std::string> files_of(const Plan& plan) {
  std::set<std::string> names;
  for (const PlanTask& task : plan.tasks) names.insert(task.files.begin(), task.files.end());
  return names;
}

/// "a.raw", "a.raw and 4 more files".
std::string some_of(const std::set<std::string>& names) {
  if (names.empty()) return "raw files";
  return names.size() == 1 ? *names.begin()
                           : fmt::format("{} and {}", *names.begin(), count_of(names.size() - 1, "more file"));
}

/// The raw files that a plan was made of, where one of them at least is still there.
Result<std::vector<fs::path>> raw_of(const Plan& plan, const fs::path& out) {
  std::vector<fs::path> raw(plan.survey.begin(), plan.survey.end());
  const std::set<std::string> expected = files_of(plan);
  const auto there = list_survey(raw);
  const auto is_expected = [&](const fs::path& file) { return expected.contains(file.filename().string()); };
  if (there && (expected.empty() || std::any_of(there->begin(), there->end(), is_expected))) return raw;
  if (!there && there.error().code != ErrorCode::not_found) return pass_on(there);
  return fail(
      ErrorCode::not_found,
      fmt::format("the raw files are not here: expected {} ({}); open the folder where they lie now together with "
                  "this one",
                  fmt::join(plan.survey, ", "), some_of(expected)),
      {out.string()});
}

/// Of a folder's first product; empty where it cannot be read.
std::optional<Recipe> recipe_of_products(const fs::path& out) {
  const auto files = product_files(out);
  if (!files || files->empty()) return std::nullopt;
  const auto key = read_product_key(files->front());
  auto recipe = key ? recipe_from_text(key->recipe_json) : Result<Recipe>(pass_on(key));
  return recipe ? std::optional(std::move(*recipe)) : std::nullopt;
}

void add_once(std::vector<fs::path>& list, fs::path path) {
  if (std::find(list.begin(), list.end(), path) == list.end()) list.push_back(std::move(path));
}

bool has_products(const fs::path& out) {
  const auto files = product_files(out);
  return files && !files->empty();
}

/// Adds a work folder's survey and recipe.
/// stands_alone  no raw files are named beside it
Result<void> take_work_folder(const fs::path& out, bool stands_alone, NamedToOpen& named) {
  std::optional<Recipe> recipe;
  Result<std::vector<fs::path>> raw;
  if (has_plan(out)) {
    auto plan = read_plan(out / kPlan);
    if (!plan) return pass_on(plan);
    if (stands_alone) raw = raw_of(*plan, out);
    for (const std::string& one : plan->survey) add_once(named.expected, one);
    if (!plan->session.empty()) add_once(named.sessions, plan->session);
    recipe = std::move(plan->recipe);
  } else {
    recipe = recipe_of_products(out);
    if (stands_alone) {
      raw = fail(ErrorCode::not_found,
                 "the raw files are not here: the results do not say where they lie (there is no plan.json); open the "
                 "folder of the raw files together with this one",
                 {out.string()});
    }
  }
  if (!raw && (raw.error().code != ErrorCode::not_found || !has_products(out))) return pass_on(raw);
  if (!raw && named.raw_gone.empty()) named.raw_gone = to_line(raw.error());
  if (raw) {
    for (fs::path& one : *raw) add_once(named.raw, std::move(one));
  }
  if (!named.recipe) named.recipe = std::move(recipe);
  return {};
}

}  // namespace

std::set<fs::path> places_of(std::span<const fs::path> paths) {
  std::set<fs::path> places;
  for (const fs::path& path : paths) {
    std::error_code error;
    const fs::path followed = fs::weakly_canonical(path, error);
    const fs::path place = error ? path.lexically_normal() : followed;
    places.insert(place.has_filename() ? place : place.parent_path());
  }
  return places;
}

Result<void> require_results_of(const fs::path& out, std::span<const fs::path> survey) {
  const auto holds = [&](const std::string& what) {
    return fail(ErrorCode::usage, "holds " + what + "; choose another folder", {out.string()});
  };
  if (!has_plan(out)) {
    const auto products = product_files(out);
    return products && !products->empty() ? Result<void>(holds("results of no run, of an export say")) : Result<void>();
  }
  const auto plan = read_plan(out / kPlan);
  if (!plan) return pass_on(plan);
  if (!plan->session.empty()) return holds("results with the decisions of " + plan->session);
  const std::vector<fs::path> planned(plan->survey.begin(), plan->survey.end());
  if (places_of(planned) == places_of(survey)) return {};
  return holds(fmt::format("results of another survey, {}", fmt::join(plan->survey, ", ")));
}

Result<NamedToOpen> told_apart(std::span<const fs::path> paths) {
  NamedToOpen named;
  for (const fs::path& path : paths) (is_work_folder(path) ? named.work_folders : named.raw).push_back(path);
  const bool stand_alone = named.raw.empty();
  for (const fs::path& out : named.work_folders) {
    if (auto taken = take_work_folder(out, stand_alone, named); !taken) return pass_on(taken);
  }
  // Of some of the results there are pings, of others there are not: that is no one survey.
  if (!named.raw.empty() && !named.raw_gone.empty()) return fail(ErrorCode::not_found, named.raw_gone);
  return named;
}

fs::path product_in(std::span<const fs::path> work_folders, const std::string& observation, const std::string& key) {
  for (const fs::path& folder : work_folders) {
    for (const fs::path& file : {product_path(folder, observation), found_path(folder, observation)}) {
      std::error_code absent;
      if (!fs::exists(file, absent)) continue;
      const auto known = read_product_key(file);
      if (known && known->input_hash == key) return file;
    }
  }
  return {};
}

}  // namespace sonar
