// SPDX-License-Identifier: Apache-2.0
#include "cli/render_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "base/units.h"
#include "cli/numbers.h"
#include "pipeline/recipe/transfer_function_json.h"

namespace sonar {
namespace {

std::vector<std::string> kind_names() {
  std::vector<std::string> names;
  for (const PictureKindInfo& kind : picture_kinds()) names.emplace_back(kind.name);
  return names;
}

/// `count` finite numbers between commas.
template <std::size_t count>
Result<std::array<double, count>> numbers(std::string_view option, const std::string& text) {
  std::array<double, count> out{};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto [after, problem] = std::from_chars(at, end, out[i]);
    const bool more = i + 1 < count;
    if (problem != std::errc() || !std::isfinite(out[i]) || (more ? after == end || *after != ',' : after != end)) {
      return fail(ErrorCode::usage, fmt::format("{} {}: expected {} numbers between commas", option, text, count));
    }
    at = after + (more ? 1 : 0);
  }
  return out;
}

const std::vector<std::string> kLooks{"shown", "hatched", "transparent"};

/// Boundaries have no water to tell from them: where faults are hatched they are faded, as in the desktop.
void take_looks(const RenderArguments& arguments, PictureOptions& out) {
  if (arguments.removed == "hatched") {
    out.flags.hatched = kFault;
    out.flags.faded = kNeverMember;
  }
  if (arguments.removed == "transparent") out.flags.hidden = kNotFiltered;
  if (arguments.weak == "hatched") out.flags.hatched |= SampleFlags::low_snr;
  if (arguments.weak == "transparent") out.flags.faded |= SampleFlags::low_snr;
  if (arguments.weak != "shown") out.weak_below_db = arguments.weak_db;
}

constexpr double kMostPixels = 64e6;

Result<PixelSize> size_of(const std::string& text, double scale) {
  const auto sides = whole_numbers(text, 'x');
  if (!sides || sides->size() != 2 || (*sides)[0] < 320 || (*sides)[1] < 240 || (*sides)[0] > 16384 ||
      (*sides)[1] > 16384) {
    return fail(ErrorCode::usage, fmt::format("--size {}: expected WIDTHxHEIGHT from 320x240 to 16384x16384", text));
  }
  const double pixels = static_cast<double>((*sides)[0]) * static_cast<double>((*sides)[1]) * scale * scale;
  if (pixels > kMostPixels) {
    return fail(ErrorCode::usage,
                fmt::format("--size {} at --scale {:g} makes {:.0f} million pixels; expected {:.0f} at most", text,
                            scale, pixels / 1e6, kMostPixels / 1e6));
  }
  return PixelSize{static_cast<int>((*sides)[0]), static_cast<int>((*sides)[1])};
}

Result<void> take_plane(const RenderArguments& arguments, PlaneChoice& plane) {
  if (!arguments.plane_through.empty()) {
    const auto four = numbers<4>("--through", arguments.plane_through);
    if (!four) return pass_on(four);
    plane.through = *four;
  }
  if (arguments.plane_point.empty() != arguments.plane_normal.empty()) {
    return fail(ErrorCode::usage, "--point and --normal make a plane together");
  }
  if (!arguments.plane_point.empty()) {
    const auto point = numbers<3>("--point", arguments.plane_point);
    if (!point) return pass_on(point);
    const auto normal = numbers<3>("--normal", arguments.plane_normal);
    if (!normal) return pass_on(normal);
    plane.oblique = {(*point)[0], (*point)[1], (*point)[2], (*normal)[0], (*normal)[1], (*normal)[2]};
  }
  const int planes = int{plane.depth_m.has_value()} + int{plane.bearing_deg.has_value()} +
                     int{plane.through.has_value()} + int{plane.oblique.has_value()};
  if (planes > 1) {
    return fail(ErrorCode::usage, "one plane at a time: --depth-m, --bearing-deg, --through, or --point with --normal");
  }
  return {};
}

Result<void> take_camera(const RenderArguments& arguments, std::optional<Camera>& camera) {
  if (arguments.eye.empty() && arguments.target.empty()) return {};
  if (arguments.eye.empty() || arguments.target.empty()) {
    return fail(ErrorCode::usage, "--eye and --target make a camera together");
  }
  const auto eye = numbers<3>("--eye", arguments.eye);
  if (!eye) return pass_on(eye);
  const auto target = numbers<3>("--target", arguments.target);
  if (!target) return pass_on(target);
  Camera made;
  made.eye = {(*eye)[0], (*eye)[1], (*eye)[2]};
  made.target = {(*target)[0], (*target)[1], (*target)[2]};
  if (made.eye == made.target) return fail(ErrorCode::usage, "--eye and --target are the same place");
  camera = made;
  return {};
}

void add_common(CLI::App& verb, RenderArguments& a) {
  verb.add_option("--observation", a.observation, "e.g. obs-0001; default: the first");
  verb.add_option("--ping", a.picture.ping, "Ping index; default: the first with a school, else the middle one");
  verb.add_option("--schools", a.schools, "School ids between commas; default: all");
  verb.add_flag("--no-masks{false}", a.picture.masks, "Leave schools out");
  verb.add_flag("--refused", a.picture.refused,
                "Mark the echoes above the background that were judged no schools (/rejected)");
  auto* filtered = verb.add_flag("--filtered", a.filtered, "Noise removed; default of volumes");
  verb.add_flag("--unfiltered", a.unfiltered, "As recorded; default of slices")->excludes(filtered);
  verb.add_option("--recipe", a.recipe, "Parameters of every stage; default: the product's, else the preset default");
  verb.add_option("--size", a.size, "WIDTHxHEIGHT, pixels")->capture_default_str();
  verb.add_option("--scale", a.scale, "Pixels per unit of --size: 2 for print or high-density screens")
      ->check(within(0.25, 8.0));
  verb.add_flag("--dark", a.picture.dark, "Light on dark");
  verb.add_option("-j,--jobs", a.jobs, "Threads; 0 = all of the machine's")->check(CLI::Range(0, 1024));
}

void add_colours(CLI::App& verb, RenderArguments& a) {
  std::vector<std::string> maps;
  for (const std::string_view name : colour_map_names()) maps.emplace_back(name);
  verb.add_option("--map", a.map, "Colour map")->check(CLI::IsMember(maps))->capture_default_str()->group("Colours");
  verb.add_option("--low-db", a.low_db,
                  "Display limit: the first colour begins here; default -60, timeline of means -75")
      ->check(within(-190.0, 100.0))
      ->group("Colours");
  verb.add_option("--span-db", a.span_db, "From the first colour to the last; default 36")
      ->check(within(1.0, 200.0))
      ->group("Colours");
  verb.add_option("--threshold-db", a.picture.scale.threshold_db, "Analysis threshold: nothing below it is shown")
      ->check(within(-200.0, 100.0))
      ->group("Colours");
  verb.add_option("--transfer-function", a.transfer, "View curve TF.json: colours and opacity instead of the map's")
      ->group("Colours");
}

void add_slices(CLI::App& verb, RenderArguments& a) {
  const std::string group = "Slices";
  verb.add_option("--fan", a.picture.fan, "slice-top: fan from 0, the deepest; default: through the largest school")
      ->group(group);
  verb.add_option("--beam", a.picture.beam,
                  "slice-side: beam from 0, clockwise (looking to port: from aft); default: through the largest school")
      ->group(group);
  verb.add_option("--range-m", a.picture.range_m, "slice-range: slant range, m")
      ->check(within(-1e6, 1e6))
      ->group(group);
  verb.add_option("--depth-m", a.picture.plane.depth_m, "slice-plane: horizontal, at this depth")
      ->check(within(-1e6, 1e6))
      ->group(group);
  verb.add_option("--bearing-deg", a.picture.plane.bearing_deg,
                  "slice-plane: vertical through the sonar along a true bearing")
      ->check(within(-1e6, 1e6))
      ->group(group);
  verb.add_option("--through", a.plane_through, "slice-plane: vertical through X,Y,X,Y (m towards bow and starboard)")
      ->group(group);
  verb.add_option("--point", a.plane_point,
                  "slice-plane: oblique, through X,Y,Z (m from the transducer towards bow, starboard, down)")
      ->group(group);
  verb.add_option("--normal", a.plane_normal, "slice-plane: its normal X,Y,Z, towards the viewer")->group(group);
  verb.add_option("--removed", a.removed, "Unfiltered, how samples look that noise removal takes out; the key says so")
      ->check(CLI::IsMember(kLooks))
      ->capture_default_str()
      ->group(group);
  auto* weak =
      verb.add_option("--weak", a.weak, "How samples look that hardly rise above the background noise; the key says so")
          ->check(CLI::IsMember(kLooks))
          ->capture_default_str()
          ->group(group);
  verb.add_option("--weak-db", a.weak_db, "--weak: those with less signal-to-noise, dB")
      ->needs(weak)
      ->check(within(0.0, 60.0))
      ->capture_default_str()
      ->group(group);
  verb.add_flag("--north-up", a.picture.north_up, "Turn slices from above so that north is up")->group(group);
  verb.add_flag("--grid", a.picture.grid_lines, "Grid lines")->group(group);
}

void add_volume(CLI::App& verb, RenderArguments& a) {
  const std::string group = "Volume";
  verb.add_option("--mode", a.mode, "accumulate, first-hit or maximum")
      ->check(CLI::IsMember({"accumulate", "first-hit", "maximum"}))
      ->capture_default_str()
      ->group(group);
  verb.add_option("--first-hit-db", a.picture.first_hit_db, "first-hit: Sv of the surface")
      ->check(within(-200.0, 100.0))
      ->capture_default_str()
      ->group(group);
  verb.add_flag("--lighting", a.picture.lighting, "Light by the gradient of Sv in metres")->group(group);
  verb.add_option("--eye", a.eye, "Camera's place X,Y,Z (m towards bow, starboard, down); default: an overview")
      ->group(group);
  verb.add_option("--target", a.target, "What the camera looks at, X,Y,Z")->group(group);
  verb.add_option("--orbit-deg", a.picture.orbit_deg, "Turn the camera about its target")
      ->check(within(-360.0, 360.0))
      ->group(group);
  verb.add_option("--rise-deg", a.picture.rise_deg, "Lift the camera about its target")
      ->check(within(-180.0, 180.0))
      ->group(group);
  verb.add_option("--zoom", a.picture.zoom, "Above 1: nearer")->check(within(0.01, 100.0))->group(group);
  verb.add_flag("--masks-alone{false}", a.picture.mask_style.data_too, "Schools' masks without the data")->group(group);
  verb.add_flag("--mask-outline", a.picture.mask_outline, "Outline schools in volumes: the data keeps its colours")
      ->group(group);
  verb.add_option("--core", a.picture.mask_style.core_at, "Confidence from which a voxel is core")
      ->check(within(0.0, 1.0))
      ->capture_default_str()
      ->group(group);
  verb.add_option("--fuzzy", a.picture.mask_style.fuzzy_above, "Confidence of the fuzzy area's surface")
      ->check(within(0.0, 1.0))
      ->group(group);
  verb.add_option("--table-entries", a.picture.table_entries, "Steps of the transfer function's table")
      ->check(CLI::Range(2, kMostTableEntries))
      ->capture_default_str()
      ->group(group);
  verb.add_option("--frames", a.picture.frames, "Jittered frames that are averaged; 0 = one plain frame")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str()
      ->group(group);
  verb.add_option("--seconds", a.picture.seconds, "No further frame is begun after this time; 0 = no limit")
      ->check(within(0.0, 1e6))
      ->group(group);
  verb.add_option("--renderer", a.renderer, "auto, cpu or gl")
      ->check(CLI::IsMember({"auto", "cpu", "gl"}))
      ->capture_default_str()
      ->group(group);
  verb.add_flag("--no-context{false}", a.picture.context, "Without frame, rings, sea surface, ship and axes")
      ->group(group);
  verb.add_option("--ship-length-m", a.picture.ship_length_m, "Length of the drawn ship")
      ->check(within(1.0, 500.0))
      ->capture_default_str()
      ->group(group);
}

void add_maps(CLI::App& verb, RenderArguments& a) {
  const std::string group = "Maps, propagation, timeline";
  verb.add_option("--depth-raster", a.picture.depth_raster,
                  "Depths as GeoTIFF or netCDF grid (GEBCO, EMODnet): survey-map, volume")
      ->group(group);
  verb.add_option("--neighbours", a.picture.neighbours, "propagation: pings before and after")
      ->check(CLI::Range(0, 100))
      ->capture_default_str()
      ->group(group);
  verb.add_flag("--side", a.picture.side_view, "propagation: from the side")->group(group);
  verb.add_flag("--along-log", a.picture.along_log, "timeline: against the log instead of time")->group(group);
  verb.add_flag("--maximum", a.picture.maximum, "timeline: the maximum over beams instead of the mean")->group(group);
  verb.add_flag("--quick", a.quick, "survey-map: from the first and last bytes of each raw file alone")->group(group);
  verb.add_flag("--whole-survey", a.picture.whole_survey, "timeline: all observations")->group(group);
}

}  // namespace

