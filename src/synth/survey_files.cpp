// SPDX-License-Identifier: Apache-2.0
#include "synth/survey_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <utility>

#include "base/check.h"
#include "io/atomic_file.h"
#include "io/recordings.h"
#include "synth/nmea_sentences.h"

namespace sonar::synth {
namespace {

constexpr const char* kRawPrefix = "SYNTHETIC-D";
constexpr double kWaterTemperature_c = 8.0;
/// Beside the products; of both physics.
constexpr std::array<std::string_view, 8> kTruthFiles{"schools.csv", "school_pings.csv", "bodies.csv", "fish.csv",
                                                      "company.csv", "water.csv",        "beams.csv",  "depth.tif"};
/// By which a folder is told that holds the results of a survey.
constexpr std::array<std::string_view, 2> kOfResults{"plan.json", "products"};

void append_navigation(RawBytes& bytes, const Voyage& voyage, TimeNs after, TimeNs until) {
  for (TimeNs t = (after / kSecondNs + 1) * kSecondNs; t <= until; t += kSecondNs) {
    const double seconds = static_cast<double>(t - voyage.first_ping) / static_cast<double>(kSecondNs);
    for (const std::string& sentence : nmea_second(navigation_at(voyage, seconds))) append_nme0(bytes, t, sentence);
  }
}

void append_channels(RawBytes& bytes, const PingNavigation& navigation, const std::vector<Beam>& beams,
                     const std::vector<ChannelCounts>& channels) {
  for (const ChannelCounts& made : channels) {
    const Beam& beam = beams[static_cast<std::size_t>(made.channel)];
    ChannelPing raw;
    raw.channel = made.channel;
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
    raw.power_count = made.counts;
    SONAR_CHECK(append_raw0(bytes, navigation.time, raw).has_value());
  }
}

}  // namespace

namespace {

Result<void> require_free(const std::filesystem::path& out, bool force) {
  if (auto own = require_own_folder(out / "truth"); !own) return own;
  std::error_code problem;
  for (const std::string_view name : kOfResults) {
    // Beside raw files nothing of it could be written any more.
    if (std::filesystem::exists(out / name, problem)) {
      return fail(ErrorCode::usage, fmt::format("the folder holds a survey's results ({}); choose another", name),
                  {.file = out.string()});
    }
  }
  if (force) return {};
  for (const auto& entry : std::filesystem::directory_iterator(out, problem)) {
    if (is_named_raw(entry.path())) {
      return fail(ErrorCode::usage, "the folder already holds raw files; choose another, or --force",
                  {.file = out.string()});
    }
  }
  if (problem) return fail(ErrorCode::io, "cannot list the folder: " + problem.message(), {.file = out.string()});
  return {};
}

/// Files of a simulated survey; whatever else lies there is somebody's own.
std::vector<std::filesystem::path> simulated_files(const std::filesystem::path& out) {
  std::vector<std::filesystem::path> files;
  std::error_code absent;
  for (const auto& entry : std::filesystem::directory_iterator(out, absent)) {
    const bool ours = is_named_raw(entry.path()) && entry.path().filename().string().starts_with(kRawPrefix);
    if (ours) files.push_back(entry.path());
  }
  for (const auto& entry : std::filesystem::directory_iterator(out / "truth", absent)) {
    const std::string name = entry.path().filename().string();
    const bool product = name.starts_with("obs-") && name.ends_with(".nc");
    if (product || std::ranges::find(kTruthFiles, name) != kTruthFiles.end()) files.push_back(entry.path());
  }
  return files;
}

Result<void> remove_simulated(const std::filesystem::path& out, std::span<const std::filesystem::path> but) {
  if (auto own = require_own_folder(out / "truth"); !own) return own;
  for (const std::filesystem::path& file : simulated_files(out)) {
    if (std::ranges::find(but, file) != but.end()) continue;
    std::error_code problem;
    std::filesystem::remove(file, problem);
    if (problem) return fail(ErrorCode::io, "cannot remove: " + problem.message(), {.file = file.string()});
  }
  return {};
}

}  // namespace

Result<SurveyFolder> SurveyFolder::prepare(const std::filesystem::path& out, bool force, std::uint64_t bytes) {
  std::error_code problem;
  const bool made = std::filesystem::create_directories(out, problem);
  if (problem) return fail(ErrorCode::io, "cannot make the folder: " + problem.message(), {.file = out.string()});
  auto ready = require_free(out, force);
  if (ready) ready = require_free_space(out, bytes);
  if (ready && force) ready = remove_simulated(out, {});
  if (!ready) {
    if (made) std::filesystem::remove(out, problem);
    return pass_on(ready);
  }
  return SurveyFolder(out, simulated_files(out), made);
}

SurveyFolder::~SurveyFolder() {
  if (out_.empty()) return;
  (void)remove_simulated(out_, before_);
  std::error_code not_empty;
  std::filesystem::remove(out_ / "truth", not_empty);
  if (made_) std::filesystem::remove(out_, not_empty);
}

std::uint64_t bytes_of(const Voyage& voyage, const std::vector<Beam>& beams) {
  constexpr std::uint64_t kRaw0 = 92;
  constexpr std::uint64_t kOther = 4096;  // navigation, and the product of the truth
  std::uint64_t ping = kOther;
  for (const Beam& beam : beams) ping += kRaw0 + 2 * static_cast<std::uint64_t>(beam.count);
  return (1 << 21) + ping * static_cast<std::uint64_t>(voyage.pings);
}

PingBytes ping_bytes(const Voyage& voyage, int ping, const std::vector<Beam>& beams,
                     const std::vector<ChannelCounts>& channels) {
  PingBytes made;
  const TimeNs time = voyage.time_of(ping);
  const TimeNs before = ping > 0 ? voyage.time_of(ping - 1) : time - 2 * kSecondNs;
  made.first_time = std::min(time, (before / kSecondNs + 1) * kSecondNs);
  append_navigation(made.bytes, voyage, before, time);
  append_channels(made.bytes, navigation_at(voyage, voyage.seconds_of(ping)), beams, channels);
  // Two more seconds, so that the last ping lies between two fixes.
  if (ping + 1 == voyage.pings) append_navigation(made.bytes, voyage, time, time + 2 * kSecondNs);
  return made;
}

SurveyFiles::SurveyFiles(std::filesystem::path folder, SounderConfig config, double file_mb)
    : folder_(std::move(folder)), config_(std::move(config)), limit_(static_cast<std::uint64_t>(file_mb * 1e6)) {
  config_.con1_xml = con1_xml(config_);
}

Result<void> SurveyFiles::add(const PingBytes& ping) {
  if (file_ && file_->size() + ping.bytes.size() > limit_) {
    if (auto closed = close(); !closed) return closed;
  }
  if (!file_) {
    if (auto begun = begin(ping.first_time); !begun) return begun;
  }
  return file_->write(ping.bytes);
}

Result<void> SurveyFiles::close() {
  if (!file_) return {};
  auto finished = file_->finish();
  bytes_ += file_->size();
  file_.reset();
  return finished;
}

Result<void> SurveyFiles::begin(TimeNs time) {
  auto file = RawFileWriter::create(folder_ / fmt::format("{}{}.raw", kRawPrefix, raw_name_time(time)));
  if (!file) return pass_on(file);
  file_.emplace(std::move(*file));
  files_.push_back(file_->path());
  RawBytes head;
  append_con0(head, time, config_);
  append_con1(head, time, config_.con1_xml);
  return file_->write(head);
}

}  // namespace sonar::synth
