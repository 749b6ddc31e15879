// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/units.h"
#include "geo/sector.h"
#include "pipeline/commands/state.h"
#include "school/grow/mask_edit.h"

// A small still sea for tests of commands: 6 fans, 8 beams, 80 samples, 9 pings two seconds apart. Two schools of -40 dB
// lie in -90 dB of water in every ping: A and B, six samples apart. Channels count
// against the rows.
namespace sonar::test {

inline constexpr int kFans = 6;
inline constexpr int kBeams = 8;
inline constexpr int kSamples = 80;
inline constexpr int kPings = 9;
inline constexpr TimeNs kBegin = 1'600'000'000 * kSecondNs;

struct Block {
  int first_fan, last_fan, first_beam, last_beam, first_sample, last_sample;
};
inline constexpr Block kA{1, 3, 2, 4, 30, 37};
inline constexpr Block kB{1, 3, 2, 4, 44, 51};

inline TimeNs ping_time(int ping) { return kBegin + 2 * kSecondNs * ping; }
inline int channel_at(int fan, int beam) { return kFans * kBeams - 1 - (fan * kBeams + beam); }

inline BeamGrid small_grid() {
  BeamGrid grid;
  for (int f = 0; f < kFans; ++f) grid.elevation_deg.push_back(-30.0 + 5.0 * f);
  for (int b = 0; b < kBeams; ++b) grid.azimuth_deg.push_back(255.0 + 4.0 * b);
  grid.frequency_hz.assign(kFans, 90000.0);
  for (int row = 0; row < kFans * kBeams; ++row) grid.channel.push_back(kFans * kBeams - 1 - row);
  grid.vertical_width_deg.assign(grid.channel.size(), 6.0);
  grid.horizontal_width_deg.assign(grid.channel.size(), 4.0);
  return grid;
}

inline std::shared_ptr<const Volume> small_sea() {
  const Shape3 shape{kFans, kBeams, kSamples};
  auto volume = std::make_shared<Volume>(Volume{
      Array3<std::int16_t>(shape, static_cast<std::int16_t>(counts_from_db(-90.0))), Array3<SampleFlags>(shape)});
  for (const Block& block : {kA, kB}) {
    for (int f = block.first_fan; f <= block.last_fan; ++f) {
      for (int b = block.first_beam; b <= block.last_beam; ++b) {
        for (int s = block.first_sample; s <= block.last_sample; ++s) {
          volume->counts(f, b, s) = static_cast<std::int16_t>(counts_from_db(-40.0));
        }
      }
    }
  }
  for (int row = 0; row < kFans * kBeams; ++row) {
    for (int s = 0; s < 5; ++s) volume->flags.view().row(row)[static_cast<std::size_t>(s)] = SampleFlags::near_field;
  }
  return volume;
}

/// All voxels of a block, confidence 1.
inline PingMask block_mask(const Block& block) {
  PingMask mask;
  for (int f = block.first_fan; f <= block.last_fan; ++f) {
    for (int b = block.first_beam; b <= block.last_beam; ++b) {
      const int count = block.last_sample - block.first_sample + 1;
      mask.runs.push_back({f * kBeams + b, block.first_sample, count});
      mask.confidence.insert(mask.confidence.end(), static_cast<std::size_t>(count), 255);
    }
  }
  return mask;
}

/// The context and what it needs.
struct SmallSea {
  BeamGrid grid = small_grid();
  Sector sector = grid.sector({-0.2, 0.5, kSamples});
  std::shared_ptr<const Volume> volume = small_sea();

  [[nodiscard]] CommandContext context() const {
    CommandContext made;
    made.ping = [this](std::int64_t ping_index) -> Result<FilteredPing> {
      FilteredPing ping;
      ping.volume = volume;
      ping.placement.transducer = {60.0, 5.0};
      ping.time = ping_time(static_cast<int>(ping_index));
      return ping;
    };
    made.sector = &sector;
    made.grid = &grid;
    for (int i = 0; i < kPings; ++i) made.times.push_back(ping_time(i));
    made.limits = {0, kPings - 1};
    made.least_pings = 3;
    return made;
  }

  /// A and B as a detection would have found them, in all pings.
  [[nodiscard]] static JournalState detected() {
    std::vector<SchoolMasks> schools(2);
    for (int i = 0; i < kPings; ++i) {
      schools[0].pings.push_back({i, block_mask(kA), -50.0});
      schools[1].pings.push_back({i, block_mask(kB), -50.0});
    }
    schools[0].track_id = 1;
    schools[1].track_id = 2;
    return state_of_detected(std::move(schools));
  }
};

inline SchoolKey key_a(int ping = 0) { return {ping_time(ping), channel_at(2, 3), 33}; }
inline SchoolKey key_b(int ping = 0) { return {ping_time(ping), channel_at(2, 3), 47}; }
inline SeedKey seed_a() { return {channel_at(2, 3), 33}; }

inline PropagateCommand propagate_from(const SeedKey& seed) {
  PropagateCommand command;
  command.seeds = {seed};
  return command;
}

inline JournalLine line(std::int64_t n, int ping, const Command& command) {
  return line_of({n, kBegin + n * kSecondNs, "someone", ping_time(ping), command});
}

/// Everything that a state says.
inline std::string told(const JournalState& state) {
  std::string text;
  for (const auto& school : state.schools) {
    const SchoolRow& row = school->masks.decided;
    text += std::to_string(school->number) + " " + row.origin + row.status + row.species + row.comment + row.name +
            row.operator_name + std::to_string(row.decided_utc) + (school->by_hand ? "h" : "d");
    text += ended_at_reach(school->masks);
    for (const auto& there : school->masks.pings) {
      text += "|" + std::to_string(there.ping_index) + ":" + std::to_string(there.threshold_db);
      for (const Run& run : there.mask.runs) {
        text +=
            " " + std::to_string(run.row) + "," + std::to_string(run.first_sample) + "," + std::to_string(run.count);
      }
      text.append(there.mask.confidence.begin(), there.mask.confidence.end());
    }
    text += "\n";
  }
  for (const auto& event : state.events) text += event.kind + event.text + std::to_string(event.time);
  for (const auto& bad : state.bad_pings) text += std::to_string(bad.first) + "-" + std::to_string(bad.last);
  for (const auto& note : state.notes) text += note.text + "\n";
  return text;
}

}  // namespace sonar::test