void add_render_options(CLI::App& verb, RenderArguments& a) {
  std::string kinds = "What to draw:";
  for (const PictureKindInfo& kind : picture_kinds()) kinds += fmt::format("\n{} - {}", kind.name, kind.text);
  verb.add_option("KIND", a.kind, kinds)->required()->check(CLI::IsMember(kind_names()));
  verb.add_option("PATH", a.paths, "Raw files or their folder, a work folder of a run or a product, or both")
      ->required();
  verb.add_option("-o,--out", a.out, "Picture: .png, .svg or .pdf; - = PNG on standard output");
  verb.add_option("--reference", a.reference, "Compare with this PNG; exit code 1 where it differs")
      ->group("Comparing");
  verb.add_option("--largest-difference", a.largest_difference, "Allowed difference of any channel, 0..255")
      ->check(within(0.0, 255.0))
      ->capture_default_str()
      ->group("Comparing");
  verb.add_option("--mean-difference", a.mean_difference, "Allowed mean difference, 0..255")
      ->check(within(0.0, 255.0))
      ->capture_default_str()
      ->group("Comparing");
  verb.add_option("--difference", a.difference, "Write what differs as a PNG")->group("Comparing");
  add_common(verb, a);
  add_colours(verb, a);
  add_slices(verb, a);
  add_volume(verb, a);
  add_maps(verb, a);
}

