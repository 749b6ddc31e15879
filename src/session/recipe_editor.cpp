// SPDX-License-Identifier: Apache-2.0
#include "session/recipe_editor.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace sonar {
namespace {

/// Whether schools are detected is asked for in the window, not set.
constexpr std::string_view kAsked = "automatic";

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return std::tolower(c); });
  return out;
}

bool holds(const Property& one, const std::string& words) {
  return words.empty() || lower(one.name + " " + one.label + " " + one.tooltip).find(words) != std::string::npos;
}

Recipe for_files(Recipe recipe) {
  recipe.automatic = true;
  return recipe;
}

}  // namespace

RecipeEditor::RecipeEditor(ChangeQueue& queue, Recipe recipe)
    : parameters_(queue), source_(std::make_shared<SourceOf<Recipe>>(parameters_)), defaults_(queue) {
  parameters_.assign(for_files(std::move(recipe)));
}

std::size_t RecipeEditor::changed() const {
  const auto& all = parameters_.properties();
  return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [this](const Property& one) {
    return *parameters_.value(one.name) != *defaults_.value(one.name);
  }));
}

std::vector<PanelSection> RecipeEditor::sections(std::string_view words, bool changed_alone) const {
  const std::string wanted = lower(words);
  const bool all = wanted.empty() && !changed_alone;
  PanelSection basic{"What a user sets", source_};
  std::vector<PanelSection> experts;
  for (const Property& one : parameters_.properties()) {
    if (one.name == kAsked || !holds(one, wanted)) continue;
    if (changed_alone && *parameters_.value(one.name) == *defaults_.value(one.name)) continue;
    if (one.basic) {
      basic.names.push_back(one.name);
      basic.notes.push_back({one.name, [sentence = one.tooltip] { return sentence; }});
      continue;
    }
    const std::string title = "For experts: " + label_of(one.name.substr(0, one.name.find('.')), {});
    if (experts.empty() || experts.back().title != title) {
      experts.push_back({title, source_});
      experts.back().open = !all;
    }
    experts.back().names.push_back(one.name);
  }
  std::vector<PanelSection> out;
  if (!basic.names.empty()) out.push_back(std::move(basic));
  out.insert(out.end(), experts.begin(), experts.end());
  return out;
}

void RecipeEditor::take_defaults() { parameters_.assign(defaults_.values()); }

Result<void> RecipeEditor::load(const std::filesystem::path& file) {
  auto recipe = read_recipe(file.string());
  if (!recipe) return pass_on(recipe);
  parameters_.assign(for_files(std::move(*recipe)));
  return {};
}

Result<void> RecipeEditor::save(const std::filesystem::path& file) const {
  return write_recipe(file.string(), parameters_.values());
}

}  // namespace sonar
