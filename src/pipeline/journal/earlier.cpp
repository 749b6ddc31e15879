// SPDX-License-Identifier: Apache-2.0
#include "pipeline/journal/earlier.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "base/hash.h"
#include "io/atomic_file.h"
#include "io/product_file.h"
#include "pipeline/tasks/merge.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const fs::path& out) { return out / "earlier"; }

TimeNs offset_ns(const std::string& recipe_json) {
  return static_cast<TimeNs>(std::llround(time_offset_s(recipe_json) * 1e9));
}

/// Unsigned inside: a foreign file's times may be as far apart as no difference can say.
TimeNs minus(TimeNs time, TimeNs offset) {
  return static_cast<TimeNs>(static_cast<std::uint64_t>(time) - static_cast<std::uint64_t>(offset));
}

/// What places its choices, or may do so when schools are found anew, is not in it.
bool needs_older(const ObservationProduct& product) {
  return std::any_of(product.diagnostics.begin(), product.diagnostics.end(), [](const Diagnostic& note) {
    return note.code == DiagnosticCode::decision_carried || note.code == DiagnosticCode::decision_lost;
  });
}

std::size_t shared_pings(const ObservationProduct& product, std::span<const TimeNs> times) {
  const TimeNs offset = offset_ns(product.recipe_json);
  return static_cast<std::size_t>(
      std::count_if(product.pings.begin(), product.pings.end(), [&](const PingNavigation& ping) {
        return std::binary_search(times.begin(), times.end(), minus(ping.time, offset));
      }));
}

}  // namespace

double time_offset_s(const std::string& recipe_json) {
  constexpr double kMost = 1e9;
  const auto json = nlohmann::json::parse(recipe_json, nullptr, false);
  if (!json.is_object() || !json.contains("navigation") || !json["navigation"].is_object()) return 0.0;
  const auto& navigation = json["navigation"];
  const auto found = navigation.find("time_offset_s");
  if (found == navigation.end() || !found->is_number()) return 0.0;
  const double seconds = found->get<double>();
  return std::abs(seconds) <= kMost ? seconds : 0.0;
}

Result<void> hold(const fs::path& out, const fs::path& product, const ProductKey& key) {
  const fs::path held = folder_of(out) / (to_hex(hash_text(key.input_hash + " " + key.source)) + ".nc");
  if (auto own = require_own_folder(held.parent_path()); !own) return own;
  std::error_code error;
  if (fs::exists(held, error)) return {};
  fs::create_directories(held.parent_path(), error);
  fs::create_hard_link(product, held, error);
  if (!error) return {};
  auto bytes = read_file(product);  // the file system knows no links
  if (!bytes) return pass_on(bytes);
  return write_file(held, *bytes, Beside::own_folder);
}

Result<void> set_aside(const fs::path& out, const Plan& plan) {
  std::error_code error;
  if (!fs::is_directory(out / "products", error)) return {};
  const auto files = product_files(out);
  if (!files) return pass_on(files);
  for (const fs::path& file : *files) {
    const auto key = read_product_key(file);
    if (!key || key->input_hash.empty()) continue;
    const bool right = std::any_of(plan.tasks.begin(), plan.tasks.end(), [&](const PlanTask& task) {
      return task.observation == file.stem().string() && task.key == key->input_hash;
    });
    if (right) continue;
    if (auto held = hold(out, file, *key); !held) return held;
  }
  return {};
}

EarlierProducts::EarlierProducts(const fs::path& out) {
  std::error_code error;
  for (fs::directory_iterator it(folder_of(out), error), end; !error && it != end; it.increment(error)) {
    if (it->path().extension() != ".nc" || it->path().filename().string().starts_with('.')) continue;
    const auto key = read_product_key(it->path());
    if (!key || key->pings == 0) continue;
    const TimeNs offset = offset_ns(key->recipe_json);
    entries_.push_back({it->path(), key->source, minus(key->first_time, offset), minus(key->last_time, offset)});
  }
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) { return a.path < b.path; });
}

std::vector<ObservationProduct> EarlierProducts::with_pings(const std::string& source,
                                                            std::span<const TimeNs> times) const {
  struct Ranked {
    std::size_t shared;
    std::int64_t next;
    ObservationProduct product;
  };
  std::vector<Ranked> ranked;
  for (const Entry& entry : entries_) {
    if (times.empty() || entry.source != source || entry.first > times.back() || entry.last < times.front()) continue;
    auto product = read_product(entry.path);
    if (!product) continue;
    product->background_db = {};
    const std::size_t shared = shared_pings(*product, times);
    if (shared > 0) ranked.push_back({shared, next_school_id(*product), std::move(*product)});
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
    return std::pair(a.shared, a.next) > std::pair(b.shared, b.next);
  });
  std::vector<ObservationProduct> products;
  for (Ranked& entry : ranked) products.push_back(std::move(entry.product));
  return products;
}

std::optional<EarlierSchools> EarlierProducts::schools_of(const std::string& source,
                                                          std::span<const TimeNs> times) const {
  EarlierSchools schools;
  for (ObservationProduct& product : with_pings(source, times)) {
    const double offset_s = time_offset_s(product.recipe_json);
    schools.add(std::move(product), offset_s);
  }
  if (schools.layers.empty()) return std::nullopt;
  return schools;
}

std::optional<ObservationProduct> EarlierProducts::of_pings(const std::string& source,
                                                            std::span<const TimeNs> times) const {
  for (ObservationProduct& product : with_pings(source, times)) {
    if (has_pings(product, source, times)) return std::move(product);
  }
  return std::nullopt;
}

bool has_pings(const ObservationProduct& product, const std::string& source, std::span<const TimeNs> times) {
  const TimeNs offset = offset_ns(product.recipe_json);
  return product.source == source &&
         std::equal(product.pings.begin(), product.pings.end(), times.begin(), times.end(),
                    [&](const PingNavigation& ping, TimeNs time) { return minus(ping.time, offset) == time; });
}

EarlierSchools numbers_of(const ObservationProduct& before) {
  EarlierSchools schools;
  ObservationProduct copy = before;
  copy.background_db = {};
  schools.add(std::move(copy), time_offset_s(before.recipe_json));
  return schools;
}

void forget_superseded(const fs::path& out, const std::vector<ObservationProduct>& finished) {
  if (!require_own_folder(folder_of(out))) return;
  std::error_code error;
  std::vector<fs::path> superseded;
  for (fs::directory_iterator it(folder_of(out), error), end; !error && it != end; it.increment(error)) {
    const auto key = read_product_key(it->path());
    if (!key) continue;
    const TimeNs offset = offset_ns(key->recipe_json);
    const auto inside = [&](TimeNs time) {
      return std::any_of(finished.begin(), finished.end(), [&](const ObservationProduct& product) {
        const TimeNs now = offset_ns(product.recipe_json);
        return product.source == key->source && !product.pings.empty() && !needs_older(product) &&
               minus(product.pings.front().time, now) <= time && time <= minus(product.pings.back().time, now);
      });
    };
    const bool gone = inside(minus(key->first_time, offset)) && inside(minus(key->last_time, offset));
    if (gone) superseded.push_back(it->path());
  }
  for (const fs::path& path : superseded) fs::remove(path, error);
  fs::remove(folder_of(out), error);  // only when it is empty
}

}  // namespace sonar
