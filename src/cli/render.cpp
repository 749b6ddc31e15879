// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "cli/chosen_recipe.h"
#include "cli/exit_codes.h"
#include "cli/file_to_write.h"
#include "cli/log.h"
#include "cli/progress.h"
#include "cli/render_options.h"
#include "cli/verb.h"
#include "io/atomic_file.h"
#include "pipeline/recipe/recipe.h"
#include "publish/movies/movie.h"
#include "publish/picture.h"
#include "publish/picture_output.h"
#include "publish/reports/report_html.h"
#include "publish/reports/report_pages.h"
#include "render/compare_pictures.h"
#include "render/draw_frame.h"

namespace sonar {
namespace {

/// A report of many pages, not a picture.
bool is_whole_report(const RenderArguments& arguments) {
  return arguments.kind == "report" && (arguments.whole || is_report_html(arguments.out));
}

/// What would be found out only after the drawing.
Result<void> check_output(const RenderArguments& arguments) {
  namespace fs = std::filesystem;
  std::error_code absent;
  for (const std::string& name : {arguments.out, arguments.difference}) {
    if (name.empty() || name == kStandardOutput) continue;
    if (auto place = require_place(name); !place) return place;
  }
  const bool movie = arguments.kind == "movie";
  if (is_whole_report(arguments)) {
    if (arguments.reference.empty()) return {};
    return fail(ErrorCode::usage,
                "a whole report is no picture to be compared; expected .png, .svg or .pdf without --whole",
                {arguments.out});
  }
  if (movie && !is_movie_file(arguments.out)) {
    return fail(ErrorCode::usage, "expected a name that ends in .mp4 or .png (an animated PNG)", {arguments.out});
  }
  if (!movie && !arguments.out.empty() && arguments.out != kStandardOutput && !is_picture_file(arguments.out)) {
    const char* expected = arguments.kind == "report" ? "expected a name that ends in .png, .svg, .pdf or .html"
                                                      : "expected a name that ends in .png, .svg or .pdf";
    return fail(ErrorCode::usage, expected, {arguments.out});
  }
  if (!arguments.reference.empty() && !fs::is_regular_file(arguments.reference, absent)) {
    return fail(ErrorCode::not_found, "no reference picture; look at one and put it there first",
                {arguments.reference});
  }
  return {};
}

/// What is drawn, found and allowed.
Result<std::unique_ptr<PictureSource>> source_of(const RenderArguments& arguments, Work& work) {
  if (auto possible = check_output(arguments); !possible) return pass_on(possible);
  std::optional<Recipe> recipe;
  if (!arguments.recipe.empty()) {
    auto named = chosen_recipe(arguments.recipe, {});
    if (!named) return pass_on(named);
    recipe = std::move(*named);
  }
  const std::vector<std::filesystem::path> paths(arguments.paths.begin(), arguments.paths.end());
  auto source = PictureSource::open(paths, recipe, work, arguments.quick);
  if (!source) return pass_on(source);
  if (!arguments.against.empty()) {
    if (auto compared = (*source)->compare_with(arguments.against); !compared) return pass_on(compared);
  }
  // Nothing is ever written into the folder of the raw files.
  for (const std::string& file : {arguments.out, arguments.difference}) {
    if (file.empty() || file == kStandardOutput) continue;
    if (auto outside = (*source)->require_outside_raw(file); !outside) return pass_on(outside);
  }
  return source;
}

Result<FrameDescription> frame_of(const RenderArguments& arguments, Work& work) {
  const auto options = picture_options(arguments);
  if (!options) return pass_on(options);
  const auto source = source_of(arguments, work);
  if (!source) return pass_on(source);
  PictureKind kind = PictureKind::slice_top;
  for (std::size_t i = 0; i < picture_kinds().size(); ++i) {
    if (picture_kinds()[i].name == arguments.kind) kind = static_cast<PictureKind>(i);
  }
  return picture_frame(kind, **source, arguments.observation, *options, work);
}

Result<WrittenMovie> movie_of(const RenderArguments& arguments, Work& work) {
  const auto options = picture_options(arguments);
  if (!options) return pass_on(options);
  // What does not go together is told before anything is read.
  if (auto valid = validate_movie(*options); !valid) return pass_on(valid);
  const auto source = source_of(arguments, work);
  if (!source) return pass_on(source);
  return write_movie(**source, arguments.observation, *options, arguments.out, work);
}

int render_movie(const RenderArguments& arguments, Work& work) {
  const auto movie = movie_of(arguments, work);
  clear_progress();
  if (!movie) return report(movie.error());
  if (!movie->note.empty()) print_note(movie->note);
  fmt::print("{}\n", movie->file.string());
  return kExitDone;
}

int compare_frame(const RenderArguments& arguments, const FrameDescription& frame) {
  const auto picture = draw_frame(frame, arguments.picture.scale);
  if (!picture) return report(picture.error());
  const PictureThresholds thresholds{arguments.largest_difference, arguments.mean_difference};
  const auto verdict = compare_with_reference(*picture, arguments.reference, thresholds);
  if (!verdict) return report(verdict.error());
  fmt::print("{}\n", verdict->text);
  if (!arguments.difference.empty()) {
    const auto reference = read_png(arguments.reference);
    if (!reference) return report(reference.error());
    if (reference->size == picture->size) {
      const auto written = write_pixels(difference_picture(*picture, *reference), arguments.difference);
      if (!written) return report(written.error());
    }
  }
  return verdict->equal ? kExitDone : kExitFailed;
}

Result<void> print_picture(const FrameDescription& frame, double scale) {
  const auto bytes = picture_bytes(frame, "picture.png", scale);
  if (!bytes) return pass_on(bytes);
  if (std::fwrite(bytes->data(), 1, bytes->size(), stdout) != bytes->size() || std::fflush(stdout) != 0) {
    return fail(ErrorCode::io, "cannot be written", {"standard output"});
  }
  return {};
}

Result<void> write_whole_report(const RenderArguments& arguments, Work& work) {
  const auto options = picture_options(arguments);
  if (!options) return pass_on(options);
  const auto source = source_of(arguments, work);
  if (!source) return pass_on(source);
  const std::vector<std::filesystem::path> paths(arguments.paths.begin(), arguments.paths.end());
  const auto report = is_report_html(arguments.out) ? report_html(**source, paths, *options, work)
                                                    : report_pdf(**source, paths, *options, work);
  if (!report) return pass_on(report);
  return write_file(arguments.out, *report);
}

int render_whole_report(const RenderArguments& arguments, Work& work) {
  const auto written = write_whole_report(arguments, work);
  clear_progress();
  if (!written) return report(written.error());
  fmt::print("{}\n", arguments.out);
  return kExitDone;
}

int render_verb(const RenderArguments& arguments) {
  Work work(arguments.jobs);
  const CancelOnInterrupt watch(work);
  show_progress(work);
  if (arguments.kind == "movie") return render_movie(arguments, work);
  if (is_whole_report(arguments)) return render_whole_report(arguments, work);
  const auto frame = frame_of(arguments, work);
  clear_progress();
  if (!frame) return report(frame.error());
  if (arguments.out == kStandardOutput) {
    if (const auto printed = print_picture(*frame, arguments.picture.scale); !printed) return report(printed.error());
  } else if (!arguments.out.empty()) {
    if (auto written = write_picture(*frame, arguments.out, arguments.picture.scale); !written)
      return report(written.error());
    if (arguments.reference.empty()) fmt::print("{}\n", arguments.out);
  }
  return arguments.reference.empty() ? kExitDone : compare_frame(arguments, *frame);
}

}  // namespace

void add_render(CLI::App& app, VerbRunner& run) {
  const auto arguments = std::make_shared<RenderArguments>();
  CLI::App* verb = app.add_subcommand(
      "render",
      "Draw slices, volumes, maps, echograms, charts, frequencies, noise steps, movies and a report; needs no display");
  add_render_options(*verb, *arguments);
  verb->callback([arguments, verb, &run] {
    if (arguments->out.empty() && arguments->reference.empty()) throw CLI::RequiredError("--out or --reference");
    if (const auto unsuited = unsuited_option(*verb, *arguments)) {
      throw CLI::ValidationError(unsuited->option, unsuited->why);
    }
    settle_options(*verb, *arguments);
    run = [arguments] { return render_verb(*arguments); };
  });
}

}  // namespace sonar
