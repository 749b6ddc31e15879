// SPDX-License-Identifier: Apache-2.0
// sonar_bench_reopen [REPETITIONS [GIGABYTES [FOLDER]]]: how long the desktop takes from the wish to open a survey with the results
// of a run to its first picture, to the first picture with schools, and to the figures of all schools. On the demo survey,
// and on a survey of 40 files that are made large (40 GB in all) by holes: it has few pings for its size, so that the time
// for what lies between them is what is added. Opened before, as a user's second visit finds it: indexed, measured, from
// memory. Each opening must show the schools of the products before it counts. What is made in FOLDER stays there, and is
// used again; without one it is made anew and taken away. Ends with 1 where a first picture with schools comes too late.
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "latency_clock.h"
#include "latency_targets.h"
#include "pipeline/tasks/plan.h"
#include "pipeline/tasks/run.h"
#include "session/app_model.h"
#include "synth/beam_table.h"
#include "synth/presets.h"
#include "synth/simulate.h"

namespace sonar::bench {
namespace {

namespace fs = std::filesystem;

constexpr PixelSize kSize{700, 500};
constexpr const char* kVersion = "bench";
constexpr int kLargeFiles = 40;
constexpr double kTargetDemo_ms = 1000.0;
constexpr double kTargetLarge_ms = 2000.0;

/// From the wish to open, ms.
struct Opening {
  double picture = 0.0;
  double schools = 0.0;
  double figures = 0.0;
};

/// A survey with the results of a run, and where its journal and the user's cache lie.
struct Case {
  std::string name;
  fs::path folder;
  double target_ms = 0.0;
  [[nodiscard]] fs::path raw() const { return folder / "raw"; }
  [[nodiscard]] fs::path out() const { return folder / "out"; }
  [[nodiscard]] IndexCache cache() const { return {folder / "cache"}; }
};

void simulate(const Case& survey, const synth::SurveyParams& params) {
  Work work;
  must(synth::simulate_survey(survey.raw(), params, synth::ms70_beams(), false, kVersion, work).has_value(),
       "no survey was made");
}

std::vector<fs::path> raw_files(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& file : fs::directory_iterator(folder)) {
    if (file.path().extension() == ".raw") files.push_back(file.path());
  }
  return files;
}

/// Holes behind the pings of each file, so that all of them have so many bytes.
void enlarge(const Case& survey, double bytes) {
  const auto files = raw_files(survey.raw());
  must(!files.empty(), "no raw files");
  const auto each = static_cast<std::uintmax_t>(bytes / static_cast<double>(files.size()));
  for (const fs::path& file : files) fs::resize_file(file, std::max(each, fs::file_size(file)));
}

/// What `sonarx run` leaves.
void run(const Case& survey) {
  const Recipe recipe;
  const std::vector<fs::path> paths{survey.raw()};
  Work work;
  const auto files = open_survey(paths, recipe.survey, recipe.navigation, survey.cache(), work);
  must(files.has_value(), "the survey cannot be read");
  const Plan plan = make_plan(*files, paths, {}, recipe, {{}, {}, kVersion});
  RunOptions options;
  options.out = survey.out();
  options.program_version = kVersion;
  const auto report = run_plan(plan, *files, {}, options, work);
  must(report && report->failures.empty(), "the run failed");
  std::ofstream(survey.out() / "plan.json") << plan_text(plan);
}

/// The plan is written last.
bool made(const Case& survey) { return fs::exists(survey.out() / "plan.json"); }

/// In a process of its own: what is timed reads products in copies of itself, which cost more the more memory it has used.
void make(const Case& survey, const std::function<void()>& body) {
  if (made(survey)) return;
  const pid_t child = ::fork();
  if (child == 0) {
    body();
    ::_exit(EXIT_SUCCESS);
  }
  int status = 0;
  must(child > 0 && ::waitpid(child, &status, 0) == child && status == 0 && made(survey), "no survey was made");
}

/// Whether a school lies in the ping on show.
bool shows_a_school(const Document& document) {
  const auto& staged = document.staged();
  if (!staged || staged->ping_index != document.ping()) return false;
  const auto& schools = document.state().schools;
  return std::any_of(schools.begin(), schools.end(),
                     [&](const auto& school) { return in_ping(school->masks, document.ping()) != nullptr; });
}

Opening open(const Case& survey) {
  ChangeQueue queue;
  DocumentOptions options;
  options.program_version = kVersion;
  options.cache = survey.cache();
  options.journal_folders = [&](const auto&) { return std::vector{survey.folder / "journal"}; };
  AppModel app(queue, options);
  Document& document = app.workspace.document;
  LivePicture& slice = *app.picture("top_slice");
  slice.resize(kSize, 1.0);
  slice.set_seen(true);
  // Pictures before that moment were asked for without the schools.
  std::optional<std::int64_t> without;
  const Listening heard_of(document.changes(), [&](DocumentChange) {
    if (!shows_a_school(document)) {
      without.reset();
    } else if (!without) {
      without = slice.pictures();
    }
  });
  Opening times;
  const double begin = now_ms();
  document.open({survey.out()});
  while (times.picture == 0.0 || times.schools == 0.0 || times.figures == 0.0) {
    queue.wait();
    queue.drain();
    const double now = now_ms() - begin;
    if (times.picture == 0.0 && slice.image().size == kSize && document.staged()) times.picture = now;
    if (times.schools == 0.0 && without && slice.pictures() > *without) times.schools = now;
    if (times.figures == 0.0 && document.all_measured() && !document.measuring()) times.figures = now;
  }
  document.settle();
  must(document.detected(document.shown()->index()), "the schools are not those of the run");
  return times;
}

double bytes_of(const Case& survey) {
  double bytes = 0.0;
  for (const fs::path& file : raw_files(survey.raw())) bytes += static_cast<double>(fs::file_size(file));
  return bytes;
}

void reopen(const Case& survey, int repetitions, LatencyTargets& targets) {
  (void)open(survey);  // measures
  std::vector<double> picture;
  std::vector<double> schools;
  std::vector<double> figures;
  for (int i = 0; i < repetitions; ++i) {
    const Opening times = open(survey);
    picture.push_back(times.picture);
    schools.push_back(times.schools);
    figures.push_back(times.figures);
  }
  fmt::print("{}, {:.2f} GB\n", survey.name, bytes_of(survey) / 1e9);
  fmt::print("{}\n", targets.line("first picture", picture, std::nullopt));
  fmt::print("{}\n", targets.line("first picture with schools", schools, survey.target_ms));
  fmt::print("{}\n", targets.line("all figures", figures, std::nullopt));
}

Case demo(const fs::path& folder) {
  Case survey{"demo", folder / "demo", kTargetDemo_ms};
  make(survey, [&] {
    simulate(survey, synth::survey_params(synth::Preset::demo));
    run(survey);
  });
  return survey;
}

Case large(const fs::path& folder, double gigabytes) {
  Case survey{"large, sparse", folder / "large", kTargetLarge_ms};
  synth::SurveyParams params = synth::survey_params(synth::Preset::easy);
  params.observations = kLargeFiles;
  params.pings = 12;
  params.schools = 2;
  make(survey, [&] {
    simulate(survey, params);
    enlarge(survey, gigabytes * 1e9);
    run(survey);
  });
  must(bytes_of(survey) > 0.999 * gigabytes * 1e9, "the survey that was made before is smaller than what is asked for");
  return survey;
}

int run(int repetitions, double gigabytes, const fs::path& kept) {
  const auto folder =
      kept.empty() ? fs::temp_directory_path() / fmt::format("sonar-bench-reopen-{}", ::getpid()) : kept;
  LatencyTargets targets(true);
  // Both before the first is opened: a process with threads is not doubled to work on.
  const std::vector<Case> surveys{demo(folder), large(folder, gigabytes)};
  for (const Case& survey : surveys) reopen(survey, repetitions, targets);
  fmt::print("{}\n", targets.verdict());
  std::error_code ignored;
  if (kept.empty()) fs::remove_all(folder, ignored);
  return targets.exit_code();
}

}  // namespace
}  // namespace sonar::bench

int main(int argc, char** argv) {
  return sonar::bench::run(argc > 1 ? std::max(1, std::atoi(argv[1])) : 9, argc > 2 ? std::atof(argv[2]) : 40.0,
                           argc > 3 ? argv[3] : "");
}
