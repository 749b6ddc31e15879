// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "geo/sector.h"
#include "model/mask.h"
#include "model/navigation.h"
#include "model/product.h"
#include "model/volume.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/stages/engine.h"
#include "pipeline/survey/survey.h"
#include "view/volume/school_trails.h"

namespace sonar {

/// A school's mask in one ping, to be drawn.
struct DrawnMask {
  std::int64_t school_id = 0;
  std::shared_ptr<const PingMask> mask;
  std::string status;     ///< of the school's review, SchoolRow::status
  std::string part = {};  ///< of a comparison with another reader: what this is, in place of a school's number
};

/// One ping as pictures need it. Without raw files the volume is empty and only masks are known.
struct DrawnPing {
  std::int64_t ping_index = 0;
  PingNavigation navigation;
  std::shared_ptr<const StagedPing> staged;  ///< null without raw files
  std::vector<DrawnMask> masks;              ///< by school_id; none without a product
  /// What was heard where the masks are: `staged`, but where that is interpolated between two pings the nearer of both.
  std::shared_ptr<const StagedPing> heard{};
};

/// One observation of a source: its raw files, its product, or both (matched by ping times, never by name).
class DrawnObservation {
 public:
  /// What is pointed to outlives this; files or product is there. Without a product one is made that lacks schools.
  DrawnObservation(const SurveyFiles* survey, const ObservationFiles* files, const ObservationProduct* product,
                   const Recipe& recipe);

  [[nodiscard]] const std::string& name() const { return product_->observation; }
  /// "obs-0001", with SYNTHETIC behind it where the data is.
  [[nodiscard]] std::string title() const;
  [[nodiscard]] std::int64_t pings() const { return static_cast<std::int64_t>(product_->pings.size()); }
  [[nodiscard]] const ObservationProduct& product() const { return *product_; }
  /// Whether the product was read, so that its schools are all there are.
  [[nodiscard]] bool has_product() const { return made_ == nullptr; }
  [[nodiscard]] bool has_raw() const { return files_ != nullptr; }
  /// errors  unsupported: the beams make no grid
  [[nodiscard]] Result<Sector> sector() const;
  [[nodiscard]] const std::vector<double>& frequency_hz() const;
  /// errors  usage (no such ping, with the range there is); unsupported (no grid); as Engine::staged()
  [[nodiscard]] Result<DrawnPing> ping(std::int64_t ping_index, Work& work);
  /// Masks and navigation alone; costs nothing.
  [[nodiscard]] DrawnPing ping_without_samples(std::int64_t ping_index) const;
  /// Null without raw files or without a grid.
  [[nodiscard]] Engine* engine() { return engine_.get(); }
  /// As Engine::rays(); null without an engine.
  [[nodiscard]] std::shared_ptr<const Refraction> rays() const { return engine_ ? engine_->rays() : nullptr; }
  /// Null without raw files, as the next.
  [[nodiscard]] const SurveyFiles* survey() const { return survey_; }
  [[nodiscard]] const ObservationFiles* files() const { return files_; }
  [[nodiscard]] const Recipe& recipe() const { return recipe_; }
  /// Keeps what one picture has made of the schools' masks for the next.
  [[nodiscard]] SchoolTrails& trails() { return *trails_; }

 private:
  const SurveyFiles* survey_;
  const ObservationFiles* files_;
  Recipe recipe_;
  std::unique_ptr<const ObservationProduct> made_;
  const ObservationProduct* product_;
  std::unique_ptr<Engine> engine_;
  std::unique_ptr<SchoolTrails> trails_ = std::make_unique<SchoolTrails>();
};

/// Everything that pictures are made from: a raw survey, a work folder of `run`, or both.
class PictureSource {
 public:
  /// paths   folders of raw files or raw files; work folders (with products/ in them) or product files
  /// recipe  empty = that of the products, or the default
  /// quick   of raw files the ends alone (glance_at_survey()): enough for a survey map
  /// errors  not_found, io, format; usage: nothing to draw in the paths
  [[nodiscard]] static Result<std::unique_ptr<PictureSource>> open(std::span<const std::filesystem::path> paths,
                                                                   const std::optional<Recipe>& recipe, Work& work,
                                                                   bool quick = false);

  /// Of a survey that is open, with products that are no files yet.
  [[nodiscard]] static std::unique_ptr<PictureSource> of(std::shared_ptr<const SurveyFiles> survey,
                                                         std::vector<ObservationProduct> products,
                                                         const Recipe& recipe);

  /// Shows from here on where the products differ from those of another reader (difference_products()). Before anything
  /// is drawn.
  /// errors  usage: no products to compare; mismatch: of another survey; as read_result_side()
  Result<void> compare_with(const std::filesystem::path& other);

  [[nodiscard]] std::vector<DrawnObservation>& observations() { return observations_; }
  [[nodiscard]] const std::vector<ObservationProduct>& products() const { return products_; }
  [[nodiscard]] bool has_raw() const { return survey_ != nullptr; }
  [[nodiscard]] const Recipe& recipe() const { return recipe_; }
  /// errors  usage: the file would lie in the folder of a raw file, be it drawn or what the products were made of
  [[nodiscard]] Result<void> require_outside_raw(const std::filesystem::path& file) const;
  /// Empty name = the first that has schools, else the first. errors: usage, naming those that there are
  [[nodiscard]] Result<DrawnObservation*> observation(std::string_view name);

 private:
  void match();
  /// What was noted first while the raw files were read; may be empty.
  [[nodiscard]] std::string why_no_pings() const;

  std::shared_ptr<const SurveyFiles> survey_;
  std::vector<ObservationProduct> products_;   ///< by first ping
  std::vector<std::filesystem::path> run_on_;  ///< raw files that a plan beside the products names
  Recipe recipe_;
  std::vector<DrawnObservation> observations_;
};

}  // namespace sonar
