// SPDX-License-Identifier: Apache-2.0
#include "pipeline/exports/export.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>

#include "io/atomic_file.h"
#include "io/csv.h"
#include "io/lsss_work.h"
#include "io/mask_volume.h"
#include "io/product_file.h"
#include "io/survey_layers.h"
#include "pipeline/exports/avoidance.h"
#include "pipeline/exports/export_echoview.h"
#include "pipeline/exports/export_ices.h"
#include "pipeline/exports/export_meshes.h"
#include "pipeline/exports/export_seabed.h"
#include "pipeline/exports/export_sv.h"
#include "pipeline/exports/export_vtk.h"
#include "pipeline/exports/track_edges.h"
#include "pipeline/journal/earlier.h"
#include "pipeline/stages/placements.h"
#include "pipeline/tasks/merge.h"
#include "pipeline/tasks/plan.h"
#include "pipeline/tasks/survey_numbers.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using Files = std::vector<fs::path>;

constexpr std::array<ExportFormat, 15> kFormats = {{
    {"csv", "schools.csv, school_pings.csv and tracks_edges.csv"},
    {"netcdf-mask", "masks as whole arrays [ping][fan][beam][sample], one netCDF file an observation"},
    {"gpkg", "the survey map as one GeoPackage"},
    {"geojson", "the survey map, one GeoJSON file a layer"},
    {"ply", "surface of each school in its strongest ping, in metres: one mesh a file"},
    {"gltf", "the same surfaces, one .glb an observation"},
    {"vtu", "masks as cells for ParaView, one file a ping with schools and a .pvd that plays them"},
    {"vts", "Sv and masks on the curved grid for ParaView, likewise; needs --survey", true},
    {"ices", "acoustic XML of ICES, which StoX reads, from the tables of integrate"},
    {"echoview", "regions of each fan (.evr, depth = slant range) and the seabed (.evl)"},
    {"lsss", "school masks in the XML of LSSS, one work file an observation"},
    {"sv", "calibrated Sv, unfiltered and filtered, with masks, flags and background; needs --survey", true},
    {"avoidance",
     "avoidance.csv: speed, direction, depth and density of schools against range, bearing and time to closest "
     "approach"},
    {"seabed", "depths of the seabed that each beam saw, as a table and as a GeoTIFF; needs --survey", true},
    {"raw-reduced", "raw files with the schools' samples only; needs --survey", true},
}};

std::string format_names() {
  std::string names;
  for (const ExportFormat& format : kFormats) names += (names.empty() ? "" : ", ") + std::string(format.name);
  return names;
}

/// The products' files with the merged rows; masks are read when they are needed.
struct Source {
  Files files;
  Survey survey;
};

Result<Source> read_source(const fs::path& out, Work& work) {
  auto files = product_files(out);
  if (!files) return pass_on(files);
  if (files->empty()) return fail(ErrorCode::not_found, "there are no products in this folder", {.file = out.string()});
  std::vector<ObservationProduct> products;
  for (const fs::path& file : *files) {
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    auto product = read_product(file);
    if (!product) return pass_on(product);
    product->masks = {};
    product->background_db = {};
    products.push_back(std::move(*product));
  }
  auto survey = merge(std::move(products));
  if (!survey) return pass_on(survey);
  number_as_merged(*survey, out);
  return Source{std::move(*files), std::move(*survey)};
}

/// An observation's rows as merged, with its masks and background levels.
Result<ObservationProduct> with_masks(const Source& source, std::size_t i) {
  ObservationProduct product = source.survey.observations[i];
  auto stored = read_product(source.files[i]);
  if (!stored) return pass_on(stored);
  if (stored->observation != product.observation) {
    return fail(ErrorCode::mismatch, fmt::format("holds {}", stored->observation), {.file = source.files[i].string()});
  }
  product.masks = std::move(stored->masks);
  product.background_db = std::move(stored->background_db);
  return product;
}

Result<Exported> export_csv(const Source& source, const fs::path& dest, CsvTexts texts) {
  Files files = {dest / "schools.csv", dest / "school_pings.csv", dest / "tracks_edges.csv"};
  std::vector<TrackEdgeRow> edges;
  for (const ObservationProduct& product : source.survey.observations) {
    const std::vector<TrackEdgeRow> own = track_edges(product);
    edges.insert(edges.end(), own.begin(), own.end());
  }
  auto written = write_csv_rows(files[0], source.survey.schools, texts);
  if (written) written = write_csv_rows(files[1], source.survey.school_pings, texts);
  if (written) written = write_csv_rows(files[2], edges, texts);
  if (!written) return pass_on(written);
  return Exported{std::move(files)};
}

Result<Exported> export_avoidance(const Source& source, const fs::path& dest) {
  Files files = {dest / "avoidance.csv"};
  if (auto written = write_csv_rows(files[0], avoidance_table(source.survey.observations)); !written) {
    return pass_on(written);
  }
  return Exported{std::move(files)};
}

