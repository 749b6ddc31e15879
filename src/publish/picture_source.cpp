// SPDX-License-Identifier: Apache-2.0
#include "publish/picture_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/product_file.h"
#include "io/recordings.h"
#include "model/school_totals.h"
#include "pipeline/score/agree.h"
#include "pipeline/stages/observe.h"
#include "pipeline/tasks/join_tracks.h"
#include "pipeline/tasks/merge.h"
#include "pipeline/tasks/plan.h"
#include "pipeline/tasks/survey_numbers.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

bool is_work_folder(const fs::path& path) {
  std::error_code absent;
  return fs::is_directory(path / "products", absent);
}

/// What a user named, sorted into raw files and products.
struct Inputs {
  std::vector<fs::path> raw;
  std::vector<fs::path> products;
  std::vector<fs::path> run_on;       ///< the raw files that the products were made of
  std::vector<SurveyNumber> numbers;  ///< of schools in the survey
};

Result<Inputs> sorted_inputs(std::span<const fs::path> paths) {
  Inputs inputs;
  for (const fs::path& path : paths) {
    std::error_code absent;
    if (!fs::exists(path, absent)) return fail(ErrorCode::not_found, "no such file or folder", {path.string()});
    if (is_work_folder(path)) {
      const auto files = product_files(path);
      if (!files) return pass_on(files);
      inputs.products.insert(inputs.products.end(), files->begin(), files->end());
      for (SurveyNumber& kept : kept_numbers(path)) inputs.numbers.push_back(std::move(kept));
      // A newer program's plan keeps nobody from drawing.
      const auto run_on = planned_survey(path).value_or(std::vector<fs::path>{});
      inputs.run_on.insert(inputs.run_on.end(), run_on.begin(), run_on.end());
    } else if (has_ending(path, ".nc")) {
      inputs.products.push_back(path);
    } else {
      inputs.raw.push_back(path);
    }
  }
  return inputs;
}

Result<std::vector<ObservationProduct>> read_products(const std::vector<fs::path>& files, Work& work) {
  std::vector<ObservationProduct> products;
  for (const fs::path& file : files) {
    work.progress("reading products", static_cast<std::int64_t>(products.size()),
                  static_cast<std::int64_t>(files.size()));
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped");
    auto product = read_product(file);
    if (!product) return pass_on(product);
    products.push_back(std::move(*product));
  }
  const auto first = [](const ObservationProduct& p) { return p.pings.empty() ? TimeNs{0} : p.pings.front().time; };
  std::stable_sort(products.begin(), products.end(), [&](const auto& a, const auto& b) {
    return std::pair{first(a), a.observation} < std::pair{first(b), b.observation};
  });
  return products;
}

/// A product belongs to the observation whose pings it has: names may have moved on when files were added.
bool same_pings(const ObservationFiles& files, const ObservationProduct& product) {
  const auto& pings = files.navigation;
  return !pings.empty() && product.pings.size() == pings.size() && product.pings.front().time == pings.front().time &&
         product.pings.back().time == pings.back().time;
}

}  // namespace

DrawnObservation::DrawnObservation(const SurveyFiles* survey, const ObservationFiles* files,
                                   const ObservationProduct* product, const Recipe& recipe)
    : survey_(survey), files_(files), recipe_(recipe), product_(product) {
  if (product_ == nullptr) {
    made_ = std::make_unique<const ObservationProduct>(empty_product(*survey_, *files_, recipe, {}));
    product_ = made_.get();
  }
  if (files_ != nullptr && files_->grid) engine_ = std::make_unique<Engine>(*survey_, *files_, recipe);
}

std::string DrawnObservation::title() const {
  const bool synthetic = product_->title.find("SYNTHETIC") != std::string::npos;
  return synthetic ? name() + " SYNTHETIC" : name();
}

Result<Sector> DrawnObservation::sector() const {
  if (files_ != nullptr && files_->grid) return files_->sector();
  if (product_->grid) return product_->grid->grid.sector(product_->grid->range);
  std::string line = "the beams of " + name() + " make no grid of fans and beams to draw";
  const Diagnostics& notes = files_ != nullptr ? files_->diagnostics : product_->diagnostics;
  const auto why = std::find_if(notes.begin(), notes.end(), [](const Diagnostic& note) {
    return note.code == DiagnosticCode::no_grid || note.code == DiagnosticCode::no_common_range;
  });
  if (why == notes.end()) return fail(ErrorCode::unsupported, std::move(line));
  // "the beams make no product grid: ..." would say it twice.
  const auto reason = why->text.starts_with("the beams make no") ? why->text.find(": ") : std::string::npos;
  line += ": " + (reason == std::string::npos ? why->text : why->text.substr(reason + 2));
  return fail(ErrorCode::unsupported, std::move(line));
}

const std::vector<double>& DrawnObservation::frequency_hz() const {
  static const std::vector<double> none;
  if (files_ != nullptr && files_->grid) return files_->grid->frequency_hz;
  return product_->grid ? product_->grid->grid.frequency_hz : none;
}

DrawnPing DrawnObservation::ping_without_samples(std::int64_t ping_index) const {
  DrawnPing ping;
  ping.ping_index = ping_index;
  ping.navigation = product_->pings[static_cast<std::size_t>(ping_index)];
  for (const SchoolMask& school : product_->masks) {
    if (school.ping_index != ping_index) continue;
    const auto row = std::find_if(product_->schools.begin(), product_->schools.end(),
                                  [&](const SchoolRow& one) { return one.school_id == school.school_id; });
    // The product outlives every picture of it: the mask is borrowed, not copied.
    ping.masks.push_back(
        {school.school_id, std::shared_ptr<const PingMask>(std::shared_ptr<void>(), &school.mask),
         row == product_->schools.end() ? std::string{} : row->status,
         row != product_->schools.end() && row->origin == kDifferenceOrigin ? row->name : std::string{}});
  }
  return ping;
}

