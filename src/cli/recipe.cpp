// SPDX-License-Identifier: Apache-2.0
#include "pipeline/recipe/recipe.h"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>

#include "cli/chosen_recipe.h"
#include "cli/exit_codes.h"
#include "cli/file_to_write.h"
#include "cli/log.h"
#include "cli/named_path.h"
#include "cli/one_of.h"
#include "cli/verb.h"
#include "io/atomic_file.h"
#include "pipeline/recipe/parameter_table.h"

namespace sonar {
namespace {

struct RecipeOptions {
  std::string preset = "default";
  std::string validate;
  Measured measured;
  bool describe = false;
  std::string out;
};

int check(const RecipeOptions& o) {
  auto recipe = read_recipe(o.validate);
  if (recipe) recipe = with_measured(std::move(*recipe), o.measured);
  if (!recipe) {
    report(recipe.error());
    return kExitFailed;  // whatever is wrong with it, the verb was used rightly
  }
  for (const std::string& note : recipe->notes) print_note(fmt::format("earlier-parameter: {}: {}", o.validate, note));
  fmt::print("{}: valid recipe, hash {}\n", o.validate, recipe_hash(*recipe));
  return kExitDone;
}

int print(const RecipeOptions& o) {
  const bool to_file = !o.out.empty() && o.out != kStandardOutput;
  if (to_file) {
    if (auto place = require_place(o.out); !place) return report(place.error());
  }
  const auto preset = recipe_preset(o.preset);
  if (!preset) return report(preset.error());
  auto recipe = with_measured(*preset, o.measured);
  if (!recipe) return report(recipe.error());
  std::string text = recipe_text(*recipe);
  if (o.describe) {
    ParameterTable table("The recipe as a whole");
    describe(table, *recipe);
    text = table.markdown();
  }
  if (!to_file) {
    fmt::print("{}", text);
    return kExitDone;
  }
  if (auto written = write_file(o.out, text); !written) return report(written.error());
  fmt::print("{}\n", o.out);
  return kExitDone;
}

/// What help says of parameters; the rest is for --describe.
std::string set_by_users() {
  ParameterTable table("");
  Recipe recipe;
  describe(table, recipe);
  return "Common parameters (--describe also lists the expert ones):\n" + table.basic_text();
}

}  // namespace

void add_recipe(CLI::App& app, VerbRunner& run) {
  const auto o = std::make_shared<RecipeOptions>();
  CLI::App* verb = app.add_subcommand("recipe", "Print or check the parameters of every stage");
  CLI::Option* preset = verb->add_option("--preset", o->preset, "default, or paper: the 2007 paper to the letter")
                            ->check(one_of({"default", "paper"}));
  CLI::Option* validate =
      verb->add_option("--validate", o->validate, "Check this recipe file")->excludes(preset)->check(named_file());
  add_measured_options(*verb, o->measured);
  verb->add_flag("--describe", o->describe, "Value, unit, range and meaning of every parameter, as Markdown tables")
      ->excludes(validate);
  verb->add_option("-o,--out", o->out, "File to write; default, and -: standard output")
      ->excludes(validate)
      ->check(named_file());
  verb->footer(set_by_users());
  verb->callback([o, &run] { run = [o] { return o->validate.empty() ? print(*o) : check(*o); }; });
}

}  // namespace sonar
