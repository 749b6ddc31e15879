// SPDX-License-Identifier: Apache-2.0
#include "synth/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>

#include "base/check.h"
#include "io/atomic_file.h"
#include "io/depth_raster.h"
#include "io/simrad/writer.h"
#include "synth/layout.h"
#include "synth/nmea.h"
#include "synth/seabed_grid.h"
#include "synth/sonar.h"
#include "synth/truth_files.h"

namespace sonar::synth {
namespace {

constexpr const char* kRawPrefix = "SYNTHETIC-D";
constexpr const char* kSurveyName = "SYNTHETIC survey, made by Sonar Explorer";
constexpr double kWaterTemperature_c = 8.0;

bool is_raw_file(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
  return extension == ".raw";
}

Result<void> prepare_folder(const std::filesystem::path& out, bool force) {
  std::error_code problem;
  std::filesystem::create_directories(out, problem);
  if (problem) return fail(ErrorCode::io, "cannot make the folder: " + problem.message(), {.file = out.string()});
  if (force) return {};
  for (const auto& entry : std::filesystem::directory_iterator(out, problem)) {
    if (is_raw_file(entry.path())) {
      return fail(ErrorCode::usage, "the folder already holds raw files; choose another, or --force",
                  {.file = out.string()});
    }
  }
  if (problem) return fail(ErrorCode::io, "cannot list the folder: " + problem.message(), {.file = out.string()});
  return {};
}

/// Takes an earlier survey out of the folder, so that no file of it stands among those of the next.
Result<void> remove_earlier(const std::filesystem::path& out) {
  std::error_code problem;
  std::vector<std::filesystem::path> earlier;
  for (const auto& entry : std::filesystem::directory_iterator(out, problem)) {
    if (is_raw_file(entry.path()) && entry.path().filename().string().starts_with(kRawPrefix)) {
      earlier.push_back(entry.path());
    }
  }
  const std::filesystem::path truth = out / "truth";
  for (const auto& entry : std::filesystem::directory_iterator(truth, problem)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("obs-") && name.ends_with(".nc")) earlier.push_back(entry.path());
  }
  for (const std::filesystem::path& file : earlier) {
    std::filesystem::remove(file, problem);
    if (problem) return fail(ErrorCode::io, "cannot remove: " + problem.message(), {.file = file.string()});
  }
  return {};
}

std::uint64_t bytes_of(const std::vector<Scene>& scenes) {
  constexpr std::uint64_t kRaw0 = 92;
  constexpr std::uint64_t kOther = 4096;  // navigation, and the product of the truth
  std::uint64_t bytes = 1 << 22;
  for (const Scene& scene : scenes) {
    std::uint64_t ping = kOther;
    for (const Beam& beam : scene.beams) ping += kRaw0 + 2 * static_cast<std::uint64_t>(beam.count);
    bytes += ping * static_cast<std::uint64_t>(scene.pings);
  }
  return bytes;
}

/// One ping's datagrams and its truth.
struct EncodedPing {
  TimeNs first_time = 0;  ///< of its first datagram
  RawBytes bytes;
  SyntheticPing made;
};

void append_navigation(RawBytes& bytes, const Scene& scene, TimeNs after, TimeNs until) {
  for (TimeNs t = (after / kSecondNs + 1) * kSecondNs; t <= until; t += kSecondNs) {
    const double seconds = static_cast<double>(t - scene.first_ping) / static_cast<double>(kSecondNs);
    for (const std::string& sentence : nmea_second(navigation_at(scene, seconds))) append_nme0(bytes, t, sentence);
  }
}

void append_channels(RawBytes& bytes, const SyntheticSonar& sonar, const SyntheticPing& made, int ping) {
  const Scene& scene = sonar.scene();
  const PingNavigation navigation = navigation_at(scene, scene.seconds_of(ping));
  std::vector<std::pair<int, int>> channel_and_row;
  for (std::size_t row = 0; row < sonar.channel_of_row().size(); ++row) {
    if (made.recorded[row]) channel_and_row.emplace_back(sonar.channel_of_row()[row], static_cast<int>(row));
  }
  std::sort(channel_and_row.begin(), channel_and_row.end());
  for (const auto& [channel, row] : channel_and_row) {
    const Beam& beam = scene.beams[static_cast<std::size_t>(channel)];
    ChannelPing raw;
    raw.channel = channel;
    raw.frequency_hz = beam.frequency_hz;
    raw.transmit_power_w = beam.power_w;
    raw.pulse_length_s = kPulseLength_s;
    raw.bandwidth_hz = 1.0 / kPulseLength_s;
    raw.sample_interval_s = kSampleInterval_s;
    raw.sound_speed_mps = kSoundSpeed_mps;
    raw.absorption_db_per_m = beam.absorption_db_per_m;
    raw.roll_deg = navigation.roll_deg;
    raw.pitch_deg = navigation.pitch_deg;
    raw.temperature_c = kWaterTemperature_c;
    raw.heading_deg = navigation.heading_deg;
    raw.mode = 1;
    raw.power_count = made.power.counts.view().row(row).first(static_cast<std::size_t>(beam.count));
    SONAR_CHECK(append_raw0(bytes, navigation.time, raw).has_value());
  }
}

EncodedPing encode(const SyntheticSonar& sonar, int ping) {
  const Scene& scene = sonar.scene();
  EncodedPing e;
  e.made = sonar.ping(ping);
  const TimeNs time = scene.time_of(ping);
  const TimeNs before = ping > 0 ? scene.time_of(ping - 1) : time - 2 * kSecondNs;
  e.first_time = std::min(time, (before / kSecondNs + 1) * kSecondNs);
  append_navigation(e.bytes, scene, before, time);
  append_channels(e.bytes, sonar, e.made, ping);
  // Two more seconds, so that the last ping lies between two fixes.
  if (ping + 1 == scene.pings) append_navigation(e.bytes, scene, time, time + 2 * kSecondNs);
  e.made.power = {};
  return e;
}

/// The survey's files, one after the other.
class SurveyFiles {
 public:
  SurveyFiles(std::filesystem::path folder, SounderConfig config, double file_mb)
      : folder_(std::move(folder)), config_(std::move(config)), limit_(static_cast<std::uint64_t>(file_mb * 1e6)) {
    config_.con1_xml = con1_xml(config_);
  }

