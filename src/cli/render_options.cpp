// SPDX-License-Identifier: Apache-2.0
#include "cli/render_options.h"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <utility>

#include "cli/named_path.h"
#include "cli/numbers.h"
#include "cli/one_of.h"
#include "pipeline/recipe/transfer_function_json.h"

namespace sonar {
namespace {

constexpr const char* kOfPing = "slice- volume propagation observation-map echogram frequency curves noise-steps";
constexpr const char* kOfSv = "slice- volume timeline echogram";

std::vector<std::string> kind_names() {
  std::vector<std::string> names;
  for (const PictureKindInfo& kind : picture_kinds()) names.emplace_back(kind.name);
  return names;
}

Result<PixelSize> size_of(const std::string& text) {
  const auto sides = whole_numbers(text, 'x');
  const auto fits = [](std::int64_t side) { return side >= 0 && side <= 1000000; };
  if (sides && sides->size() == 2 && fits((*sides)[0]) && fits((*sides)[1])) {
    const PaperParams paper{static_cast<int>((*sides)[0]), static_cast<int>((*sides)[1]), 1.0};
    if (validate(paper)) return PixelSize{paper.width_px, paper.height_px};
  }
  return fail(ErrorCode::usage, fmt::format("--size {}: expected WIDTHxHEIGHT from 320x240 to 16384x16384", text));
}

/// What is wrong with a parameter, under the name of its flag.
std::string as_flag(const std::string& text, const RenderArguments& arguments) {
  for (const DescribedFlags::Made& one : arguments.suits) {
    if (text.starts_with(one.flag.substr(2) + " ")) return "--" + text;
  }
  return text;
}

void add_common(CLI::App& verb, RenderArguments& a) {
  const auto suits = [&a](const CLI::Option* option, const char* kinds) {
    a.suits.push_back({option->get_name(), kinds});
  };
  suits(verb.add_option("--observation", a.observation,
                        "Observation to draw, e.g. obs-0001; default: the first with schools, and of a chart all")
            ->check(some_name()),
        "slice- volume propagation observation-map timeline echogram chart frequency curves noise-steps lineage movie");
  suits(
      verb.add_option("--ping", a.picture.ping,
                      "Ping index; default: that of the strongest whole school, else the middle one; for first-hit and "
                      "volume-and-surface without schools that with the most ranges at the level"),
      kOfPing);
  verb.add_option("--schools", a.schools, "School ids between commas; default: all")->type_name("N,N");
  auto* filtered = verb.add_flag("--filtered", a.filtered, "Noise removed; default of volumes");
  auto* unfiltered = verb.add_flag("--unfiltered", a.unfiltered, "As recorded; default of slices")->excludes(filtered);
  suits(filtered, kOfSv);
  suits(unfiltered, kOfSv);
  verb.add_option("--recipe", a.recipe, "Parameters of every stage; default: the product's, else the preset default")
      ->check(named_file());
  verb.add_option("--size", a.size, "Pixels")->type_name("WIDTHxHEIGHT")->capture_default_str();
  verb.add_option("--scale", a.picture.scale, "Pixels per unit of --size: 2 for print or high-density screens")
      ->check(within(0.25, 8.0));
  verb.add_flag("--dark", a.picture.dark, "Light on dark");
  suits(verb.add_option("--fan", a.picture.fan, "Fan from 0, the deepest; default: through the largest school"),
        "slice-top echogram volume noise-steps");
  suits(verb.add_option("--beam", a.picture.beam,
                        "Beam from 0, clockwise (looking to port: from aft); default: through the largest school"),
        "slice-side echogram volume noise-steps");
  suits(verb.add_option("--transfer-function", a.transfer, "View curve TF.json: colours and opacity instead of --map")
            ->check(named_file()),
        "slice- volume timeline echogram noise-steps");
  suits(verb.add_option("--depth-raster", a.picture.depth_raster,
                        "Depths as GeoTIFF or netCDF grid (GEBCO, EMODnet): the seabed")
            ->check(named_file()),
        "volume survey-map report");
  suits(
      verb.add_option("--transects", a.picture.transects,
                      "CSV name,stratum,type,start_utc,stop_utc: transects along the track, a colour for each stratum")
          ->check(named_file()),
      "survey-map report");
  suits(verb.add_option("--line", a.picture.line,
                        "Line of Echoview (.evl) over an echogram against depth (--depth): a seabed, a layer")
            ->check(named_file()),
        "echogram");
  suits(verb.add_option("--against", a.against,
                        "Another reader's work folder of the same raw files: show which voxels are in both, which only "
                        "in PATH (A) and which only there (B); --ping default: where they differ most, else that of "
                        "the strongest school")
            ->check(named_path("FOLDER")),
        "slice- volume");
  suits(verb.add_flag("--quick", a.quick, "From the first and last bytes of each raw file alone"), "survey-map");
  suits(verb.add_flag("--whole", a.whole,
                      "As .pdf too the whole report on as many pages as it needs; .html is whole anyway"),
        "report");
  verb.add_option("-j,--jobs", a.jobs, "Threads; 0 = all of the machine's")->check(whole_within(0, 1024));
}

void add_comparing(CLI::App& verb, RenderArguments& a) {
  const std::string group = "Comparing";
  verb.add_option("--reference", a.reference, "Compare with this PNG; exit code 1 where it differs")
      ->check(named_file())
      ->group(group);
  verb.add_option("--largest-difference", a.largest_difference, "Allowed difference of any channel, 0..255")
      ->check(within(0.0, 255.0))
      ->capture_default_str()
      ->group(group);
  verb.add_option("--mean-difference", a.mean_difference, "Allowed mean difference, 0..255")
      ->check(within(0.0, 255.0))
      ->capture_default_str()
      ->group(group);
  verb.add_option("--difference", a.difference, "Write what differs as a PNG")->check(named_file())->group(group);
}

/// Refuses what is no column of any table that a chart knows, and says which was meant; the list is too long for the help.
CLI::Validator some_column(bool or_none) {
  const ChoiceNames names = chart_column_names();
  CLI::Validator known = one_of(std::vector<std::string>(names.begin(), names.end()));
  return {[known, or_none](std::string& text) { return or_none && text.empty() ? std::string{} : known(text); },
          "COLUMN"};
}

/// Flags of what is asked for one kind: the group's name is the kind's.
class KindFlags {
 public:
  KindFlags(CLI::App& verb, RenderArguments& a) : verb_(verb), made_(a.suits) {}
  template <class P>
  void group(std::string_view name, P& p, std::string_view) {
    DescribedFlags flags(verb_, "Of " + std::string(name), std::string(name), made_);
    describe(flags, p);
  }

