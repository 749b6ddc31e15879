// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/result.h"
#include "io/raw_file_writer.h"
#include "synth/beam_table.h"
#include "synth/voyage.h"

namespace sonar::synth {

inline constexpr const char* kSurveyName = "SYNTHETIC survey, made by Sonar Explorer";

/// The folder of a survey while it is made: what is not kept in the end is taken out again, for half a survey looks like
/// a whole one. Move-only.
class SurveyFolder {
 public:
  /// Makes the folder.
  /// force     it may hold raw files, and an earlier simulated survey is taken out of it
  /// bytes     that the survey takes at most
  /// errors    io; no_space; usage: it holds raw files, or, forced or not, the results of a survey
  static Result<SurveyFolder> prepare(const std::filesystem::path& out, bool force, std::uint64_t bytes);
  SurveyFolder(SurveyFolder&& other) noexcept
      : out_(std::exchange(other.out_, {})), before_(std::move(other.before_)), made_(other.made_) {}
  SurveyFolder(const SurveyFolder&) = delete;
  SurveyFolder& operator=(const SurveyFolder&) = delete;
  SurveyFolder& operator=(SurveyFolder&&) = delete;
  ~SurveyFolder();
  void keep() { out_.clear(); }

 private:
  SurveyFolder(std::filesystem::path out, std::vector<std::filesystem::path> before, bool made)
      : out_(std::move(out)), before_(std::move(before)), made_(made) {}
  std::filesystem::path out_;                  ///< empty once kept
  std::vector<std::filesystem::path> before_;  ///< files of the kind that were there
  bool made_;                                  ///< it was not there before
};
/// What an observation takes on disk at most, its truth included.
[[nodiscard]] std::uint64_t bytes_of(const Voyage& voyage, const std::vector<Beam>& beams);

struct SimulateResult {
  std::vector<std::filesystem::path> files;
  std::uint64_t bytes = 0;
  std::int64_t pings = 0;
  std::int64_t schools = 0;  ///< with at least one ping in the truth
};

/// What one channel recorded in a ping.
struct ChannelCounts {
  int channel = 0;
  std::span<const std::int16_t> counts;  ///< [sample], re 1 W
};

/// One ping's datagrams, with what the instruments said since the ping before.
struct PingBytes {
  TimeNs first_time = 0;  ///< of its first datagram
  RawBytes bytes;
};
/// channels  rising
[[nodiscard]] PingBytes ping_bytes(const Voyage& voyage, int ping, const std::vector<Beam>& beams,
                                   const std::vector<ChannelCounts>& channels);

/// The survey's files, one after the other.
class SurveyFiles {
 public:
  SurveyFiles(std::filesystem::path folder, SounderConfig config, double file_mb);

  /// errors  io, no_space
  Result<void> add(const PingBytes& ping);
  /// The next ping begins a new file.
  /// errors  io, no_space
  Result<void> close();

  [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  Result<void> begin(TimeNs time);

  std::filesystem::path folder_;
  SounderConfig config_;
  std::uint64_t limit_;
  std::optional<RawFileWriter> file_;
  std::vector<std::filesystem::path> files_;
  std::uint64_t bytes_ = 0;
};

}  // namespace sonar::synth