  Result<void> add(const EncodedPing& ping) {
    if (file_ && file_->size() + ping.bytes.size() > limit_) {
      if (auto closed = close(); !closed) return closed;
    }
    if (!file_) {
      if (auto begun = begin(ping.first_time); !begun) return begun;
    }
    return file_->write(ping.bytes);
  }

  Result<void> close() {
    if (!file_) return {};
    auto finished = file_->finish();
    bytes_ += file_->size();
    file_.reset();
    return finished;
  }

  [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  Result<void> begin(TimeNs time) {
    auto file = RawFileWriter::create(folder_ / fmt::format("{}{}.raw", kRawPrefix, raw_name_time(time)));
    if (!file) return pass_on(file);
    file_.emplace(std::move(*file));
    files_.push_back(file_->path());
    RawBytes head;
    append_con0(head, time, config_);
    append_con1(head, time, config_.con1_xml);
    return file_->write(head);
  }

  std::filesystem::path folder_;
  SounderConfig config_;
  std::uint64_t limit_;
  std::optional<RawFileWriter> file_;
  std::vector<std::filesystem::path> files_;
  std::uint64_t bytes_ = 0;
};

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
      if (auto written = files.add(made[i]); !written) return written;
      truth.add(sonar.scene(), first + static_cast<int>(i), std::move(made[i].made));
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
  if (auto ready = prepare_folder(out, force); !ready) return pass_on(ready);
  if (auto room = require_free_space(out, bytes_of(*scenes)); !room) return pass_on(room);
  if (auto removed = force ? remove_earlier(out) : Result<void>(); !removed) return pass_on(removed);

  SimulateResult result;
  std::int64_t pings_in_all = 0;
  for (const Scene& scene : *scenes) pings_in_all += scene.pings;
  SurveyFiles files(out, sounder_config(sounding_beams(beams, params.beam_pattern), kSurveyName), params.file_mb);
  SurveyTruth truth(out / "truth", kSurveyName, program_version);
  for (std::size_t i = 0; i < scenes->size(); ++i) {
    const SyntheticSonar sonar((*scenes)[i]);
    ObservationTruth observation(fmt::format("obs-{:04d}", i + 1));
    const auto written = write_observation(sonar, files, observation, result.pings, pings_in_all, work);
    if (!written) return pass_on(written);
    result.pings += sonar.scene().pings;
    if (params.new_file_per_observation) {
      if (auto closed = files.close(); !closed) return pass_on(closed);
    }
    if (auto added = truth.add(std::move(observation), sonar); !added) return pass_on(added);
  }
  if (auto closed = files.close(); !closed) return pass_on(closed);
  if (auto done = truth.finish(); !done) return pass_on(done);
  const std::filesystem::path depths = out / "truth" / "depth.tif";
  if (auto done = write_depth_raster(depths, seabed_grid(*scenes), "SYNTHETIC seabed"); !done) return pass_on(done);
  result.files = files.files();
  result.bytes = files.bytes();
  result.schools = truth.schools();
  return result;
}

}  // namespace sonar::synth
