// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/chosen_recipe.h"
#include "cli/exit_codes.h"
#include "cli/log.h"
#include "cli/named_path.h"
#include "cli/numbers.h"
#include "cli/progress.h"
#include "cli/run_survey.h"
#include "cli/slurm_template.h"
#include "cli/verb.h"
#include "io/atomic_file.h"
#include "io/external_command.h"
#include "pipeline/recipe/json_file.h"
#include "pipeline/tasks/run_survey.h"
#include "pipeline/tasks/task_cost.h"
#include "pipeline/tasks/task_states.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

struct SubmitOptions {
  RunArguments run;
  std::string partition;
  std::string account;
  std::string time;
  int cpus = 2;
  bool dry_run = false;
};

/// What Slurm allows where nobody has said otherwise.
constexpr std::size_t kUsualArraySize = 1001;
/// Other machines, disks that many read at once: so much more than reckoned is asked for.
constexpr double kTimeMargin = 4.0;
constexpr double kMemoryMargin = 1.5;
constexpr double kRead_mb_per_s = 20.0;
constexpr double kLeastTime_min = 10.0;
constexpr double kMerge_mb = 1000.0;

struct Asked {
  double time_min = kLeastTime_min;
  double memory_mb = 0.0;
  double core_hours = 0.0;  ///< reckoned, of all
  double read_gb = 0.0;
};

Asked asked_for(const Opened& opened, const std::vector<std::size_t>& tasks, int cpus) {
  Asked asked;
  for (const std::size_t i : tasks) {
    const ObservationFiles* observation = opened.survey.find(opened.plan.tasks[i].observation);
    const TaskCost cost = task_cost(opened.survey, *observation, cpus);
    asked.time_min = std::max(asked.time_min, (cost.cpu_s * kTimeMargin + cost.read_mb / kRead_mb_per_s) / 60.0);
    asked.memory_mb = std::max(asked.memory_mb, cost.memory_mb * kMemoryMargin);
    asked.core_hours += cost.cpu_s / 3600.0;
    asked.read_gb += cost.read_mb / 1000.0;
  }
  return asked;
}

std::string time_text(double minutes) {
  const auto whole = static_cast<long>(std::ceil(minutes / 5.0)) * 5;
  return fmt::format("{}:{:02}:00", whole / 60, whole % 60);
}

std::string filled(std::string text, const std::map<std::string, std::string>& places) {
  for (const auto& [name, value] : places) {
    const std::string place = "@" + name + "@";
    for (std::size_t at = text.find(place); at != std::string::npos; at = text.find(place, at + value.size())) {
      text.replace(at, place.size(), value);
    }
  }
  return text;
}

/// A script with the words that it is handed to sbatch by.
struct Script {
  fs::path file;
  std::string text;
};

struct Submission {
  std::vector<Script> arrays;
  Script merge;
  fs::path logs;
};

std::string own_path() {
  std::error_code unknown;
  const fs::path self = fs::read_symlink("/proc/self/exe", unknown);
  return unknown ? "sonarx" : self.string();
}

Submission make_scripts(const SubmitOptions& options, const fs::path& out, const std::vector<std::size_t>& tasks,
                        const Asked& asked, std::size_t array_size) {
  std::string choices;
  if (!options.partition.empty()) choices += "#SBATCH --partition=" + options.partition + "\n";
  if (!options.account.empty()) choices += "#SBATCH --account=" + options.account + "\n";
  std::map<std::string, std::string> places = {
      {"JOB_NAME", "sonarx"},
      {"CPUS", fmt::format("{}", options.cpus)},
      {"MEMORY_MB", fmt::format("{:.0f}", std::ceil(asked.memory_mb / 100.0) * 100.0)},
      {"TIME", options.time.empty() ? time_text(asked.time_min) : options.time},
      {"CHOICES", choices},
      {"SONARX", shell_word(own_path())},
      {"PLAN", shell_word((out / "plan.json").string())},
      {"OUT", shell_word(out.string())}};
  Submission made;
  made.logs = out / "slurm" / "logs";
  std::map<std::size_t, std::vector<std::size_t>> blocks;  // Slurm's indices end somewhere, the plan's tasks need not
  for (const std::size_t task : tasks) blocks[task / array_size].push_back(task % array_size);
  for (const auto& [block, indices] : blocks) {
    places["ARRAY"] = index_list(indices);
    places["FIRST_TASK"] = fmt::format("{}", block * array_size);
    const std::string name = block == 0 ? "sonarx-survey.sbatch" : fmt::format("sonarx-survey-{}.sbatch", block);
    made.arrays.push_back({out / "slurm" / name, filled(std::string(slurm_template("sonarx-survey.sbatch")), places)});
  }
  places["MEMORY_MB"] = fmt::format("{:.0f}", kMerge_mb);
  made.merge = {out / "slurm" / "sonarx-merge.sbatch",
                filled(std::string(slurm_template("sonarx-merge.sbatch")), places)};
  return made;
}

