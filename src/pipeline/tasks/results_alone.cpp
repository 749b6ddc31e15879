// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tasks/results_alone.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "base/units.h"
#include "io/product_file.h"
#include "pipeline/journal/earlier.h"
#include "pipeline/tasks/merge.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

/// "Fish schools of SURVEY obs-0001", as observation_head() writes it.
std::string survey_name_of(const ObservationProduct& product) {
  constexpr std::string_view kBegin = "Fish schools of ";
  std::string name = product.title;
  if (name.starts_with(kBegin)) name.erase(0, kBegin.size());
  if (name.ends_with(" " + product.observation)) name.resize(name.size() - product.observation.size() - 1);
  return name;
}

/// Of the product's clock from the datagrams'.
TimeNs offset_of(const ObservationProduct& product) {
  return static_cast<TimeNs>(std::llround(time_offset_s(product.recipe_json) * 1e9));
}

/// What the grid tells of the sounder's beams.
SounderConfig config_of(const ObservationProduct& product) {
  SounderConfig config;
  config.survey_name = survey_name_of(product);
  const std::size_t version = product.source.rfind(' ');  // "MBS 1.0", as source_of() writes it
  config.sounder_name = product.source.substr(0, version);
  if (version != std::string::npos) config.version = product.source.substr(version + 1);
  if (!product.grid) return config;
  const BeamGrid& grid = product.grid->grid;
  config.sound_speed_average_mps = config.sound_speed_transducer_mps = product.grid->sound_speed_mps;
  const auto& psi_db = grid.psi_stated_db.empty() ? product.grid->psi_used_db : grid.psi_stated_db;
  for (std::size_t row = 0; row < grid.channel.size(); ++row) {
    const auto channel = static_cast<std::size_t>(grid.channel[row]);
    if (channel >= config.beams.size()) config.beams.resize(channel + 1);
    BeamConfig& beam = config.beams[channel];
    const std::size_t fan = row / static_cast<std::size_t>(grid.beams());
    beam.frequency_hz = grid.frequency_hz[fan];
    beam.width_alongship_deg = grid.vertical_width_deg[row];
    beam.width_athwartship_deg = grid.horizontal_width_deg[row];
    beam.equivalent_beam_angle_db = row < psi_db.size() ? psi_db[row] : kUnknown;
  }
  return config;
}

/// Which raw file a ping lies in is not told: all lie in the first.
class Files {
 public:
  Files(SurveyFiles& survey, fs::path folder) : survey_(survey), folder_(std::move(folder)) {}

  std::vector<std::uint32_t> of(const ObservationProduct& product) {
    std::vector<std::uint32_t> numbers;
    for (const InputFile& input : product.input_files) numbers.push_back(number_of(input));
    if (numbers.empty()) numbers.push_back(number_of({product.observation, 0, product.input_hash}));
    return numbers;
  }

 private:
  std::uint32_t number_of(const InputFile& input) {
    const auto [known, is_new] = numbers_.emplace(input.name, static_cast<std::uint32_t>(survey_.files.size()));
    if (is_new) {
      SurveyFile file;
      file.path = folder_ / fs::path(input.name).filename();
      file.index.name = file.path.string();
      file.index.size = input.size;
      file.index.hash = input.hash;
      file.index.format = RawFormat::simrad;
      survey_.files.push_back(std::move(file));
    }
    return known->second;
  }

  SurveyFiles& survey_;
  fs::path folder_;
  std::map<std::string, std::uint32_t> numbers_;
};

void add_pings(const ObservationProduct& product, std::uint32_t file, const SounderConfig& config,
               const TransmitSet& transmit, SurveyFiles& survey, ObservationFiles& observation) {
  RawIndex& index = survey.files[file].index;
  PingEntry entry;
  entry.config = static_cast<std::uint16_t>(index.configs.size());
  entry.transmit = static_cast<std::uint16_t>(index.transmits.size());
  entry.channels = static_cast<std::uint16_t>(config.beams.size());
  index.configs.emplace_back(config);
  index.transmits.emplace_back(transmit);
  const TimeNs offset = offset_of(product);
  for (const PingNavigation& at : product.pings) {
    entry.time = at.time - offset;
    entry.roll_deg = static_cast<float>(at.roll_deg);
    entry.pitch_deg = static_cast<float>(at.pitch_deg);
    entry.heave_m = static_cast<float>(at.heave_m);
    entry.transducer_depth_m = static_cast<float>(at.transducer_depth_m);
    observation.pings.push_back({file, static_cast<std::uint32_t>(index.pings.size())});
    index.pings.push_back(entry);
  }
}

