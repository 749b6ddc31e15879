// SPDX-License-Identifier: Apache-2.0
// The whole run per ping and its stages, on a synthetic survey: bench_stages [FOLDER] [PINGS]
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/units.h"
#include "pipeline/score/score.h"
#include "pipeline/stages/engine.h"
#include "pipeline/stages/group_water.h"
#include "pipeline/stages/observe.h"
#include "school/detect/detect.h"
#include "school/evidence/block_means.h"
#include "school/seabed/seabed.h"
#include "school/track/steady_masks.h"
#include "school/track/track.h"
#include "signal/flags.h"
#include "signal/median.h"
#include "synth/beam_table.h"
#include "synth/presets.h"
#include "synth/simulate.h"

namespace sonar {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

class Stopwatch {
 public:
  /// pings  that the body works for: a ping's share is told
  template <class Body>
  void time(const std::string& stage, const Body& body, double pings = 1.0) {
    const auto begin = Clock::now();
    body();
    times_[stage].push_back(milliseconds_since(begin) / pings);
  }
  void print() {
    fmt::print("one thread, a ping\n");
    for (auto& [stage, times] : times_) {
      std::sort(times.begin(), times.end());
      fmt::print("{:<36} median {:8.3f} ms   min {:8.3f} ms   n {}\n", stage, times[times.size() / 2], times.front(),
                 times.size());
    }
  }

