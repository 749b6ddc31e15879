// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/check.h"
#include "session/slices/test_slices.h"
#include "session/tools/seed_tool.h"

namespace sonar {

/// The tool of seeds at a bright school of the small simulated survey, for tests.
class SeedToolApp {
 protected:
  Workspace& workspace() { return app_.workspace(); }
  Document& document() { return app_.document(); }
  const Voxel& bright() { return SlicesApp::bright().voxel; }
  SeedTool& tool() { return *app_.app.seed_tool; }

  /// What grows from the voxel, by the science's own function.
  PingMask fresh(const Voxel& voxel) {
    FilteredPing ping;
    ping.volume = document().staged()->filtered;
    const SeedKey seed = seed_key(*document().shown(), voxel);
    const auto grown = grow_seeds(document().shown()->context(), ping, std::span(&seed, 1), workspace().growth_curve(),
                                  grow_params(workspace().select.values()));
    return grown ? *grown : PingMask{};
  }
  PingMask mask_of(std::size_t school) {
    const auto* there = in_ping(document().state().schools[school]->masks, document().ping());
    return there == nullptr ? PingMask{} : there->mask;
  }
  std::vector<std::string> journal() {
    std::vector<std::string> commands;
    const auto read = read_journal(document().journal_path().string());
    if (read) {
      for (const JournalLine& line : read->lines) commands.push_back(line.command);
    }
    return commands;
  }
  void press(bool shift = false, bool control = false, bool twice = false) {
    tool().press(bright(), shift, control, twice);
  }
  void set_tolerance(double db) {
    SONAR_CHECK(workspace().select.set("tolerance_db", db));
    app_.queue.drain();
  }
  /// As long as parameters rest before a growth is done anew.
  void rest() {
    app_.app.animations.tick(10.0);
    app_.app.animations.tick(10.0 + SeedTool::kRest_s);
    app_.settle();
  }

  SlicesApp app_;
};

}  // namespace sonar
