// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/detected_cache.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "base/hash.h"
#include "io/product_file.h"
#include "pipeline/journal/earlier.h"
#include "pipeline/stages/observe.h"

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
  auto product = read_product(file);
  if (!product || product->input_hash != key) return std::nullopt;
  return std::move(*product);
}

std::shared_ptr<const EarlierSchools> earlier_found(const std::filesystem::path& file, const SurveyFiles& survey,
                                                    const ObservationFiles& observation, bool stays) {
  if (file.empty()) return nullptr;
  const std::filesystem::path beside = std::filesystem::path(file).replace_extension();
  std::error_code absent;
  if (!stays && std::filesystem::exists(file, absent)) {
    const auto key = read_product_key(file);
    if (key && key->stage_versions != kStageVersions) (void)hold(beside, file, *key);
  }
  auto schools = EarlierProducts(beside).schools_of(source_of(observation), datagram_times(survey, observation));
  return schools ? std::make_shared<const EarlierSchools>(std::move(*schools)) : nullptr;
}

void hold_earlier(const std::filesystem::path& file, const std::filesystem::path& product) {
  const auto key = read_product_key(product);
  if (!file.empty() && key) (void)hold(std::filesystem::path(file).replace_extension(), product, *key);
}

void keep_detected(const std::filesystem::path& file, const ObservationProduct& product) {
  if (file.empty()) return;
  (void)write_product(product, file, Beside::own_folder);
}

}  // namespace sonar