 private:
  std::map<std::string, std::vector<double>> times_;
};

template <class T>
T must(Result<T> result) {
  if (result) return std::move(*result);
  fmt::print(stderr, "{}\n", to_line(result.error()));
  std::exit(1);
}

void must(const Result<void>& result) {
  if (result) return;
  fmt::print(stderr, "{}\n", to_line(result.error()));
  std::exit(1);
}

SurveyFiles make_survey(const std::filesystem::path& folder, int pings, Work& work) {
  if (!std::filesystem::exists(folder)) {
    synth::SurveyParams params = synth::survey_params(synth::Preset::standard);
    params.observations = 1;
    params.pings = pings;
    must(synth::simulate_survey(folder, params, synth::ms70_beams(), false, "bench", work));
  }
  const std::vector<std::filesystem::path> paths{folder};
  return must(open_survey(paths, {}, {}, {}, work));
}

/// The answer first: the products must find the schools that count before their making is timed.
void verify(const ObservationProduct& product, const std::filesystem::path& truth) {
  ScoreSide found;
  found.observations.push_back(product);
  const Score result = score(found, must(read_truth_side(truth)));
  double dice = 0.0;
  int counted = 0;
  for (const SchoolScore& school : result.schools) {
    if (!school.counted) continue;
    dice += school.dice;
    ++counted;
  }
  fmt::print("answer: {} schools that count, mean Dice {:.3f}, {} false\n", counted, counted > 0 ? dice / counted : 0.0,
             result.false_schools.size());
  if (counted == 0 || dice / counted < 0.8 || !result.false_schools.empty()) std::exit(1);
}

void time_ping_stages(const SurveyFiles& survey, const ObservationFiles& observation, Engine& engine,
                      const Recipe& recipe, Stopwatch& watch) {
  PowerVolume power;
  for (std::int64_t i = 0; i < std::min<std::int64_t>(engine.pings(), 40); ++i) {
    watch.time("1 read and lay on the grid",
               [&] { must(load_volume(survey, observation, static_cast<std::size_t>(i), power)); });
    StagedPing staged = must(engine.staged(i));
    watch.time("2 flags, Sv, median, seabed, means", [&] { staged = must(engine.staged(i)); });
    Array3<std::int16_t> filtered(staged.sv.counts.shape());
    watch.time("2   of which the median",
               [&] { median_into(staged.sv.counts.view(), staged.sv.flags.view(), recipe.median, filtered.view()); });
    Seabed seabed;
    watch.time("2   of which the seabed", [&] {
      seabed = find_seabed(filtered.view(), staged.sv.flags.view(), staged.background(), engine.sector(),
                           engine.grid().vertical_width_deg, recipe.seabed);
    });
    Array3<std::int16_t> means;
    watch.time("2   of which the block means", [&] {
      means = block_means(staged.sv.counts.view(), staged.sv.flags.view(), block_samples(engine.sector().range()));
    });
  }
}

/// The groups of pings that are judged together, as in the whole run; of the time of each a ping's share is told.
std::vector<DetectedPing> time_groups(const ObservationFiles& observation, Engine& engine, const Recipe& recipe,
                                      Stopwatch& watch) {
  std::vector<std::shared_ptr<StagedPing>> pings;
  for (std::int64_t i = 0; i < std::min<std::int64_t>(engine.pings(), 40); ++i) {
    pings.push_back(std::make_shared<StagedPing>(must(engine.staged(i))));
  }
  std::vector<DetectedPing> detected;
  constexpr auto kGroup = static_cast<std::size_t>(kGroupPings);
  for (std::size_t first = 0; first < pings.size(); first += kGroup) {
    const std::size_t end = std::min(pings.size(), first + kGroup);
    std::vector<std::optional<WaterLevels>> waters;
    watch.time(
        "3 water, told by a ping and 13 more", [&] { waters = waters_of(pings, first, end, engine.sector()); },
        static_cast<double>(end - first));
    for (std::size_t i = first; i < end; ++i) {
      const auto ping_index = static_cast<std::int64_t>(i);
      DetectedPing ping{ping_index, observation.navigation[i].time, engine.tracking_placement(ping_index), {}};
      watch.time("4 detect", [&] {
        ping.detections = detect(engine.echo(*pings[i], *waters[i - first]), recipe.detect, nullptr, &ping.refused);
      });
      detected.push_back(std::move(ping));
    }
  }
  return detected;
}

void time_stages(const SurveyFiles& survey, const ObservationFiles& observation, Work& work) {
  const Recipe recipe;
  Engine engine(survey, observation, recipe);
  must(engine.estimate_background(0, engine.pings() - 1, work));
  Stopwatch watch;
  time_ping_stages(survey, observation, engine, recipe, watch);
  const std::vector<DetectedPing> detected = time_groups(observation, engine, recipe, watch);
  const auto pings = static_cast<double>(detected.size());
  TrackParams params = recipe.track;
  params.confirmation.evidence = evidence_wanted(recipe.detect);
  for (int repeat = 0; repeat < 5; ++repeat) {
    Tracks tracks;
    watch.time(
        "5 tracks and their judges", [&] { tracks = track(detected, engine.sector(), engine.grid().channel, params); },
        pings);
    watch.time(
        "6 masks by the mean echo of sightings",
        [&] { steady_masks(tracks.schools, detected, engine.sector(), recipe.detect.tolerance_db); }, pings);
  }
  watch.print();
}

void time_run(const SurveyFiles& survey, const ObservationFiles& observation, const std::filesystem::path& truth,
              Work& work) {
  const auto pings = static_cast<double>(observation.pings.size());
  verify(must(observe(survey, observation, {}, {}, work)), truth);
  std::vector<double> per_ping;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const auto begin = Clock::now();
    must(observe(survey, observation, {}, {}, work));
    per_ping.push_back(milliseconds_since(begin) / pings);
  }
  std::sort(per_ping.begin(), per_ping.end());
  const double span_s =
      static_cast<double>(observation.navigation.back().time - observation.navigation.front().time) / 1e9;
  fmt::print("whole run, {} threads: median {:.2f} ms a ping (min {:.2f}), {:.0f} times real time\n", work.threads(),
             per_ping[2], per_ping[0], span_s * 1000.0 / (per_ping[2] * pings));
  rusage used{};
  if (getrusage(RUSAGE_SELF, &used) == 0) {
    fmt::print("most memory of this program, {1:.0f} pings: {0:.0f} MB\n", static_cast<double>(used.ru_maxrss) / 1000.0,
               pings);
  }
}

}  // namespace
}  // namespace sonar

int main(int argc, char** argv) {
  using namespace sonar;
  if (argc > 3 || (argc > 1 && argv[1][0] == '-')) {
    fmt::print("usage: bench_stages [FOLDER [PINGS]]   a synthetic survey is made there; default: 120 pings\n");
    return argc > 1 && std::string_view(argv[1]) == "--help" ? 0 : 2;
  }
  const std::filesystem::path folder =
      argc > 1 ? argv[1] : (std::filesystem::temp_directory_path() / "sonar-bench-stages").string();
  Work work;
  const SurveyFiles survey = make_survey(folder, argc > 2 ? std::atoi(argv[2]) : 120, work);
  time_stages(survey, survey.observations.front(), work);
  time_run(survey, survey.observations.front(), folder / "truth", work);
  return 0;
}
