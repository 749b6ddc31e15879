// SPDX-License-Identifier: Apache-2.0
#include "session/recipes/recipe_editor.h"

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

/// "track.confirmation": what a parameter is part of.
std::string group_of(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  return dot == std::string::npos ? std::string() : name.substr(0, dot);
}

std::string title_of_group(std::string group) {
  std::replace(group.begin(), group.end(), '.', ',');
  std::string title;
  for (const char c : label_of(group, {})) title += c == ',' ? std::string(", ") : std::string(1, c);
  return title;
}

/// The recipe's parameters; those that every user sets are labelled with what they are part of, for they stand together.
class RecipeSource : public SourceOf<Recipe> {
 public:
  explicit RecipeSource(Parameters<Recipe>& parameters)
      : SourceOf<Recipe>(parameters), labelled_(parameters.properties()) {
    for (Property& one : labelled_) {
      if (one.basic && !group_of(one.name).empty())
        one.label = title_of_group(group_of(one.name)) + ": " + lower(one.label);
    }
  }
  [[nodiscard]] const std::vector<Property>& properties() const override { return labelled_; }

 private:
  std::vector<Property> labelled_;
};

Recipe for_files(Recipe recipe) {
  recipe.automatic = true;
  return recipe;
}

}  // namespace

RecipeEditor::RecipeEditor(ChangeQueue& queue, Recipe recipe)
    : parameters_(queue), source_(std::make_shared<RecipeSource>(parameters_)), defaults_(queue) {
  parameters_.assign(for_files(std::move(recipe)));
}

std::size_t RecipeEditor::changed() const {
  const auto& all = parameters_.properties();
  const Recipe& usual = defaults_.values();
  // Tables and curves are no parameters with a control, but they are changes.
  const std::size_t tables = static_cast<std::size_t>(!recipe().calibration.beams.empty()) +
                             static_cast<std::size_t>(!recipe().survey.sound_speed_profile.empty()) +
                             static_cast<std::size_t>(!recipe().current_profiles.empty()) +
                             static_cast<std::size_t>(!(recipe().growth_curve == usual.growth_curve));
  return tables + static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [this](const Property& one) {
           return *parameters_.value(one.name) != *defaults_.value(one.name);
         }));
}

std::vector<PanelSection> RecipeEditor::sections(std::string_view words, bool changed_alone) const {
  const std::string wanted = lower(words);
  const bool all = wanted.empty() && !changed_alone;
  PanelSection basic{"What a user sets", source_};
  basic.marks = true;
  std::vector<PanelSection> experts;
  for (const Property& one : parameters_.properties()) {
    if (one.name == kAsked || !holds(one, wanted)) continue;
    if (changed_alone && *parameters_.value(one.name) == *defaults_.value(one.name)) continue;
    if (one.basic) {
      basic.names.push_back(one.name);
      basic.notes.push_back({one.name, [sentence = one.tooltip] { return sentence; }});
      continue;
    }
    const std::string title = "For experts: " + title_of_group(group_of(one.name));
    if (experts.empty() || experts.back().title != title) {
      experts.push_back({title, source_});
      experts.back().marks = true;
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

Result<void> RecipeEditor::problem() const { return validate_recipe(recipe()); }

Result<void> RecipeEditor::save(const std::filesystem::path& file) const {
  if (auto valid = problem(); !valid) return valid;
  return write_recipe(file.string(), recipe());
}

}  // namespace sonar
