// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tasks/plan.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "io/product_file.h"
#include "pipeline/recipe/json_file.h"
#include "pipeline/recipe/json_path.h"

namespace sonar {
namespace {

nlohmann::json to_json(const PlanTask& task, std::size_t number) {
  return {{"task", number},
          {"observation", task.observation},
          {"files", task.files},
          {"pings", task.pings},
          {"first_time_utc", iso_time(task.first_time)},
          {"last_time_utc", iso_time(task.last_time)},
          {"continues_cut", task.continues_cut},
          {"key", task.key}};
}

bool is_text_array(const nlohmann::json& json) {
  if (!json.is_array()) return false;
  for (const auto& entry : json) {
    if (!entry.is_string()) return false;
  }
  return true;
}

Result<PlanTask> task_from_json(const nlohmann::json& json, std::size_t number) {
  const auto wrong = [&](const char* expected) {
    return fail(ErrorCode::format, fmt::format("tasks[{}]: expected {}", number, expected));
  };
  const auto text = [&](const char* member) {
    return json.contains(member) && json[member].is_string() ? json[member].get<std::string>() : std::string{};
  };
  if (!json.is_object()) return wrong("an object");
  PlanTask task;
  task.observation = text("observation");
  if (!is_observation_name(task.observation)) return wrong("the name of an observation, such as obs-0001");
  if (!json.contains("files") || !is_text_array(json["files"])) return wrong("an array files");
  task.files = json["files"].get<std::vector<std::string>>();
  const auto pings = json.contains("pings") ? whole_number(json["pings"], 0) : std::nullopt;
  if (!pings) return wrong("a whole number pings");
  task.pings = *pings;
  task.first_time = time_from_iso(text("first_time_utc")).value_or(0);
  task.last_time = time_from_iso(text("last_time_utc")).value_or(0);
  task.continues_cut = json.contains("continues_cut") && json["continues_cut"] == true;
  task.key = text("key");
  return task;
}

nlohmann::json notes_to_json(const Diagnostics& notes) {
  nlohmann::json list = nlohmann::json::array();
  for (const Diagnostic& note : notes) {
    list.push_back({{"code", std::string(name(note.code))}, {"file", note.file}, {"text", note.text}});
  }
  return list;
}

/// Notes are for reading only: one that is not understood is passed over.
Diagnostics notes_from_json(const nlohmann::json& json) {
  Diagnostics notes;
  if (!json.is_array()) return notes;
  for (const auto& entry : json) {
    const auto text = [&](const char* member) {
      return entry.is_object() && entry.contains(member) && entry[member].is_string() ? entry[member].get<std::string>()
                                                                                      : std::string{};
    };
    for (const DiagnosticEntry& known : diagnostic_table()) {
      if (known.name == text("code")) notes.push_back({known.code, text("file"), -1, -1, text("text")});
    }
  }
  return notes;
}

Result<Plan> plan_from_json(const nlohmann::json& json) {
  if (!json.is_object()) return fail(ErrorCode::format, "a plan is a JSON object");
  if (auto version = check_version(json, "plan_version", kPlanVersion); !version) return pass_on(version);
  Plan plan;
  if (!json.contains("survey") || !is_text_array(json["survey"])) {
    return fail(ErrorCode::format, "survey: expected an array of paths");
  }
  for (const auto& path : json["survey"]) plan.survey.push_back(path_of_json(path.get<std::string>()).string());
  if (json.contains("session") && json["session"].is_string()) {
    plan.session = path_of_json(json["session"].get<std::string>()).string();
  }
  if (!json.contains("recipe")) return fail(ErrorCode::format, "recipe: expected an object");
  auto recipe = recipe_from_text(json["recipe"].dump());
  if (!recipe) return pass_on(recipe);
  plan.recipe = std::move(*recipe);
  if (const auto pings = json.find("pings"); pings != json.end()) {
    const bool two = pings->is_array() && pings->size() == 2;
    const auto first = two ? whole_number((*pings)[0], 0) : std::nullopt;
    const auto last = first ? whole_number((*pings)[1], *first) : std::nullopt;
    if (!last) return fail(ErrorCode::format, "pings: expected the first and the last as whole numbers");
    plan.pings = PingSelection{*first, *last};
  }
  if (const auto notes = json.find("notes"); notes != json.end()) plan.notes = notes_from_json(*notes);
  if (!json.contains("tasks") || !json["tasks"].is_array()) return fail(ErrorCode::format, "tasks: expected an array");
  for (const auto& entry : json["tasks"]) {
    auto task = task_from_json(entry, plan.tasks.size());
    if (!task) return pass_on(task);
    plan.tasks.push_back(std::move(*task));
  }
  return plan;
}

}  // namespace

bool has_pings(const PlanTask& task, const std::optional<PingSelection>& pings) {
  return !pings || pings->first < task.pings;
}

PlanTask task_of(const SurveyFiles& survey, const ObservationFiles& observation, const Recipe& recipe,
                 const ObserveOptions& options) {
  PlanTask task;
  task.observation = observation.name;
  for (const InputFile& file : input_files(survey, observation)) task.files.push_back(file.name);
  task.pings = static_cast<std::int64_t>(observation.pings.size());
  task.first_time = observation.navigation.front().time;
  task.last_time = observation.navigation.back().time;
  task.continues_cut = observation.continues_cut;
  task.key = observation_key(survey, observation, recipe, options);
  return task;
}

Plan plan_without_tasks(const SurveyFiles& survey, std::span<const std::filesystem::path> paths,
                        const std::filesystem::path& session, const Recipe& recipe, const ObserveOptions& options) {
  Plan plan;
  for (const std::filesystem::path& path : paths) {
    plan.survey.push_back(std::filesystem::absolute(path).lexically_normal().string());
  }
  if (!session.empty()) plan.session = std::filesystem::absolute(session).lexically_normal().string();
  plan.recipe = recipe;
  plan.pings = options.pings;
  plan.notes = survey.diagnostics;
  for (Diagnostic& note : plan.notes) note.file = std::filesystem::path(note.file).filename().string();
  return plan;
}

Plan make_plan(const SurveyFiles& survey, std::span<const std::filesystem::path> paths,
               const std::filesystem::path& session, const Recipe& recipe, const ObserveOptions& options) {
  Plan plan = plan_without_tasks(survey, paths, session, recipe, options);
  for (const ObservationFiles& observation : survey.observations) {
    plan.tasks.push_back(task_of(survey, observation, recipe, options));
  }
  return plan;
}

std::string plan_text(const Plan& plan) {
  nlohmann::json tasks = nlohmann::json::array();
  for (const PlanTask& task : plan.tasks) tasks.push_back(to_json(task, tasks.size()));
  nlohmann::json survey = nlohmann::json::array();
  for (const std::string& path : plan.survey) survey.push_back(json_text_of(path));
  nlohmann::json json = {
      {"plan_version", kPlanVersion},          {"survey", std::move(survey)},
      {"session", json_text_of(plan.session)}, {"recipe", nlohmann::json::parse(recipe_text(plan.recipe))},
      {"notes", notes_to_json(plan.notes)},    {"tasks", std::move(tasks)}};
  if (plan.pings) json["pings"] = {plan.pings->first, plan.pings->last};
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

Result<Plan> plan_from_text(std::string_view text) {
  const auto json = parse_json(text);
  if (!json) return pass_on(json);
  return plan_from_json(*json);
}

Result<Plan> read_plan(const std::filesystem::path& path) {
  const auto json = read_json_file(path.string());
  if (!json) return pass_on(json);
  auto plan = plan_from_json(*json);
  if (!plan) return fail(plan.error().code, plan.error().text, {path.string()});
  return plan;
}

Result<std::vector<std::filesystem::path>> planned_survey(const std::filesystem::path& out) {
  const std::filesystem::path file = out / "plan.json";
  std::error_code absent;
  if (!std::filesystem::exists(file, absent)) return std::vector<std::filesystem::path>{};
  const auto plan = read_plan(file);
  if (!plan) return pass_on(plan);
  return std::vector<std::filesystem::path>(plan->survey.begin(), plan->survey.end());
}

}  // namespace sonar
