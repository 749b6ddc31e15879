// SPDX-License-Identifier: Apache-2.0
#include "pipeline/survey/write_survey.h"

#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "io/atomic_file.h"
#include "io/product_file.h"

namespace sonar {

Result<std::vector<std::filesystem::path>> write_products(const SurveyFiles& survey,
                                                          const std::filesystem::path& folder,
                                                          const ProductSource& product, Work& work) {
  if (auto outside = require_outside_raw(survey, folder); !outside) return pass_on(outside);
  std::error_code error;
  if (std::filesystem::exists(folder / "plan.json", error)) {
    return fail(ErrorCode::usage, "holds the results of a run; choose another folder", {folder.string()});
  }
  if (auto space = require_free_space(folder, kLeastFreeBytes); !space) return pass_on(space);
  std::vector<std::filesystem::path> files;
  const std::size_t count = survey.observations.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto made = product(i);
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    if (!made) return pass_on(made);
    files.push_back(product_path(folder, made->observation));
    if (auto written = write_product(*made, files.back(), Beside::own_folder); !written) return pass_on(written);
    work.progress("products", static_cast<std::int64_t>(i) + 1, static_cast<std::int64_t>(count));
  }
  return files;
}

Result<MergeReport> write_survey(const SurveyFiles& survey, const std::filesystem::path& folder,
                                 const ProductSource& product, Work& work) {
  const auto files = write_products(survey, folder, product, work);
  if (!files) return pass_on(files);
  return merge_folder(folder, {}, work);
}

}  // namespace sonar
