// SPDX-License-Identifier: Apache-2.0
#include "pipeline/detected_cache.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "base/hash.h"
#include "io/product.h"

namespace sonar {

std::filesystem::path detected_file(const IndexCache& cache, const SurveyFiles& survey,
                                    const ObservationFiles& observation) {
  if (cache.folder.empty() || observation.pings.empty()) return {};
  const SurveyPing& first = observation.pings.front();
  const std::string name = fmt::format("{}\n{}\ndetected", survey.files[first.file].index.hash, first.entry);
  return cache.folder / (to_hex(hash_text(name)) + ".detected.nc");
}

std::optional<ObservationProduct> kept_detected(const std::filesystem::path& file, const std::string& key) {
  std::error_code absent;
  if (file.empty() || !std::filesystem::exists(file, absent)) return std::nullopt;
  const auto known = read_product_key(file);
  if (!known || known->input_hash != key) return std::nullopt;
  auto product = read_product(file);
  if (!product) return std::nullopt;
  return std::move(*product);
}

void keep_detected(const std::filesystem::path& file, const ObservationProduct& product) {
  if (file.empty()) return;
  std::error_code failed;
  std::filesystem::create_directories(file.parent_path(), failed);
  (void)write_product(product, file);
}

}  // namespace sonar
