// SPDX-License-Identifier: Apache-2.0
#include "pipeline/recipe.h"

#include <fmt/format.h>

#include <memory>
#include <string>

#include "cli/chosen_recipe.h"
#include "cli/exit_codes.h"
#include "cli/verb.h"

namespace sonar {

void add_recipe(CLI::App& app, VerbRunner& run) {
  struct Arguments {
    std::string preset = "default";
    std::string validate;
    std::string calibration;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* verb = app.add_subcommand("recipe", "Print or check the parameters of every stage");
  verb->add_option("--preset", arguments->preset, "default, or paper: the 2007 paper to the letter");
  verb->add_option("--validate", arguments->validate, "Check this recipe file");
  verb->add_option("--calibration", arguments->calibration, kCalibrationHelp);
  verb->callback([arguments, &run] {
    run = [arguments] {
      if (!arguments->validate.empty()) {
        auto recipe = read_recipe(arguments->validate);
        if (recipe && !arguments->calibration.empty())
          recipe = chosen_recipe(arguments->validate, arguments->calibration);
        // Whatever is wrong with it, the verb was used rightly.
        if (!recipe) {
          sonar::report(recipe.error());
          return kExitFailed;
        }
        fmt::print("{}: a sound recipe, hash {}\n", arguments->validate, recipe_hash(*recipe));
        return kExitDone;
      }
      auto recipe = recipe_preset(arguments->preset);
      if (recipe && !arguments->calibration.empty()) {
        if (auto taken = take_calibration_file(*recipe, arguments->calibration); !taken) {
          return sonar::report(taken.error());
        }
      }
      if (!recipe) return sonar::report(recipe.error());
      fmt::print("{}", recipe_text(*recipe));
      return kExitDone;
    };
  });
}

}  // namespace sonar
