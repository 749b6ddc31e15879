// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "synth/presets.h"
#include "synth/survey_files.h"

namespace sonar::synth {

/// Writes a synthetic survey: OUT/SYNTHETIC-Dyyyymmdd-Thhmmss.raw files, and OUT/truth beside them, with the seabed's
/// depths as truth/depth.tif.
/// force     write into a folder that already holds raw files
/// errors    bad_parameter; usage: the folder holds raw files, or results; no_space; io; cancelled
/// threads   pings are made on work's threads; the bytes are the same for any number
[[nodiscard]] Result<SimulateResult> simulate_survey(const std::filesystem::path& out, const SurveyParams& params,
                                                     const std::vector<Beam>& beams, bool force,
                                                     const std::string& program_version, Work& work);
/// The same of scenes that are there already: survey_scenes(), or part of them.
[[nodiscard]] Result<SimulateResult> simulate_scenes(const std::filesystem::path& out, const std::vector<Scene>& scenes,
                                                     const SurveyParams& params, const std::vector<Beam>& beams,
                                                     bool force, const std::string& program_version, Work& work);

}  // namespace sonar::synth