Result<Exported> export_masks(const Source& source, const fs::path& dest, Work& work) {
  Files files;
  for (std::size_t i = 0; i < source.files.size(); ++i) {
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    const auto product = with_masks(source, i);
    if (!product) return pass_on(product);
    files.push_back(dest / (product->observation + "-mask.nc"));
    if (auto written = write_mask_volume(*product, files.back(), work); !written) return pass_on(written);
    work.progress("masks", static_cast<std::int64_t>(i) + 1, std::ssize(source.files));
  }
  return Exported{std::move(files)};
}

Result<Exported> export_map(const Source& source, const fs::path& dest, MapFormat format, Work& work) {
  const fs::path target = format == MapFormat::geopackage ? dest / "survey.gpkg" : dest;
  auto map = SurveyMapWriter::create(target, format, source.survey.observations);
  if (!map) return pass_on(map);
  for (std::size_t i = 0; i < source.files.size(); ++i) {
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    const auto product = with_masks(source, i);
    if (!product) return pass_on(product);
    if (auto added = map->add(*product, ProductPlacements(*product)); !added) return pass_on(added);
    work.progress("map", static_cast<std::int64_t>(i) + 1, std::ssize(source.files));
  }
  if (auto finished = map->finish(); !finished) return pass_on(finished);
  return Exported{{target}};
}

/// Files of one observation each.
using ObservationWriter =
    std::function<Result<Files>(const ObservationProduct& product, const fs::path& dest, const Work& work)>;

/// errors  unsupported: none of the observations has anything for the format
Result<Exported> export_each(const Source& source, const ExportOptions& options, const ObservationWriter& write,
                             Work& work) {
  Exported done;
  for (std::size_t i = 0; i < source.files.size(); ++i) {
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    const auto product = with_masks(source, i);
    if (!product) return pass_on(product);
    auto made = write(*product, options.dest, work);
    if (!made) return pass_on(made);
    done.files.insert(done.files.end(), made->begin(), made->end());
    work.progress(options.format, static_cast<std::int64_t>(i) + 1, std::ssize(source.files));
  }
  if (!done.files.empty()) return done;
  return fail(ErrorCode::unsupported,
              fmt::format("no school has a mask in a ping with position and heading: there is nothing for {} to hold",
                          options.format),
              {.file = options.out.string()});
}

/// DEST/obs-0001.work of each observation that has masks.
Result<Exported> export_lsss(const Source& source, const ExportOptions& options, Work& work) {
  const auto write = [&](const ObservationProduct& product, const fs::path& dest, const Work&) -> Result<Files> {
    const auto offset_ns = static_cast<TimeNs>(std::llround(time_offset_s(product.recipe_json) * 1e9));
    const std::string text = lsss_work_text(product, offset_ns, options.lsss);
    if (text.empty()) return Files{};
    Files files = {dest / (product.observation + ".work")};
    if (auto written = write_file(files[0], text); !written) return pass_on(written);
    return files;
  };
  return export_each(source, options, write, work);
}

/// The raw files of the products, under their recipe.
struct RawSource {
  Recipe recipe;
  SurveyFiles survey;
};

Result<RawSource> open_raw(const Source& source, const ExportOptions& options, Work& work) {
  if (options.survey.empty()) {
    return fail(ErrorCode::usage, fmt::format("{} needs --survey, the folder of the raw files", options.format));
  }
  auto recipe = recipe_from_text(source.survey.observations.front().recipe_json);
  if (!recipe) return pass_on(recipe);
  const std::array<fs::path, 1> paths = {options.survey};
  auto survey = open_survey(paths, recipe->survey, recipe->navigation, IndexCache::of_user(), work);
  if (!survey) return pass_on(survey);
  return RawSource{std::move(*recipe), std::move(*survey)};
}

/// Files of an observation that its samples are read for.
using SampleWriter = Result<Files> (*)(const SurveyFiles& survey, const ObservationProduct& product,
                                       const Recipe& recipe, const fs::path& dest, Work& work);

Result<Exported> export_samples(const Source& source, const ExportOptions& options, SampleWriter write, Work& work) {
  const auto raw = open_raw(source, options, work);
  if (!raw) return pass_on(raw);
  Exported done;
  for (std::size_t i = 0; i < source.files.size(); ++i) {
    const auto product = with_masks(source, i);
    if (!product) return pass_on(product);
    auto made = write(raw->survey, *product, raw->recipe, options.dest, work);
    if (!made) return pass_on(made);
    if (!product->grid) done.without_grid.push_back(product->observation);
    done.files.insert(done.files.end(), made->begin(), made->end());
  }
  if (!done.files.empty()) return done;
  const bool grids = done.without_grid.size() < source.files.size();
  return fail(
      ErrorCode::unsupported,
      fmt::format("no observation has {}: there is nothing for {} to hold",
                  grids ? "pings with schools, positions and headings" : "a grid of fans and beams", options.format),
      {.file = options.survey.string()});
}

