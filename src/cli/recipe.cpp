// SPDX-License-Identifier: Apache-2.0
#include "pipeline/recipe.h"

#include <fmt/format.h>

#include <memory>
#include <string>

#include "cli/exit_codes.h"
#include "cli/verb.h"

namespace sonar {

void add_recipe(CLI::App& app, VerbRunner& run) {
  struct Arguments {
    std::string preset = "default";
    std::string validate;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* verb = app.add_subcommand("recipe", "Print or check the parameters of every stage");
  verb->add_option("--preset", arguments->preset, "default, or paper: the 2007 paper to the letter");
  verb->add_option("--validate", arguments->validate, "Check this recipe file");
  verb->callback([arguments, &run] {
    run = [arguments] {
      if (!arguments->validate.empty()) {
        const auto recipe = read_recipe(arguments->validate);
        if (!recipe) return sonar::report(recipe.error());
        fmt::print("{}: a sound recipe, hash {}\n", arguments->validate, recipe_hash(*recipe));
        return kExitDone;
      }
      const auto recipe = recipe_preset(arguments->preset);
      if (!recipe) return sonar::report(recipe.error());
      fmt::print("{}", recipe_text(*recipe));
      return kExitDone;
    };
  });
}

}  // namespace sonar