/// What another program said over several lines, as one.
std::string joined_lines(std::string_view text) {
  std::string joined;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    if (!line.empty()) joined += (joined.empty() ? "" : "; ") + std::string(line);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return joined;
}

/// The job of an array that was handed in; "--parsable" says "57" or "57;cluster".
Result<std::string> hand_in(const Script& script, const fs::path& logs, const std::string& after) {
  std::vector<std::string> words = {"sbatch", "--parsable", "--chdir=" + logs.string()};
  if (!after.empty()) words.push_back("--dependency=" + after);
  words.push_back(script.file.string());
  const auto said = run_command(words);
  if (!said) return fail(said.error().code, said.error().text + ": is Slurm installed here? --dry-run needs none");
  if (said->exit_code != 0) {
    return fail(ErrorCode::io, fmt::format("sbatch refused: {}", joined_lines(said->errors)), {script.file.string()});
  }
  return said->output.substr(0, said->output.find_first_of(";\n"));
}

std::size_t array_size() {
  const auto said = run_command({"scontrol", "show", "config"});
  if (!said || said->exit_code != 0) return kUsualArraySize;
  const std::size_t at = said->output.find("MaxArraySize");
  const std::size_t number = at == std::string::npos ? at : said->output.find_first_of("0123456789", at);
  if (number == std::string::npos) return kUsualArraySize;
  const long size = std::strtol(said->output.c_str() + number, nullptr, 10);
  return size > 0 ? static_cast<std::size_t>(size) : kUsualArraySize;
}

/// Jobs of an earlier submission that Slurm still has.
std::string jobs_in_queue(const fs::path& out) {
  const auto json = read_json_file((out / "slurm" / "jobs.json").string());
  if (!json || !json->is_object() || !json->contains("array_jobs") || !json->at("array_jobs").is_array()) return {};
  std::string jobs;
  for (const auto& job : json->at("array_jobs")) {
    if (job.is_string()) jobs += (jobs.empty() ? "" : ",") + job.get<std::string>();
  }
  if (jobs.empty()) return {};
  const auto said = run_command({"squeue", "--noheader", "--jobs=" + jobs, "--format=%A"});
  return said && said->exit_code == 0 && !said->output.empty() ? jobs : std::string{};
}

Result<void> write_scripts(const Submission& made, const fs::path& out) {
  if (auto own = require_own_folder(out / "slurm"); !own) return own;
  if (auto own = require_own_folder(made.logs); !own) return own;
  std::error_code error;
  fs::create_directories(made.logs, error);  // Slurm fails a task without a word where its log cannot be made
  if (error) return fail(ErrorCode::io, error.message(), {.file = made.logs.string()});
  for (const Script& script : made.arrays) {
    if (auto written = write_file(script.file, script.text); !written) return written;
  }
  return write_file(made.merge.file, made.merge.text);
}

int submit_scripts(const Submission& made, const fs::path& out, std::size_t tasks) {
  if (auto written = write_scripts(made, out); !written) return report(written.error());
  std::vector<std::string> jobs;
  std::string after = "afterany";  // the merge says what is missing, so that it comes whatever the tasks' end
  for (const Script& script : made.arrays) {
    const auto job = hand_in(script, made.logs, "");
    if (!job) return report(job.error());
    fmt::print("array job {}: {}\n", *job, script.file.string());
    jobs.push_back(*job);
    after += ":" + *job;
    // Kept at once: what was handed in is known, whatever follows.
    if (auto kept = write_json_file((out / "slurm" / "jobs.json").string(), {{"array_jobs", jobs}, {"merge_job", ""}});
        !kept) {
      return report(kept.error());
    }
  }
  const auto merge = hand_in(made.merge, made.logs, after);
  if (!merge) return report(merge.error());
  fmt::print("merge job {}: {}\n{} tasks; sonarx status {} tells how they stand\n", *merge, made.merge.file.string(),
             tasks, out.string());
  const auto kept =
      write_json_file((out / "slurm" / "jobs.json").string(), {{"array_jobs", jobs}, {"merge_job", *merge}});
  return kept ? kExitDone : report(kept.error());
}

