// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "model/product.h"
#include "pipeline/survey/survey.h"

namespace sonar {

// Results of a run whose raw files are not at hand hold all but the samples.

/// A survey as its products tell it: raw_gone says why no ping of it can be read.
struct ResultsAlone {
  SurveyFiles survey;
  std::vector<std::shared_ptr<const ObservationProduct>> products;  ///< [observation], without background levels
  std::vector<std::string> notices;  ///< products that cannot be read, as a merge tells them
};

/// folders  work folders of runs; of an observation that several have, the first product that can be read is taken
/// why      no ping can be read
/// errors   not_found: they hold no product with pings; mismatch: one name stands for different pings; cancelled; as
///          read_product() where none can be read
[[nodiscard]] Result<ResultsAlone> open_results(std::span<const std::filesystem::path> folders, const std::string& why,
                                                Work& work);

/// The survey of products, in their order. Pings have the datagram times that the products' clocks were made of. Pure.
/// folder  where the raw files are expected
[[nodiscard]] SurveyFiles survey_of_products(std::span<const std::shared_ptr<const ObservationProduct>> products,
                                             const std::filesystem::path& folder = {});

}  // namespace sonar