Result<Exported> export_all_seabed(const Source& source, const ExportOptions& options, Work& work) {
  const auto raw = open_raw(source, options, work);
  if (!raw) return pass_on(raw);
  auto seabed = SeabedExport::create(options.dest, options.seabed);
  if (!seabed) return pass_on(seabed);
  Exported done;
  for (std::size_t i = 0; i < source.files.size(); ++i) {
    const auto product = with_masks(source, i);
    if (!product) return pass_on(product);
    if (!product->grid) done.without_grid.push_back(product->observation);
    if (auto added = seabed->add(raw->survey, *product, raw->recipe, work); !added) return pass_on(added);
  }
  auto files = seabed->finish();
  if (!files) return pass_on(files);
  done.files = std::move(*files);
  return done;
}

Result<Exported> export_reduced(const Source& source, const ExportOptions& options, Work& work) {
  const auto raw = open_raw(source, options, work);
  if (!raw) return pass_on(raw);
  std::vector<ObservationProduct> products;
  for (std::size_t i = 0; i < source.files.size(); ++i) {
    auto product = with_masks(source, i);
    if (!product) return pass_on(product);
    // A school that a human has rejected is not selected.
    std::erase_if(product->masks, [&](const SchoolMask& m) {
      return std::any_of(product->schools.begin(), product->schools.end(),
                         [&](const SchoolRow& s) { return s.school_id == m.school_id && s.status == "rejected"; });
    });
    products.push_back(std::move(*product));
  }
  auto reduced = reduce_survey(raw->survey, products, raw->recipe, options.dest, options.reduce, work);
  if (!reduced) return pass_on(reduced);
  return Exported{std::move(reduced->files)};
}

/// Whether a folder holds every raw file that the products were made of: the survey itself, copied or moved.
bool holds_survey(const Survey& survey, const fs::path& folder) {
  std::size_t files = 0;
  for (const ObservationProduct& product : survey.observations) {
    for (const InputFile& input : product.input_files) {
      std::error_code absent;
      const auto size = fs::file_size(folder / input.name, absent);
      if (absent || size != input.size) return false;
      ++files;
    }
  }
  return files > 0;
}

/// Nothing is written where raw files lie: those that were run, those that are named, or those of a folder above.
Result<void> require_outside(const ExportOptions& options) {
  std::vector<fs::path> raw;
  if (!options.survey.empty()) raw.push_back(options.survey);
  const auto run_on = planned_survey(options.out);
  if (!run_on) return pass_on(run_on);
  raw.insert(raw.end(), run_on->begin(), run_on->end());
  if (auto outside = require_outside_raw(raw, options.dest); !outside) return outside;
  return require_not_beneath_raw(options.dest);
}

}  // namespace

std::span<const ExportFormat> export_formats() { return kFormats; }

Result<Exported> export_products(const ExportOptions& options, Work& work) {
  const auto format =
      std::find_if(kFormats.begin(), kFormats.end(), [&](const ExportFormat& f) { return f.name == options.format; });
  if (format == kFormats.end()) {
    return fail(ErrorCode::usage, fmt::format("no export format '{}'; there are {}", options.format, format_names()));
  }
  if (auto sound = validate(options.reduce); !sound) return pass_on(sound);
  if (auto outside = require_outside(options); !outside) return pass_on(outside);
  const auto source = read_source(options.out, work);
  if (!source) return pass_on(source);
  if (holds_survey(source->survey, options.dest)) {
    return fail(ErrorCode::usage, "holds the raw files, beside which nothing is ever written",
                {.file = options.dest.string()});
  }
  if (format->name == "csv") return export_csv(*source, options.dest, options.texts);
  if (format->name == "avoidance") return export_avoidance(*source, options.dest);
  if (format->name == "netcdf-mask") return export_masks(*source, options.dest, work);
  if (format->name == "gpkg") return export_map(*source, options.dest, MapFormat::geopackage, work);
  if (format->name == "geojson") return export_map(*source, options.dest, MapFormat::geojson, work);
  if (format->name == "ply") return export_each(*source, options, export_ply, work);
  if (format->name == "gltf") return export_each(*source, options, export_glb, work);
  if (format->name == "ices") {
    auto files = export_ices(source->survey.observations.front(), options.out, options.dest);
    if (!files) return pass_on(files);
    return Exported{std::move(*files)};
  }
  if (format->name == "echoview") return export_each(*source, options, export_echoview, work);
  if (format->name == "lsss") return export_lsss(*source, options, work);
  if (format->name == "vtu") return export_each(*source, options, export_vtu, work);
  if (format->name == "vts") return export_samples(*source, options, export_vts, work);
  if (format->name == "seabed") return export_all_seabed(*source, options, work);
  if (format->name == "sv") return export_samples(*source, options, export_sv, work);
  return export_reduced(*source, options, work);
}

}  // namespace sonar
