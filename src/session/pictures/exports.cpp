// SPDX-License-Identifier: Apache-2.0
#include "session/pictures/exports.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include "base/number_text.h"
#include "model/school_totals.h"
#include "pipeline/exports/export.h"
#include "pipeline/stages/observe.h"
#include "pipeline/survey/write_survey.h"
#include "publish/movies/movie.h"
#include "publish/picture.h"
#include "publish/picture_output.h"
#include "session/open/survey_schools.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

/// The survey and all that was chosen, as it was when something was asked for.
struct Snapshot {
  const SurveyFiles* survey = nullptr;  ///< stands until the job is over: another survey comes only after it
  Recipe recipe;
  Recipe measuring;  ///< the recipe under the calibration that was chosen
  std::string program_version;
  std::shared_ptr<const std::vector<JournalLine>> lines;
  std::map<std::size_t, JournalStatePtr> states;
  std::map<std::size_t, RefusedPtr> refused;
  std::map<std::size_t, EventsPtr> events;
  std::map<std::size_t, ProductPtr> products;
  std::set<std::size_t> as_made;    ///< by another version, see Document::as_made()
  std::vector<ProductPtr> results;  ///< see Document::results()
  std::vector<SurveyNumber> numbers;
  bool all_measured = false;
  std::vector<fs::path> paths;
  std::uint64_t memory_bytes = 0;
  ReduceParams reduce;
};

Snapshot snapshot_of(const Workspace& workspace) {
  const Document& document = workspace.document;
  Snapshot snapshot{document.survey(),
                    document.recipe(),
                    document.measuring_recipe(),
                    document.options().program_version,
                    document.choices().lines,
                    document.choices().states,
                    {},
                    {},
                    {},
                    {},
                    document.results(),
                    document.survey_numbers(),
                    document.all_measured(),
                    document.paths(),
                    document.options().memory_bytes,
                    workspace.reduce.values()};
  // A state without the schools that its journal asks for is not what a run would leave.
  std::erase_if(snapshot.states, [&document](const auto& one) { return document.lacks_detected(one.first); });
  for (const auto& [index, state] : snapshot.states) {
    snapshot.refused[index] = document.refused(index);
    snapshot.events[index] = document.found_events(index);
    if (auto product = document.product(index)) snapshot.products[index] = std::move(product);
    if (document.as_made(index)) snapshot.as_made.insert(index);
  }
  return snapshot;
}

/// What an observation's file holds: measured from the state on show, or, where it is not open, from the journal.
/// journal  effective lines
Result<ObservationProduct> product_of(const Snapshot& snapshot, const ReadJournal& journal, std::size_t index,
                                      Work& work) {
  const ObservationFiles& observation = snapshot.survey->observations[index];
  const auto state = snapshot.states.find(index);
  const bool chosen = observation.grid && state != snapshot.states.end() && state->second;
  if (!snapshot.results.empty()) {
    const ObservationProduct& measured = *snapshot.results[index];
    if (!chosen) return measured;
    return state_product_of_results(Engine(*snapshot.survey, observation, snapshot.measuring), *state->second,
                                    measured);
  }
  if (observation.grid) {
    if (auto room = room_for(observation, snapshot.memory_bytes); !room) return pass_on(room);
  }
  if (!chosen) {
    return observe(*snapshot.survey, observation, snapshot.recipe, {{}, journal, snapshot.program_version}, work);
  }
  Engine engine(*snapshot.survey, observation, snapshot.measuring);
  auto product = state_product(
      engine, *state->second,
      {journal, snapshot.program_version, true, nullptr, *snapshot.refused.at(index), *snapshot.events.at(index)},
      work);
  // This version would not find these schools: no run takes them for its own.
  if (product && snapshot.as_made.contains(index)) product->input_hash.clear();
  return product;
}

ProductSource source_of_products(const Snapshot& snapshot, Work& work) {
  return [&snapshot, &work, journal = ReadJournal(effective_lines(*snapshot.lines))](std::size_t index) {
    return product_of(snapshot, journal, index, work);
  };
}

