// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "synth/presets.h"

namespace sonar::synth {

struct SimulateResult {
  std::vector<std::filesystem::path> files;
  std::uint64_t bytes = 0;
  std::int64_t pings = 0;
  std::int64_t schools = 0;  ///< with at least one ping in the truth
};

/// Writes a synthetic survey: OUT/SYNTHETIC-Dyyyymmdd-Thhmmss.raw files, and OUT/truth beside them, with the seabed's
/// depths as truth/depth.tif.
/// force     write into a folder that already holds raw files
/// errors    bad_parameter; usage: the folder holds raw files; no_space; io; cancelled
/// threads   pings are made on work's threads; the bytes are the same for any number
[[nodiscard]] Result<SimulateResult> simulate_survey(const std::filesystem::path& out, const SurveyParams& params,
                                                     const std::vector<Beam>& beams, bool force,
                                                     const std::string& program_version, Work& work);

}  // namespace sonar::synth