int run_submit(const SubmitOptions& options) {
  const fs::path out = fs::absolute(options.run.out).lexically_normal();
  if (const std::string jobs = options.dry_run ? std::string{} : jobs_in_queue(out); !jobs.empty()) {
    return report({ErrorCode::usage,
                   fmt::format("job {0} of this folder is still in Slurm's queue: wait for it, or scancel {0}", jobs),
                   {out.string()}});
  }
  Work work(options.run.jobs);
  const CancelOnInterrupt watch(work);
  show_progress(work);
  const RunSources sources = sources_of(options.run);
  auto opened = open_for_run(sources, work);
  clear_progress();
  if (!opened) return report(opened.error());
  RunOptions plan;
  plan.out = out;
  plan.program_version = SONAR_VERSION;
  if (auto outside = require_outside_raw(opened->survey, out); !outside) return report(outside.error());
  if (auto written = write_plan(*opened, sources, plan); !written) return report(written.error());
  for (const RunLine& line : failure_lines(opened->survey, failed_files(opened->survey))) print_line(line);
  std::vector<std::size_t> tasks;
  for (const TaskStatus& task : task_states(opened->plan, out, is_alive)) {
    if (task.state != TaskState::done && task.state != TaskState::running) tasks.push_back(task.task);
  }
  if (tasks.empty()) {
    fmt::print("{} tasks, all done: sonarx merge {}\n", opened->plan.tasks.size(), out.string());
    return kExitDone;
  }
  const Asked asked = asked_for(*opened, tasks, options.cpus);
  const Submission made = make_scripts(options, out, tasks, asked, options.dry_run ? kUsualArraySize : array_size());
  if (options.dry_run) {
    for (const Script& script : made.arrays) fmt::print("# {}\n{}\n", script.file.string(), script.text);
    fmt::print("# {}\n{}", made.merge.file.string(), made.merge.text);
    return kExitDone;
  }
  fmt::print("{} of {} tasks are to be done: {:.2g} core hours, {:.3g} GB to read\n", tasks.size(),
             opened->plan.tasks.size(), asked.core_hours, asked.read_gb);
  return submit_scripts(made, out, tasks.size());
}

/// Of names that stand in a script's line as they are.
CLI::Validator plain_word(const std::string& kind) {
  return {[](std::string& text) {
            const bool plain = !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
              return std::isalnum(c) != 0 || c == '_' || c == '-' || c == ',' || c == '.' || c == ':';
            });
            return plain ? std::string{} : "expected letters, digits and _-,.: alone";
          },
          kind};
}

/// Whether Slurm would read it as a time limit.
bool is_slurm_time(std::string_view text) {
  const std::string word = CLI::detail::to_lower(std::string(text));
  if (word == "unlimited" || word == "infinite") return true;
  const auto is_number = [](std::string_view part) {
    return !part.empty() && std::ranges::all_of(part, [](unsigned char c) { return std::isdigit(c) != 0; });
  };
  if (const std::size_t dash = text.find('-'); dash != std::string_view::npos) {
    if (!is_number(text.substr(0, dash))) return false;
    text.remove_prefix(dash + 1);
  }
  for (int numbers = 1; numbers <= 3; ++numbers) {
    const std::size_t colon = text.find(':');
    if (!is_number(text.substr(0, colon))) return false;
    if (colon == std::string_view::npos) return true;
    text.remove_prefix(colon + 1);
  }
  return false;
}

CLI::Validator slurm_time() {
  return {[](std::string& text) {
            return std::string(is_slurm_time(text) ? "" : "expected M, M:S, H:M:S, D-H, D-H:M, D-H:M:S or UNLIMITED");
          },
          "TIME"};
}

}  // namespace

void add_submit(CLI::App& app, VerbRunner& run) {
  const auto options = std::make_shared<SubmitOptions>();
  CLI::App* verb = app.add_subcommand(
      "submit", "Hand a survey to Slurm: a job array with a task for each observation, then a job that merges");
  verb->add_option("SURVEY", options->run.survey, "Folder of raw files, or raw files")->required();
  verb->add_option("-o,--out", options->run.out, "Work folder for products and tables, seen by all nodes")
      ->required()
      ->check(named_folder());
  verb->add_option("--recipe", options->run.recipe, "Parameters of every stage (see sonarx recipe)")
      ->check(named_file());
  add_measured_options(*verb, options->run.measured);
  verb->add_option("--session", options->run.session,
                   "Journal of decisions to replay, or the folder of several people's")
      ->check(named_path());
  verb->add_option("--partition", options->partition, "Slurm's partition")->check(plain_word("NAME"));
  verb->add_option("--account", options->account, "Slurm's account")->check(plain_word("NAME"));
  verb->add_option("--time", options->time, "Time limit of a task, as Slurm writes it; reckoned if not given")
      ->check(slurm_time());
  verb->add_option("--cpus", options->cpus, "Cores of a task")->check(whole_within(1, 1024));
  verb->add_flag("--dry-run", options->dry_run, "Write the plan and print the scripts, hand in nothing");
  verb->callback([options, &run] { run = [options] { return run_submit(*options); }; });
}

}  // namespace sonar
