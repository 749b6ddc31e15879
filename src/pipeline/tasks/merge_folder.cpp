// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>

#include "base/number_text.h"
#include "io/atomic_file.h"
#include "io/csv.h"
#include "io/product_file.h"
#include "io/survey_layers.h"
#include "model/school_totals.h"
#include "pipeline/journal/earlier.h"
#include "pipeline/stages/placements.h"
#include "pipeline/tasks/merge.h"
#include "pipeline/tasks/plan.h"
#include "pipeline/tasks/survey_numbers.h"
#include "pipeline/tasks/task_record.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Those of whose pings a run was asked for some only.
std::vector<std::string> partly_run(const std::vector<ObservationProduct>& products) {
  std::vector<std::string> names;
  for (const ObservationProduct& product : products) {
    const bool partly = std::any_of(product.diagnostics.begin(), product.diagnostics.end(),
                                    [](const Diagnostic& note) { return note.code == DiagnosticCode::pings_left_out; });
    if (partly) names.push_back(product.observation);
  }
  return names;
}

json observation_json(const ObservationProduct& product) {
  json files = json::array();
  for (const InputFile& f : product.input_files)
    files.push_back({{"name", f.name}, {"size", f.size}, {"hash", f.hash}});
  std::map<std::string, std::int64_t> notes;
  for (const Diagnostic& note : product.diagnostics) ++notes[std::string(name(note.code))];
  const auto bad = std::count_if(product.pings.begin(), product.pings.end(), [](const auto& p) { return p.bad; });
  json out = {{"name", product.observation},
              {"product", "products/" + product.observation + ".nc"},
              {"title", product.title},
              {"source", product.source},
              {"history", product.history},
              {"pings", product.pings.size()},
              {"bad_pings", bad},
              {"schools", school_count(product)},
              {"input_hash", product.input_hash},
              {"input_files", files},
              {"notes", notes},
              {"grid", nullptr},
              {"first_time_utc", nullptr},
              {"last_time_utc", nullptr}};
  if (product.grid) {
    out["grid"] = {{"fans", product.grid->grid.fans()}, {"beams", product.grid->grid.beams()}};
  }
  if (!product.pings.empty()) {
    out["first_time_utc"] = iso_time(product.pings.front().time);
    out["last_time_utc"] = iso_time(product.pings.back().time);
  }
  return out;
}

json numbers_json(const std::vector<SurveyNumber>& numbers) {
  json out = json::array();
  for (const SurveyNumber& one : numbers) {
    out.push_back({{"survey_school", one.number},
                   {"source", one.source},
                   {"school_id", one.school_id},
                   {"first_time_ns", one.first_time},
                   {"last_time_ns", one.last_time}});
  }
  return out;
}