ObservationFiles observation_of(const ObservationProduct& product, Files& files, SurveyFiles& survey) {
  ObservationFiles observation;
  observation.name = product.observation;
  observation.files = files.of(product);
  observation.config = config_of(product);
  observation.navigation = product.pings;
  observation.diagnostics = product.diagnostics;
  observation.gps_minus_clock_s = kUnknown;
  observation.cut_after = product.cut_after == 0 ? 0 : product.cut_after - offset_of(product);
  observation.continues_cut = product.cut_after != 0;
  if (product.grid) {
    observation.grid = product.grid->grid;
    observation.range = product.grid->range;
    observation.sample_count = product.grid->sample_count;
    observation.sound_speed_mps = product.grid->sound_speed_mps;
    observation.sample_interval_s = 2.0 * observation.range.spacing_m / observation.sound_speed_mps;
  }
  for (const BeamConfig& beam : observation.config.beams) {
    ChannelTransmit sent;
    if (beam.frequency_hz > 0.0) sent.frequency_hz = beam.frequency_hz;
    observation.transmit.push_back(sent);
  }
  add_pings(product, observation.files.front(), observation.config, observation.transmit, survey, observation);
  return observation;
}

/// Of one name in two folders: parts of a survey are run by several, two surveys are not one.
Result<void> require_same_pings(const fs::path& first, const fs::path& other) {
  const auto a = read_product_key(first);
  if (!a) return pass_on(a);
  const auto b = read_product_key(other);
  if (!b) return pass_on(b);
  if (a->source == b->source && a->first_time == b->first_time && a->last_time == b->last_time) return {};
  return fail(ErrorCode::mismatch, fmt::format("holds other pings than {}: open one survey at a time", first.string()),
              {other.string()});
}

/// The first of an observation's products that can be read; empty where none can. Those that cannot are told.
/// errors  mismatch, as require_same_pings()
Result<std::optional<ObservationProduct>> first_sound(std::span<const fs::path> files, std::vector<Error>& damaged) {
  std::optional<ObservationProduct> sound;
  const fs::path* path = nullptr;
  for (const fs::path& file : files) {
    if (sound) {
      if (!read_product_key(file)) continue;  // it is not needed
      if (auto same = require_same_pings(*path, file); !same) return pass_on(same);
      continue;
    }
    auto product = read_product(file);
    if (product) {
      sound = std::move(*product);
      path = &file;
    } else {
      damaged.push_back(product.error());
    }
  }
  return sound;
}

}  // namespace

SurveyFiles survey_of_products(std::span<const std::shared_ptr<const ObservationProduct>> products,
                               const fs::path& folder) {
  SurveyFiles survey;
  Files files(survey, folder);
  for (const auto& product : products) survey.observations.push_back(observation_of(*product, files, survey));
  return survey;
}

Result<ResultsAlone> open_results(std::span<const fs::path> folders, const std::string& why, Work& work) {
  std::map<std::string, std::vector<fs::path>> paths;
  for (const fs::path& folder : folders) {
    const auto files = product_files(folder);
    if (!files) return pass_on(files);
    for (const fs::path& file : *files) paths[file.stem().string()].push_back(file);
  }
  if (paths.empty()) return fail(ErrorCode::not_found, why);
  std::vector<std::string> names;
  for (const auto& [name, files] : paths) names.push_back(name);
  std::sort(names.begin(), names.end(), name_less);
  ResultsAlone results;
  std::vector<Error> damaged;
  for (const std::string& name : names) {
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    work.progress("reading the results", std::ssize(results.products), std::ssize(names));
    auto product = first_sound(paths.at(name), damaged);
    if (!product) return pass_on(product);
    if (!*product || (*product)->pings.empty()) continue;
    (*product)->background_db = {};
    results.products.push_back(std::make_shared<const ObservationProduct>(std::move(**product)));
  }
  if (results.products.empty() && !damaged.empty()) return tl::unexpected(damaged.front());
  if (results.products.empty()) return fail(ErrorCode::not_found, why);
  for (const Error& error : damaged) results.notices.push_back(to_line(error));
  results.survey = survey_of_products(results.products);
  results.survey.raw_gone = why;
  return results;
}

}  // namespace sonar