Result<PictureOptions> picture_options(const RenderArguments& arguments) {
  PictureOptions out = arguments.picture;
  const auto size = size_of(arguments.size, arguments.scale);
  if (!size) return pass_on(size);
  if (out.mask_style.fuzzy_above > out.mask_style.core_at) {
    return fail(ErrorCode::usage,
                fmt::format("--fuzzy {} lies above --core {}", out.mask_style.fuzzy_above, out.mask_style.core_at));
  }
  // "As recorded" means all of it, what would be taken for noise, surface or seabed too.
  if (arguments.unfiltered) out.left_out = SampleFlags::none;
  out.scale.low_db = arguments.low_db.value_or(out.scale.low_db);
  out.scale.span_db = arguments.span_db.value_or(out.scale.span_db);
  if (arguments.filtered || arguments.unfiltered) out.filtered = arguments.filtered;
  out.limits_given = arguments.low_db || arguments.span_db;
  out.size = *size;
  out.scale.map = colour_map_named(arguments.map).value_or(ColourMapName::ek500);
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
  if (auto taken = take_plane(arguments, out.plane); !taken) return pass_on(taken);
  if (auto taken = take_camera(arguments, out.camera); !taken) return pass_on(taken);
  take_looks(arguments, out);
  if (arguments.mode == "first-hit") out.mode = RayMode::first_hit;
  if (arguments.mode == "maximum") out.mode = RayMode::maximum;
  if (arguments.renderer == "cpu") out.renderer = RendererChoice::cpu;
  if (arguments.renderer == "gl") out.renderer = RendererChoice::gl;
  return out;
}

}  // namespace sonar
