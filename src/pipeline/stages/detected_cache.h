// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "model/product.h"
#include "pipeline/journal/school_numbers.h"
#include "pipeline/survey/survey.h"

namespace sonar {

// What was found in an observation is kept beside the journal that asks for it, which is opened again and again.

/// Where an observation's find is kept: one file each, written over when it is stale. Empty without a folder.
/// cache  whose folder lies beside the journal, or the user's
[[nodiscard]] std::filesystem::path detected_file(const IndexCache& cache, const SurveyFiles& survey,
                                                  const ObservationFiles& observation);
/// A find made from the same pings in the same way; empty where there is none, or a damaged one.
/// key  observation_key() of them
[[nodiscard]] std::optional<ObservationProduct> kept_detected(const std::filesystem::path& file,
                                                              const std::string& key);
/// What other versions found in these pings, for choices that name schools by voxels of theirs; null = nothing. A find of
/// theirs that lies in `file` is held on to first, in a folder beside it, for it will be written over.
/// stays  the file is this version's and need not be looked into
[[nodiscard]] std::shared_ptr<const EarlierSchools> earlier_found(const std::filesystem::path& file,
                                                                  const SurveyFiles& survey,
                                                                  const ObservationFiles& observation, bool stays);
/// Holds on to a product of another version for earlier_found(), before anybody chooses upon it.
/// file  detected_file()
void hold_earlier(const std::filesystem::path& file, const std::filesystem::path& product);
/// What cannot be kept is looked for again.
void keep_detected(const std::filesystem::path& file, const ObservationProduct& product);

}  // namespace sonar