/// Products for the time of one export, in a hidden folder where the results go, so that the same disk is asked for room.
class PassingFolder {
 public:
  explicit PassingFolder(const fs::path& beside) {
    std::error_code error;
    for (int i = 0; path_.empty() && i < 1000; ++i) {
      const fs::path path = beside / fmt::format(".sonar-export-{}", i);
      if (fs::create_directories(path, error) && !error) path_ = path;
      if (error) return;
    }
  }
  ~PassingFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  PassingFolder(const PassingFolder&) = delete;
  PassingFolder& operator=(const PassingFolder&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

Result<std::string> exported(const Snapshot& snapshot, const std::string& format, const fs::path& folder, Work& work) {
  if (auto outside = require_outside_raw(*snapshot.survey, folder); !outside) return pass_on(outside);
  if (format == "raw-reduced" && snapshot.paths.size() != 1) {
    return fail(ErrorCode::usage,
                "reduced raw files can be written of one folder; open the folder instead of its files");
  }
  // Reduced recordings may lie beside others; nothing else may.
  const fs::path asked = format == "raw-reduced" ? folder : folder / "inside";
  if (auto outside = require_not_beneath_raw(asked); !outside) return pass_on(outside);
  const PassingFolder passing(folder);
  if (passing.path().empty()) return fail(ErrorCode::io, "cannot be written to", {folder.string()});
  const auto products = write_products(*snapshot.survey, passing.path(), source_of_products(snapshot, work), work);
  if (!products) return pass_on(products);
  const auto done = export_products({passing.path(), format, folder, snapshot.paths.front(), snapshot.reduce}, work);
  if (!done) return pass_on(done);
  std::string line = done->files.size() == 1
                         ? fmt::format("written: {}", done->files.front().string())
                         : fmt::format("written: {} files in {}", done->files.size(), folder.string());
  if (!done->without_grid.empty()) line += fmt::format("; without a grid: {}", fmt::join(done->without_grid, ", "));
  return line;
}

/// Runs something behind the window and tells how it ended.
/// after  follows in the window's turn where it ended well
void run_job(
    Workspace& workspace, std::function<Result<std::string>(const Snapshot&, Work&)> job,
    std::function<void()> after = [] {}) {
  Document& document = workspace.document;
  if (document.survey() == nullptr) return document.tell("no survey is open: there is nothing to write");
  if (!document.progress().stage.empty()) {
    return document.tell(fmt::format("wait until {} is done, or cancel it", document.progress().stage));
  }
  document.run([&document, snapshot = snapshot_of(workspace), job = std::move(job), after = std::move(after)](
                   Work& work, const CancelToken& token) {
    work.progress("writing", 0, 1);
    const auto done = job(snapshot, work);
    std::string line = done ? *done : to_line(done.error());
    if (!done && done.error().code == ErrorCode::cancelled) line = "stopped: not everything was written";
    document.post(token, [&document, line = std::move(line), well = done.has_value(), after] {
      document.tell(line);
      if (well) after();
    });
  });
}

std::unique_ptr<PictureSource> pictures_of(const Snapshot& snapshot) {
  std::vector<ObservationProduct> products;
  for (const auto& [index, product] : snapshot.products) products.push_back(*product);
  number_known(products, snapshot.numbers, snapshot.all_measured);
  // Without raw files pictures show what is known without samples, as those of a folder of results do.
  const SurveyFiles* raw = snapshot.results.empty() ? snapshot.survey : nullptr;
  return PictureSource::of({std::shared_ptr<void>(), raw}, std::move(products), snapshot.measuring);
}

std::string shown_name(const Workspace& workspace) {
  const auto& shown = workspace.document.shown();
  return shown ? shown->name() : std::string{};
}

/// What a picture or a movie is made with.
struct PictureJob {
  PictureKind kind = PictureKind::slice_top;
  std::string observation;
  PictureOptions options;
};

/// "written: 25 pictures in movie.mp4", and why it is another file than usual.
Result<std::string> movie(const Snapshot& snapshot, const PictureJob& job, const fs::path& folder, Work& work) {
  const auto source = pictures_of(snapshot);
  const auto done = write_movie(*source, job.observation, job.options, default_movie(folder / "movie"), work);
  if (!done) return pass_on(done);
  std::string line = fmt::format("written: {} in {}", count_of(done->pictures, "picture"), done->file.string());
  if (done->file.extension() == ".png") line += "; with the program ffmpeg it would be an MP4";
  return line;
}

}  // namespace

void export_results(Workspace& workspace, const fs::path& folder) {
  const auto write = [folder](const Snapshot& snapshot, Work& work) -> Result<std::string> {
    const auto report = write_survey(*snapshot.survey, folder, source_of_products(snapshot, work), work);
    if (!report) return pass_on(report);
    return fmt::format("written: {} with {} in {}", count_of(report->survey.observations.size(), "observation"),
                       count_of(counted_schools(report->survey.observations).size(), "school"), folder.string());
  };
  // From now on the window's numbers are those of the tables.
  run_job(workspace, write, [&workspace, folder] { workspace.document.keep_survey_numbers(kept_numbers(folder)); });
}

void export_as(Workspace& workspace, const std::string& format, const fs::path& folder) {
  run_job(workspace,
          [format, folder](const Snapshot& snapshot, Work& work) { return exported(snapshot, format, folder, work); });
}

Result<PictureOptions> picture_options(const Workspace& workspace, PictureKind kind) {
  const PictureFileParams& file = workspace.picture_file.values();
  PictureOptions options;
  options.size = {file.paper.width_px, file.paper.height_px};
  options.scale = file.paper.scale;
  options.dark = workspace.dark() && kind != PictureKind::report;  // paper is white
  options.units = workspace.units();
  options.display = workspace.display.values();
  options.volume = workspace.volume.values();
  options.kind = file.kind;
  options.limits_given = true;
  if (!workspace.curve_follows_scale()) options.transfer = workspace.view_curve();
  const TimelineLimits& timelines = workspace.timelines.values();
  if (kind == PictureKind::timeline) {
    options.display.scale = timelines.scale(options.display.scale, options.kind.timeline.maximum);
    options.display.filtered = timelines.filtered;
    if (timelines.own_limits) options.transfer.reset();
  }
  if (workspace.document.shown()) {
    options.ping = static_cast<int>(workspace.document.ping());
    options.fan = workspace.slices().fan;
    options.beam = workspace.slices().beam;
  }
  if (file.camera_of_window) options.camera = workspace.camera();
  if (const auto selected = workspace.selected()) {
    options.selected_school = workspace.document.state().schools[*selected]->number;
  }
  if (kind != PictureKind::volume || file.seabed) options.depth_raster = workspace.depth_raster();
  options.transects = workspace.transects().file;
  if (const auto school = selected_school(workspace); school && file.selected_school_alone) {
    options.schools = {school->name.number};
  }
  if (auto valid = validate_options(options); !valid) return pass_on(valid);
  return options;
}

namespace {

Result<PictureJob> picture_job(const Workspace& workspace, PictureKind kind) {
  auto options = picture_options(workspace, kind);
  if (!options) return pass_on(options);
  // A chart is of the survey, as the window's is.
  const std::string observation = kind == PictureKind::chart ? std::string{} : shown_name(workspace);
  return PictureJob{kind, observation, std::move(*options)};
}

}  // namespace

void save_picture(Workspace& workspace, PictureKind kind, const fs::path& file) {
  auto wanted = picture_job(workspace, kind);
  if (!wanted) return workspace.document.tell(to_line(wanted.error()));
  run_job(workspace, [job = std::move(*wanted), file](const Snapshot& snapshot, Work& work) -> Result<std::string> {
    const auto source = pictures_of(snapshot);
    if (auto outside = source->require_outside_raw(file); !outside) return pass_on(outside);
    const auto frame = picture_frame(job.kind, *source, job.observation, job.options, work);
    if (!frame) return pass_on(frame);
    if (auto written = write_picture(*frame, file, job.options.scale); !written) return pass_on(written);
    return fmt::format("written: {}", file.string());
  });
}

void save_movie(Workspace& workspace, PictureKind kind, const fs::path& folder) {
  if (!workspace.document.shown()) return workspace.document.tell("no observation is open: there is nothing to show");
  auto wanted = picture_job(workspace, kind);
  if (!wanted) return workspace.document.tell(to_line(wanted.error()));
  MovieParams& params = wanted->options.kind.movie;
  for (std::size_t of = 0; of < kMovieOfNames.size(); ++of) {
    if (drawn_kind(static_cast<MovieOf>(of)) == kind) params.of = static_cast<MovieOf>(of);
  }
  const auto school = selected_school(workspace);
  if (school && school->name.observation == workspace.document.shown()->index() &&
      !school->state->masks.pings.empty()) {
    const auto& pings = school->state->masks.pings;
    if (params.first_ping < 0) params.first_ping = static_cast<int>(pings.front().ping_index);
    if (params.last_ping < 0) params.last_ping = static_cast<int>(pings.back().ping_index);
  }
  if (auto valid = validate_movie(wanted->options); !valid) return workspace.document.tell(to_line(valid.error()));
  run_job(workspace, [job = std::move(*wanted), folder](const Snapshot& snapshot, Work& work) {
    return movie(snapshot, job, folder, work);
  });
}

}  // namespace sonar
