// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "base/result.h"
#include "base/work.h"
#include "synth/array/params.h"
#include "synth/survey_files.h"

namespace sonar::synth::array {

/// Writes a synthetic survey by array elements and single fish, on the MS70's grid: raw files as simulate_survey writes
/// them, and OUT/truth with fish.csv, company.csv, beams.csv and water.csv beside what that one has; sphere.csv, where there
/// is a sphere.
/// force     write into a folder that already holds raw files
/// errors    bad_parameter; usage: the folder holds raw files, or results; no_space; io; cancelled
/// threads   pings are made on work's threads; the bytes are the same for any number
[[nodiscard]] Result<SimulateResult> simulate_array_survey(const std::filesystem::path& out, const ArrayParams& params,
                                                           bool force, const std::string& program_version, Work& work);

}  // namespace sonar::synth::array