std::string survey_json(const MergeReport& report, const std::vector<SurveyNumber>& numbers) {
  json observations = json::array();
  std::size_t pings = 0;
  for (const ObservationProduct& product : report.survey.observations) {
    observations.push_back(observation_json(product));
    pings += product.pings.size();
  }
  json failures = json::array();
  for (const MergeFailure& f : report.failures) {
    const json observation = f.observation ? json(*f.observation) : json(nullptr);
    failures.push_back({{"observation", observation}, {"error", f.text}});
  }
  json notes = json::array();
  for (const Diagnostic& note : report.notes) {
    notes.push_back({{"code", name(note.code)}, {"file", note.file}, {"text", note.text}});
  }
  const std::vector<SchoolRow>& rows = report.survey.schools;
  const auto rejected =
      std::count_if(rows.begin(), rows.end(), [](const SchoolRow& s) { return s.status == "rejected"; });
  const auto over_a_cut = std::count_if(rows.begin(), rows.end(), [](const SchoolRow& s) {
    return !s.continues.empty() && !s.continues.starts_with(s.observation + "/");
  });
  const std::vector<CountedSchool> schools = counted_schools(report.survey.observations);
  json provenance = nullptr;
  if (!report.survey.observations.empty()) {
    const ObservationProduct& first = report.survey.observations.front();
    json recipe = json::parse(first.recipe_json, nullptr, false);
    if (recipe.is_discarded()) recipe = first.recipe_json;
    provenance = {{"sonar_explorer_version", first.program_version},
                  {"stage_versions", first.stage_versions},
                  {"recipe_hash", first.recipe_hash},
                  {"recipe", recipe}};
  }
  const json out = {{"summary",
                     {{"observations", report.survey.observations.size()},
                      {"pings", pings},
                      {"schools", schools.size()},
                      {"backscatter_total_m2", total_backscatter_m2(schools)},
                      {"school_rows", rows.size()},
                      {"school_rows_rejected", rejected},
                      {"school_rows_continued", std::ssize(rows) - rejected - std::ssize(schools)},
                      {"schools_continued_over_a_cut", over_a_cut},
                      {"school_pings", report.survey.school_pings.size()},
                      {"complete", report.failures.empty() && report.all_observed()}}},
                    {"provenance", provenance},
                    {"observations", observations},
                    {"failures", failures},
                    {"missing", report.missing},
                    {"not_run", report.not_run},
                    {"partly_run", report.partly_run},
                    {"notes", notes},
                    {"unplanned", report.unplanned},
                    {"survey_schools", numbers_json(numbers)}};
  // Texts may come from damaged files: what is no UTF-8 is replaced, never thrown over.
  return out.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

/// Finds what the plan has and the folder has not, and drops products that the plan does not know.
Result<void> hold_against_plan(const fs::path& out, const std::optional<std::string>& only,
                               std::vector<fs::path>& files, MergeReport& report) {
  const fs::path path = out / "plan.json";
  std::error_code error;
  if (!fs::exists(path, error)) return {};
  const auto plan = read_plan(path);
  if (!plan) return pass_on(plan);
  report.notes = plan->notes;
  report.all_planned = true;
  const auto planned = [&](const fs::path& file) {
    return std::any_of(plan->tasks.begin(), plan->tasks.end(),
                       [&](const PlanTask& task) { return task.observation == file.stem().string(); });
  };
  // A product of other files or other choices than the plan's is as good as none. One that cannot be read, or of another
  // recipe, is left to be refused as such; one whose masks were kept has a longer key.
  const std::string recipe = recipe_hash(plan->recipe);
  const auto stale = [&](const fs::path& file) {
    const auto key = read_product_key(file);
    return key && key->recipe_hash == recipe &&
           std::any_of(plan->tasks.begin(), plan->tasks.end(), [&](const PlanTask& task) {
             return task.observation == file.stem().string() && !key->input_hash.starts_with(task.key);
           });
  };
  std::erase_if(files, stale);
  for (const fs::path& file : files) {
    if (!planned(file)) report.unplanned.push_back(file.stem().string());
  }
  std::erase_if(files, [&](const fs::path& file) { return !planned(file); });
  for (const PlanTask& task : plan->tasks) {
    const bool there = std::any_of(files.begin(), files.end(),
                                   [&](const fs::path& file) { return file.stem().string() == task.observation; });
    report.all_planned = report.all_planned && there;
    const bool failed = std::any_of(report.failures.begin(), report.failures.end(),
                                    [&](const MergeFailure& f) { return f.observation == task.observation; });
    const bool asked = (!only || *only == task.observation) && has_pings(task, plan->pings);
    if (there || failed) continue;
    const auto record = asked ? read_record(out, task.observation) : std::nullopt;
    if (record && !record->error.empty()) {
      report.failures.push_back({task.observation, printable(record->error)});
    } else {
      (asked ? report.missing : report.not_run).push_back(task.observation);
    }
  }
  return {};
}

Result<void> write_map(const fs::path& out, const Survey& survey, const std::vector<fs::path>& files, Work& work) {
  auto map = SurveyMapWriter::create(out / "survey.gpkg", MapFormat::geopackage, survey.observations);
  if (!map) return pass_on(map);
  for (std::size_t i = 0; i < survey.observations.size(); ++i) {
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    auto product = read_product(files[i]);
    if (!product) return pass_on(product);
    // Rows come from the merge, which knows what continues what; masks from the file.
    ObservationProduct shown = survey.observations[i];
    shown.masks = std::move(product->masks);
    if (auto added = map->add(shown, ProductPlacements(shown)); !added) return added;
    work.progress("map", static_cast<std::int64_t>(i) + 1, static_cast<std::int64_t>(files.size()));
  }
  return map->finish();
}

}  // namespace

bool MergeReport::all_observed() const {
  return missing.empty() && not_run.empty() && partly_run.empty() &&
         std::ranges::none_of(failures, [](const MergeFailure& failure) { return failure.observation.has_value(); });
}

Result<std::vector<fs::path>> product_files(const fs::path& out) {
  std::error_code error;
  const fs::path inner = out / "products";
  const fs::path folder = fs::is_directory(inner, error) ? inner : out;
  if (!fs::is_directory(folder, error)) return fail(ErrorCode::not_found, "no such folder", {.file = out.string()});
  std::vector<fs::path> files;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const std::string file_name = it->path().filename().string();
    if (file_name.starts_with("obs-") && file_name.ends_with(".nc")) files.push_back(it->path());
  }
  if (error) return fail(ErrorCode::io, error.message(), {.file = folder.string()});
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return name_less(a.filename().string(), b.filename().string());
  });
  return files;
}

