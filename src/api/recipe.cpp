// SPDX-License-Identifier: Apache-2.0
#include "sonar_explorer/recipe.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "api/throwing.h"
#include "pipeline/recipe/json_file.h"
#include "pipeline/recipe/recipe.h"
#include "sonar_explorer/version.h"

namespace sonar_explorer {
namespace {

std::shared_ptr<const sonar::Recipe> shared(sonar::Recipe recipe) {
  return std::make_shared<const sonar::Recipe>(std::move(recipe));
}

}  // namespace

std::string version() {
  return fmt::format("{}.{}.{}", SONAR_EXPLORER_VERSION_MAJOR, SONAR_EXPLORER_VERSION_MINOR,
                     SONAR_EXPLORER_VERSION_PATCH);
}

Recipe::Recipe() : own_(std::make_shared<const sonar::Recipe>()) {}

Recipe Recipe::preset(const std::string& name) { return Recipe(shared(value_or_throw(sonar::recipe_preset(name)))); }

Recipe Recipe::from_json(const std::string& text) {
  return Recipe(shared(value_or_throw(sonar::recipe_from_text(text))));
}

Recipe Recipe::from_file(const std::filesystem::path& file) {
  return Recipe(shared(value_or_throw(sonar::read_recipe(file.string()))));
}

std::string Recipe::to_json() const { return sonar::recipe_text(*own_); }

std::string Recipe::hash() const { return sonar::recipe_hash(*own_); }

const std::vector<std::string>& Recipe::notes() const { return own_->notes; }

Recipe Recipe::with(const std::string& name, const std::string& value) const {
  nlohmann::json json = value_or_throw(sonar::parse_json(to_json()));
  const nlohmann::json new_value = value_or_throw(sonar::parse_json(value));
  nlohmann::json* at = &json;
  for (std::size_t first = 0; first <= name.size();) {
    const std::size_t dot = std::min(name.find('.', first), name.size());
    const std::string member = name.substr(first, dot - first);
    if (!at->is_object() || !at->contains(member)) {
      raise({sonar::ErrorCode::bad_parameter, fmt::format("{}: no such parameter", name), {}});
    }
    at = &(*at)[member];
    first = dot + 1;
  }
  *at = new_value;
  return from_json(json.dump());
}

}  // namespace sonar_explorer
