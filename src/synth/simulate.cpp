// SPDX-License-Identifier: Apache-2.0
#include "synth/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/atomic_file.h"
#include "io/depth_raster.h"
#include "synth/layout.h"
#include "synth/seabed_grid.h"
#include "synth/sonar.h"
#include "synth/survey_files.h"
#include "synth/truth_files.h"

namespace sonar::synth {
namespace {

/// One ping's datagrams and its truth.
struct EncodedPing {
  PingBytes raw;
  SyntheticPing made;
};

EncodedPing encode(const SyntheticSonar& sonar, int ping) {
  const Scene& scene = sonar.scene();
  EncodedPing e;
  e.made = sonar.ping(ping);
  std::vector<ChannelCounts> channels;
  for (std::size_t row = 0; row < sonar.channel_of_row().size(); ++row) {
    if (!e.made.recorded[row]) continue;
    const int channel = sonar.channel_of_row()[row];
    const auto count = static_cast<std::size_t>(scene.beams[static_cast<std::size_t>(channel)].count);
    channels.push_back({channel, e.made.power.counts.view().row(static_cast<int>(row)).first(count)});
  }
  std::sort(channels.begin(), channels.end(),
            [](const ChannelCounts& a, const ChannelCounts& b) { return a.channel < b.channel; });
  e.raw = ping_bytes(scene, ping, scene.beams, channels);
  e.made.power = {};
  return e;
}

/// Pings are made some at a time on all threads and written in order.
Result<void> write_observation(const SyntheticSonar& sonar, SurveyFiles& files, ObservationTruth& truth,
                               std::int64_t pings_before, std::int64_t pings_in_all, Work& work) {
  const int pings = sonar.scene().pings;
  const int batch = 4 * work.threads();
  for (int first = 0; first < pings; first += batch) {
    std::vector<EncodedPing> made(static_cast<std::size_t>(std::min(batch, pings - first)));
    work.for_each(static_cast<std::int64_t>(made.size()), [&](std::int64_t i) {
      made[static_cast<std::size_t>(i)] = encode(sonar, first + static_cast<int>(i));
    });
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    for (std::size_t i = 0; i < made.size(); ++i) {
      if (auto written = files.add(made[i].raw); !written) return written;
      const Scene& scene = sonar.scene();
      truth.add(navigation_at(scene, scene.seconds_of(first + static_cast<int>(i))), std::move(made[i].made.schools),
                std::move(made[i].made.bodies));
    }
    work.progress("simulate", pings_before + first + static_cast<std::int64_t>(made.size()), pings_in_all);
  }
  return {};
}

}  // namespace

Result<SimulateResult> simulate_survey(const std::filesystem::path& out, const SurveyParams& params,
                                       const std::vector<Beam>& beams, bool force, const std::string& program_version,
                                       Work& work) {
  const auto scenes = survey_scenes(params, beams);
  if (!scenes) return pass_on(scenes);
  return simulate_scenes(out, *scenes, params, beams, force, program_version, work);
}

Result<SimulateResult> simulate_scenes(const std::filesystem::path& out, const std::vector<Scene>& scenes,
                                       const SurveyParams& params, const std::vector<Beam>& beams, bool force,
                                       const std::string& program_version, Work& work) {
  std::uint64_t bytes = 0;
  for (const Scene& scene : scenes) bytes += bytes_of(scene, scene.beams);
  auto folder = SurveyFolder::prepare(out, force, bytes);
  if (!folder) return pass_on(folder);

  SimulateResult result;
  std::int64_t pings_in_all = 0;
  for (const Scene& scene : scenes) pings_in_all += scene.pings;
  SurveyFiles files(out, sounder_config(sounding_beams(beams, params.beam_pattern), kSurveyName), params.file_mb);
  SurveyTruth truth(out / "truth", kSurveyName, program_version);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const SyntheticSonar sonar(scenes[i]);
    ObservationTruth observation(fmt::format("obs-{:04d}", i + 1));
    const auto written = write_observation(sonar, files, observation, result.pings, pings_in_all, work);
    if (!written) return pass_on(written);
    result.pings += sonar.scene().pings;
    if (params.new_file_per_observation) {
      if (auto closed = files.close(); !closed) return pass_on(closed);
    }
    if (auto added = truth.add(std::move(observation), sonar.grid()); !added) return pass_on(added);
  }
  if (auto closed = files.close(); !closed) return pass_on(closed);
  if (auto done = truth.finish(); !done) return pass_on(done);
  const std::filesystem::path depths = out / "truth" / "depth.tif";
  if (auto done = write_depth_raster(depths, seabed_grid(scenes), "SYNTHETIC seabed"); !done) return pass_on(done);
  result.files = files.files();
  result.bytes = files.bytes();
  result.schools = truth.schools();
  folder->keep();
  return result;
}

}  // namespace sonar::synth
