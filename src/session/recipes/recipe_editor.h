// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/recipe/recipe.h"
#include "session/recipes/parameter_source.h"

namespace sonar {

struct RecipeComparison;

/// A recipe in a human's hands: the 15 parameters that every user sets first, each with its sentence, then the experts',
/// by group.
/// threads  the window's
class RecipeEditor {
 public:
  RecipeEditor(ChangeQueue& queue, Recipe recipe);

  [[nodiscard]] const Recipe& recipe() const { return parameters_.values(); }
  /// To listen to: they change with every edit.
  [[nodiscard]] Parameters<Recipe>& parameters() { return parameters_; }
  /// Slices before and after the edit, for as long as a human is at it; null = none are shown.
  void show(RecipeComparison* comparison) { comparison_ = comparison; }
  [[nodiscard]] RecipeComparison* comparison() const { return comparison_; }
  /// How many parameters are not as in the preset default.
  [[nodiscard]] std::size_t changed() const;
  /// Sections with the parameters that hold these words in their name or sentence; empty = all.
  /// changed_alone  and are not as in the preset default
  [[nodiscard]] std::vector<PanelSection> sections(std::string_view words, bool changed_alone) const;

  /// What keeps it from being used or saved: values that do not go together.
  /// errors  bad_parameter
  [[nodiscard]] Result<void> problem() const;
  /// The preset default, without tables of calibration and sound speed.
  void take_defaults();
  /// errors  as read_recipe()
  [[nodiscard]] Result<void> load(const std::filesystem::path& file);
  /// For `sonarx run --recipe`.
  /// errors  as problem(); io, no_space; usage: a recording stands there
  [[nodiscard]] Result<void> save(const std::filesystem::path& file) const;

 private:
  Parameters<Recipe> parameters_;
  std::shared_ptr<ParameterSource> source_;
  Parameters<Recipe> defaults_;
  RecipeComparison* comparison_ = nullptr;
};

}  // namespace sonar