Result<MergeReport> merge_folder(const fs::path& out, std::vector<MergeFailure> failures, Work& work,
                                 const std::optional<std::string>& only) {
  MergeReport report;
  report.failures = std::move(failures);
  auto files = product_files(out);
  if (!files) return pass_on(files);
  std::error_code error;
  if (files->empty() && !fs::exists(out / "plan.json", error)) {
    return fail(ErrorCode::not_found, "there are no products in this folder", {.file = out.string()});
  }
  if (auto held = hold_against_plan(out, only, *files, report); !held) return pass_on(held);
  std::vector<ObservationProduct> products;
  std::vector<std::pair<std::string, fs::path>> sound;
  for (const fs::path& file : *files) {
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    auto product = read_product(file);
    if (!product) {
      report.failures.push_back({file.stem().string(), to_line(product.error())});
      report.all_planned = false;
      continue;
    }
    product->masks = {};
    product->background_db = {};
    sound.emplace_back(product->observation, file);
    products.push_back(std::move(*product));
    work.progress("merge", static_cast<std::int64_t>(products.size()), static_cast<std::int64_t>(files->size()));
  }
  if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
  auto survey = merge(std::move(products));
  if (!survey) return fail(survey.error().code, survey.error().text, {.file = out.string()});
  report.survey = std::move(*survey);
  std::sort(sound.begin(), sound.end(), [](const auto& a, const auto& b) { return name_less(a.first, b.first); });
  std::vector<fs::path> in_order;
  for (const auto& [observation, file] : sound) in_order.push_back(file);

  report.partly_run = partly_run(report.survey.observations);
  const std::vector<SurveyNumber> numbers = number_schools(report.survey, kept_numbers(out), report.all_observed());

  auto written = require_free_space(out, kLeastFreeBytes);
  if (written) written = write_csv_rows(out / "schools.csv", report.survey.schools);
  if (written) written = write_csv_rows(out / "school_pings.csv", report.survey.school_pings);
  if (written) written = write_map(out, report.survey, in_order, work);
  if (written) written = write_file(out / "survey.json", survey_json(report, numbers));
  if (!written) return pass_on(written);
  remove_leftovers(out);
  if (require_own_folder(out / "products")) remove_leftovers(out / "products");
  if (report.all_planned) forget_superseded(out, report.survey.observations);
  return report;
}

std::string merge_text(const MergeReport& report, const fs::path& out) {
  std::size_t pings = 0;
  for (const ObservationProduct& product : report.survey.observations) pings += product.pings.size();
  std::vector<std::string> without_fans;
  for (const ObservationProduct& product : report.survey.observations) {
    if (!product.grid) without_fans.push_back(product.observation);
  }
  std::string text = count_of(report.survey.observations.size(), "observation") + ", " + count_of(pings, "ping");
  if (without_fans.empty() || without_fans.size() < report.survey.observations.size()) {
    text += ", " + count_of(counted_schools(report.survey.observations).size(), "school");
  }
  text += "\n";
  if (!without_fans.empty()) {
    text += fmt::format("schools are not looked for in single-beam data, nor in beams that make no fans: {}\n",
                        fmt::join(without_fans, ", "));
  }
  const auto list = [&](const char* what, const std::vector<std::string>& names) {
    if (!names.empty()) text += fmt::format("{}: {}\n", what, fmt::join(names, ", "));
  };
  list("missing", report.missing);
  list("not asked for", report.not_run);
  list("asked for some pings only", report.partly_run);
  list("left out, not in plan.json", report.unplanned);
  for (const char* name : {"schools.csv", "school_pings.csv", "survey.gpkg", "survey.json"}) {
    text += (out / name).string() + "\n";
  }
  return text;
}

std::vector<std::string> note_lines(const MergeReport& report) {
  std::vector<std::string> lines;
  for (const ObservationProduct& product : report.survey.observations) {
    std::map<DiagnosticCode, std::pair<const Diagnostic*, std::size_t>> by_code;
    for (const Diagnostic& note : product.diagnostics) {
      // Of pings that were left out merge_text() tells: the user asked for that.
      if (note.code == DiagnosticCode::track_event || note.code == DiagnosticCode::propagation_ended ||
          note.code == DiagnosticCode::pings_left_out) {
        continue;
      }
      auto& [first, count] = by_code[note.code];
      if (count++ == 0) first = &note;
    }
    for (const auto& [code, said] : by_code) {
      const auto& [first, count] = said;
      const std::string what =
          to_line({ErrorCode::format, first->text, {first->file, first->offset, first->ping_index}});
      const std::string more = count > 1 ? fmt::format(" (and {} more)", count - 1) : std::string{};
      lines.push_back(fmt::format("{}: {}: {}{}", name(code), product.observation, what, more));
    }
  }
  return lines;
}

Result<MergeReport> merge_after(const fs::path& out, const RunReport& run, Work& work,
                                const std::optional<std::string>& only) {
  std::vector<MergeFailure> failures;
  for (const RunFailure& failure : run.failures) failures.push_back({failure.observation, to_line(failure.error)});
  return merge_folder(out, std::move(failures), work, only);
}

}  // namespace sonar