 private:
  CLI::App& verb_;
  std::vector<DescribedFlags::Made>& made_;
};

}  // namespace

void add_render_options(CLI::App& verb, RenderArguments& a) {
  std::string kinds = "What to draw:";
  for (const PictureKindInfo& kind : picture_kinds()) kinds += fmt::format("\n{} - {}", kind.name, kind.text);
  verb.add_option("KIND", a.kind, kinds)->required()->check(one_of(kind_names()));
  verb.add_option("PATH", a.paths, "Raw files or their folder, a work folder of a run or a product, or both")
      ->required();
  verb.add_option(
          "-o,--out", a.out,
          "Picture: .png, .svg or .pdf; - = PNG on standard output. Movie: .mp4, or .png (animated). Report: .html too")
      ->check(named_file());
  add_comparing(verb, a);
  add_common(verb, a);
  // A file is drawn once, where a window goes on while one looks.
  a.picture.volume.frames = 8;
  // Nor has it a selected school, or slices beside it.
  a.picture.volume.drop_lines = DropLines::all;
  a.picture.volume.slice_planes = false;
  DescribedFlags display(verb, "How data and schools look", "", a.suits);
  describe(display, a.picture.display);
  verb.get_option("--removed")->default_str("shown; transparent where noise is removed");
  verb.get_option("--threshold-db")->default_str("none");
  DescribedFlags volume(verb, "Of volume", "volume", a.suits);
  describe(volume, a.picture.volume);
  KindFlags kind(verb, a);
  describe(kind, a.picture.kind);
  for (const char* place : {"--eye", "--target", "--point", "--normal"}) {
    verb.get_option(place)->check(numbers_between_commas("X,Y,Z"));
  }
  for (const char* column : {"--x", "--y"}) verb.get_option(column)->check(some_column(column[2] == 'y'));
  verb.get_option("--through")->check(numbers_between_commas("X,Y,X,Y"));
  verb.get_option("--channel")->check(some_name("X"));
  verb.get_option("--below")->check(some_name());
}

std::string drawn_kind_name(const RenderArguments& arguments) {
  if (arguments.kind != "movie") return arguments.kind;
  return std::string(picture_kinds()[static_cast<std::size_t>(drawn_kind(arguments.picture.kind.movie.of))].name);
}

void settle_options(const CLI::App& verb, RenderArguments& a) {
  const auto given = [&](const char* option) { return verb.get_option(option)->count() > 0; };
  PictureOptions& picture = a.picture;
  picture.kind.echogram.along_log = picture.kind.timeline.along_log;
  picture.kind.curves.one_ping = picture.kind.frequency.one_ping;
  picture.limits_given = given("--low-db") || given("--span-db");
  if (a.filtered) picture.display.filtered = true;
  if (a.unfiltered) picture.volume.filtered = false;
  // Noise removed means that it is not drawn; "as recorded" means all of it, surface and seabed too.
  const bool noise_removed = drawn_kind_name(a) == "volume" ? picture.volume.filtered : picture.display.filtered;
  if (!given("--removed")) picture.display.removed = noise_removed ? NoiseLook::transparent : NoiseLook::shown;
  if (given("--weak-db") && !given("--weak")) throw CLI::ValidationError("--weak-db", "goes with --weak");
  if (given("--line") && !given("--depth")) {
    throw CLI::ValidationError("--line", "goes with --depth: its points are depths");
  }
  if (given("--eye") && !given("--target")) throw CLI::ValidationError("--eye", "goes with --target");
  if (given("--target") && !given("--eye")) throw CLI::ValidationError("--target", "goes with --eye");
  // A plane's figures tell how it lies.
  const std::array<std::pair<const char*, PlaneLies>, 4> planes{{{"--depth-m", PlaneLies::horizontal},
                                                                 {"--bearing-deg", PlaneLies::along_bearing},
                                                                 {"--through", PlaneLies::through_places},
                                                                 {"--normal", PlaneLies::oblique}}};
  if (given("--point") != given("--normal")) throw CLI::ValidationError("--point", "makes a plane with --normal");
  int told = 0;
  PlaneLies& plane = picture.kind.slice_plane.plane;
  for (const auto& [option, lies] : planes) {
    if (!given(option)) continue;
    if (++told > 1 || (given("--plane") && plane != lies)) {
      throw CLI::ValidationError(option,
                                 "one plane at a time: --depth-m, --bearing-deg, --through, or --point with --normal");
    }
    plane = lies;
  }
}

Result<PictureOptions> picture_options(const RenderArguments& arguments) {
  PictureOptions out = arguments.picture;
  const auto size = size_of(arguments.size);
  if (!size) return pass_on(size);
  out.size = *size;
  if (!arguments.transfer.empty()) {
    auto curve = read_transfer_function(arguments.transfer);
    if (!curve) return pass_on(curve);
    out.transfer = std::move(*curve);
  }
  if (!arguments.schools.empty()) {
    const auto ids = whole_numbers(arguments.schools, ',');
    if (!ids)
      return fail(ErrorCode::usage, fmt::format("--schools {}: expected ids between commas", arguments.schools));
    out.schools = *ids;
  }
  if (auto valid = validate_options(out); !valid) {
    return fail(ErrorCode::usage, as_flag(valid.error().text, arguments));
  }
  return out;
}

}  // namespace sonar
