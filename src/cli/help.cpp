// SPDX-License-Identifier: Apache-2.0
#include "cli/help.h"

#include <fmt/format.h>

#include <array>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "base/manual.h"
#include "cli/exit_codes.h"
#include "cli/log.h"
#include "cli/one_of.h"
#include "cli/usage.h"

namespace sonar {
namespace {

constexpr const char* kVerbs = "Verbs";

struct Examples {
  std::string_view verb;
  std::string_view lines;
};
constexpr std::array kExamples = {
    Examples{"info",
             "  sonarx info SURVEY                       what the files hold, and what is damaged\n"
             "  sonarx info SURVEY --json --checksum     the same for scripts\n"},
    Examples{"simulate",
             "  sonarx simulate SYNTHETIC --preset standard --seed 1\n"
             "  sonarx simulate SYNTHETIC --physics array --waters random --seed 7\n"
             "  sonarx simulate SPHERE --physics array --sphere wc38.1 --pings 200\n"},
    Examples{"calibrate",
             "  sonarx calibrate SPHERE --sphere wc38.1 -o calibration.csv\n"
             "  sonarx calibrate SPHERE --sphere wc38.1 --water 7.5,35.1,20 --range 40,90 -o calibration.csv\n"},
    Examples{"run",
             "  sonarx run SURVEY -o OUT\n"
             "  sonarx run SURVEY -o OUT --recipe R.json -j 4\n"
             "  sonarx run SURVEY -o OUT --only obs-0002 --why\n"},
    Examples{"plan", "  sonarx plan SURVEY -o OUT\n  sonarx run --plan OUT/plan.json --task 0\n  sonarx merge OUT\n"},
    Examples{"follow", "  sonarx follow SURVEY -o OUT --alarm \"volume_m3 > 20000, range_m < 150\"\n"},
    Examples{"merge", "  sonarx merge OUT\n"},
    Examples{"submit",
             "  sonarx submit SURVEY -o OUT --partition long --account fish\n"
             "  sonarx submit SURVEY -o OUT --dry-run     the scripts alone\n"},
    Examples{"status", "  sonarx status OUT\n  sonarx status OUT --json\n"},
    Examples{"check", "  sonarx check OUT\n  sonarx check OUT --json\n"},
    Examples{"integrate",
             "  sonarx integrate SURVEY -o OUT\n"
             "  sonarx integrate SURVEY -o OUT --edsu-nmi 0.1 --range-bin-m 25 --depth-channel-m 20\n"},
    Examples{"biomass",
             "  sonarx biomass --list-ts\n"
             "  sonarx biomass --print-ts > TS.csv\n"
             "  sonarx biomass OUT --lengths lengths.csv --ts herring-side --weight-a 0.0048 --weight-b 3.2\n"},
    Examples{"propagate",
             "  sonarx propagate SURVEY --observation obs-0001 --seed 6,6,7,442 --tolerance-db 10 -o ONE\n"},
    Examples{"import",
             "  sonarx export OUT --to echoview -o REGIONS     to be looked at and changed in Echoview\n"
             "  sonarx import SURVEY REGIONS/*.evr -o regions.jsonl --operator NAME\n"
             "  sonarx run SURVEY -o NEW --session regions.jsonl\n"
             "  sonarx export OUT --to lsss --count-from 0 -o WORK     school masks as LSSS keeps them\n"
             "  sonarx import SURVEY WORK/*.work -o masks.jsonl --count-from 0\n"},
    Examples{"export",
             "  sonarx export OUT --to csv -o TABLES\n  sonarx export OUT --to geojson -o MAP\n"
             "  sonarx export OUT --to raw-reduced --survey SURVEY -o SMALL\n"
             "  sonarx export OUT --to gltf -o SURFACES\n"},
    Examples{"score", "  sonarx score OUT --truth SYNTHETIC/truth\n"},
    Examples{"agree", "  sonarx agree OUT OTHER\n  sonarx agree OUT OTHER -o AGREEMENT\n"},
    Examples{"compare", "  sonarx compare OUT OTHER\n"},
    Examples{"recipe", "  sonarx recipe --preset default > R.json\n  sonarx recipe --validate R.json\n"},
    Examples{"render",
             "  sonarx render slice-top SURVEY OUT -o top.png\n"
             "  sonarx render survey-map OUT --depth-raster depth.tif -o map.pdf\n"
             "  sonarx render movie SURVEY OUT --of slice-top --schools 1 -o school.mp4\n"
             "  sonarx render report OUT -o report.pdf\n"},
};

/// "TEXT:{csv,gpkg}" -> "csv, gpkg"; empty of other types.
std::string choices_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const auto first = type.find('{');
  const auto last = type.rfind('}');
  if (first == std::string::npos || last == std::string::npos) return {};
  std::string choices;
  for (const char c : type.substr(first + 1, last - first - 1))
    choices += c == ',' ? std::string(", ") : std::string(1, c);
  return choices;
}

/// What stands for a value: what its validator says of itself, "TEXT:FILE" -> "FILE", or else the option.
std::string value_word(const std::string& type) {
  if (type.starts_with("INT")) return "N";
  if (type.starts_with("FLOAT")) return "X";
  if (type.find('{') != std::string::npos) return "WORD";
  return type.starts_with("TEXT:") ? type.substr(5) : type;
}

/// Options in plain words: what kind of value stands there, and of choices what they are.
class PlainFormatter : public CLI::Formatter {
 public:
  std::string make_option_opts(const CLI::Option* option) const override {
    std::string text;
    if (option->get_items_expected_max() > 0) {
      if (!option->get_positional()) text = " " + value_word(option->get_type_name());
      if (option->get_expected_max() > 1) text += " ...";
      if (!option->get_default_str().empty()) text += " (" + option->get_default_str() + ")";
    }
    return option->get_required() && !option->get_positional() ? text + " (required)" : text;
  }
  /// "--no-masks", without what a flag stands for.
  std::string make_option_name(const CLI::Option* option, bool positional) const override {
    const std::string name = CLI::Formatter::make_option_name(option, positional);
    return name.substr(0, name.find('{'));
  }
  std::string make_option_desc(const CLI::Option* option) const override {
    const std::string choices = choices_of(*option);
    const std::string text = option->get_description();
    // Some list their choices themselves, each with what it is.
    const bool lists = choices.empty() || text.find(choices.substr(0, choices.find(','))) != std::string::npos;
    return lists ? text : text + ": " + choices;
  }
};

int print_help(const CLI::App& app, const std::string& name) {
  if (name.empty()) {
    fmt::print("{}", app.help());
    return kExitDone;
  }
  const auto named = app.get_subcommands([&](const CLI::App* verb) { return verb->get_name() == name; });
  if (!named.empty()) {
    fmt::print("{}", named.front()->help("sonarx"));
    return kExitDone;
  }
  return report({ErrorCode::usage, no_verb_text(app, name), {}});
}

void finish_verb(CLI::App& verb, const std::shared_ptr<CLI::Formatter>& formatter, const std::string& manual) {
  verb.formatter(formatter);
  verb.group(kVerbs);
  auto* quiet = verb.add_flag_callback(
      "-q,--quiet", [] { set_log_level(LogLevel::quiet); }, "Print errors only, no notes and no progress");
  verb.add_flag_callback(
          "-v,--verbose", [] { set_log_level(LogLevel::verbose); }, "Tell each step on standard error")
      ->excludes(quiet);
  const std::map<std::string, LogLevel> levels{
      {"errors", LogLevel::quiet}, {"notes", LogLevel::normal}, {"steps", LogLevel::verbose}};
  verb.add_option_function<std::string>(
          "--log-level", [levels](const std::string& level) { set_log_level(levels.at(level)); },
          "How much is printed on standard error: errors (-q), notes, or steps (-v)")
      ->check(one_of({"errors", "notes", "steps"}));
  std::string footer = verb.get_footer();
  if (!footer.empty()) footer += "\n";
  for (const Examples& examples : kExamples) {
    if (examples.verb == verb.get_name()) footer += fmt::format("Examples:\n{}\n", examples.lines);
  }
  verb.footer(footer + manual);
}

}  // namespace

void add_help(CLI::App& app, VerbRunner& run) {
  const auto formatter = std::make_shared<PlainFormatter>();
  formatter->label("SUBCOMMAND", "VERB");
  const std::string manual = "Manual: " + manual_place();
  app.formatter(formatter);
  app.footer(fmt::format("sonarx help VERB, or sonarx VERB --help, tells what a verb takes.\n{}", manual));
  for (CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    finish_verb(*verb, formatter, manual);
  const auto name = std::make_shared<std::string>();
  CLI::App* help = app.add_subcommand("help", "Tell what a verb does and takes");
  help->formatter(formatter);
  help->group(kVerbs);
  help->add_option("VERB", *name, "Verb; none = what all do in a line each");
  help->callback([&app, name, &run] { run = [&app, name] { return print_help(app, *name); }; });
}

}  // namespace sonar