Result<DrawnPing> DrawnObservation::ping(std::int64_t ping_index, Work& work) {
  if (ping_index < 0 || ping_index >= pings()) {
    return fail(ErrorCode::usage,
                fmt::format("no ping {} in {}: it has pings 0 to {}", ping_index, name(), pings() - 1));
  }
  DrawnPing ping = ping_without_samples(ping_index);
  if (files_ == nullptr) return ping;
  if (!engine_) return pass_on(sector());
  if (auto known = engine_->estimate_background(ping_index, ping_index, work); !known) return pass_on(known);
  auto staged = engine_->kept_or_staged(ping_index);
  if (!staged) return pass_on(staged);
  ping.staged = std::move(*staged);
  ping.heard = ping.staged;
  return ping;
}

Result<std::unique_ptr<PictureSource>> PictureSource::open(std::span<const fs::path> paths,
                                                           const std::optional<Recipe>& recipe, Work& work,
                                                           bool quick) {
  auto inputs = sorted_inputs(paths);
  if (!inputs) return pass_on(inputs);
  auto source = std::make_unique<PictureSource>();
  auto products = read_products(inputs->products, work);
  if (!products) return pass_on(products);
  source->products_ = std::move(*products);
  recall_numbers(source->products_, inputs->numbers);
  source->run_on_ = std::move(inputs->run_on);
  if (recipe) {
    source->recipe_ = *recipe;
  } else if (!source->products_.empty()) {
    auto own = recipe_from_text(source->products_.front().recipe_json);
    if (!own) return pass_on(own);
    source->recipe_ = std::move(*own);
  }
  if (!inputs->raw.empty()) {
    const Recipe& known = source->recipe_;
    auto survey = quick ? glance_at_survey(inputs->raw, known.survey, known.navigation, work)
                        : open_survey(inputs->raw, known.survey, known.navigation, IndexCache::of_user(), work);
    if (!survey) return pass_on(survey);
    source->survey_ = std::make_shared<const SurveyFiles>(std::move(*survey));
  }
  source->match();
  if (source->observations_.empty()) {
    const std::string named = paths.empty() ? std::string() : paths.front().string();
    std::string line = "nothing to draw: neither raw files with pings nor products in it";
    if (const std::string why = source->why_no_pings(); !why.empty()) line += "; " + why;
    return fail(ErrorCode::usage, std::move(line), {named});
  }
  return source;
}

std::string PictureSource::why_no_pings() const {
  if (!survey_) return {};
  for (const SurveyFile& file : survey_->files) {
    if (!file.index.diagnostics.empty()) return file.index.diagnostics.front().text;
  }
  return survey_->diagnostics.empty() ? std::string{} : survey_->diagnostics.front().text;
}

void PictureSource::match() {
  join_over_cuts(products_);
  std::vector<bool> matched(products_.size());
  if (survey_) {
    for (const ObservationFiles& files : survey_->observations) {
      const ObservationProduct* own = nullptr;
      for (std::size_t i = 0; i < matched.size() && own == nullptr; ++i) {
        if (matched[i] || !same_pings(files, products_[i])) continue;
        own = &products_[i];
        matched[i] = true;
      }
      observations_.emplace_back(survey_.get(), &files, own, recipe_);
    }
  }
  for (std::size_t i = 0; i < matched.size(); ++i) {
    if (!matched[i]) observations_.emplace_back(nullptr, nullptr, &products_[i], recipe_);
  }
}

std::unique_ptr<PictureSource> PictureSource::of(std::shared_ptr<const SurveyFiles> survey,
                                                 std::vector<ObservationProduct> products, const Recipe& recipe) {
  auto source = std::make_unique<PictureSource>();
  source->survey_ = std::move(survey);
  source->products_ = std::move(products);
  source->recipe_ = recipe;
  source->match();
  return source;
}

Result<void> PictureSource::compare_with(const fs::path& other) {
  if (products_.empty()) return fail(ErrorCode::usage, "there are no products to compare with " + other.string());
  const auto b = read_result_side(other);
  if (!b) return pass_on(b);
  ScoreSide a;
  a.observations = products_;
  if (auto one = require_one_survey(a, "what is drawn", *b, other); !one) return one;
  std::vector<ObservationProduct> differences = difference_products(a, *b);
  // Observations point to the products: each stays where it is.
  std::move(differences.begin(), differences.end(), products_.begin());
  return {};
}

Result<void> PictureSource::require_outside_raw(const fs::path& file) const {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (auto outside = sonar::require_outside_raw(run_on_, folder); !outside || !survey_) return outside;
  return sonar::require_outside_raw(*survey_, folder);
}

Result<DrawnObservation*> PictureSource::observation(std::string_view name) {
  if (observations_.empty()) return fail(ErrorCode::usage, "nothing to draw: no schools are known yet");
  if (name.empty()) {
    const auto with_schools = std::find_if(observations_.begin(), observations_.end(), [](const auto& observation) {
      return school_count(observation.product()) > 0;
    });
    return with_schools != observations_.end() ? &*with_schools : &observations_.front();
  }
  std::string known;
  for (DrawnObservation& observation : observations_) {
    if (observation.name() == name) return &observation;
    known += (known.empty() ? "" : ", ") + observation.name();
  }
  return fail(ErrorCode::usage, fmt::format("no observation {}; there is {}", name, known));
}

}  // namespace sonar
