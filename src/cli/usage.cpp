// SPDX-License-Identifier: Apache-2.0
#include "cli/usage.h"

#include <fmt/format.h>

#include "cli/suggestion.h"

namespace sonar {
namespace {

/// "; did you mean --out?", or nothing.
std::string meant_text(const std::string& word, const std::vector<std::string>& known) {
  const std::string meant = suggestion(word, known);
  return meant.empty() ? "" : fmt::format("; did you mean {}?", meant);
}

/// The verb that was asked for; the program itself where none was.
const CLI::App& asked(const CLI::App& app) {
  const auto verbs = app.get_subcommands();
  return verbs.empty() ? app : *verbs.front();
}

/// "there is no option --ouf; did you mean --out?"; empty where no option was too many.
std::string unknown_option_text(const CLI::App& app, const std::vector<std::string>& over) {
  std::vector<std::string> known;
  for (const CLI::Option* option : asked(app).get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  }
  for (const std::string& word : over) {
    if (!word.starts_with("-")) continue;
    const std::string name = word.substr(0, word.find('='));
    return fmt::format("there is no option {}{}", name, meant_text(name, known));
  }
  return {};
}

/// "--seed: x is no whole number", as the checks in cli/numbers.h say it.
std::string conversion_text(const CLI::Option& option) {
  const std::string text = option.results().empty() ? "" : option.results().back();
  const bool whole = option.get_type_name().starts_with("INT");
  // All digits, and still not taken.
  const bool large = text.find_first_not_of("0123456789", text.starts_with("-") ? 1 : 0) == std::string::npos;
  return fmt::format("{}: {} is {}", option.get_name(), text,
                     !whole  ? "no number"
                     : large ? "out of range"
                             : "no whole number");
}

/// The option that the parser's line names: "Could not convert: --seed = x", "--out: ..."; null where it names none.
const CLI::Option* option_of(const CLI::App& app, const std::string& told) {
  for (const std::string& word : CLI::detail::split(told, ' ')) {
    const CLI::Option* option = asked(app).get_option_no_throw("--" + CLI::detail::trim_copy(word, "-:"));
    if (option != nullptr) return option;
  }
  return nullptr;
}

}  // namespace

std::vector<std::string> verb_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(verb->get_name());
  return names;
}

std::string no_verb_text(const CLI::App& app, const std::string& name) {
  return fmt::format("there is no verb '{}'{}", name, meant_text(name, verb_names(app)));
}

std::string usage_text(const CLI::App& app, const CLI::ParseError& error, std::span<char*> words) {
  const std::string first = words.size() > 1 ? words[1] : "";
  // The parser misses a verb before it looks at what stands in its place.
  const bool is_verb = !app.get_subcommands([&](const CLI::App* verb) { return verb->get_name() == first; }).empty();
  if (!first.empty() && first[0] != '-' && !is_verb) return no_verb_text(app, first);
  const bool extra = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
  const bool missing = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
  const std::vector<std::string> over = app.remaining(true);
  if (extra || missing) {
    if (std::string text = unknown_option_text(app, over); !text.empty()) return text;
  }
  if (extra && !over.empty()) return fmt::format("'{}' is one word too many", over.front());
  if (missing && app.get_subcommands().empty()) return "a verb is needed";
  const bool unconverted = dynamic_cast<const CLI::ConversionError*>(&error) != nullptr;
  const bool mismatch = dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr;
  const CLI::Option* option = unconverted || mismatch ? option_of(app, error.what()) : nullptr;
  if (option == nullptr) return error.what();
  if (option->get_items_expected_max() == 0) return option->get_name() + " takes no value";
  if (unconverted) return conversion_text(*option);
  return option->get_name() + (option->count() > 1 ? " is given more than once" : " needs a value");
}

}  // namespace sonar
