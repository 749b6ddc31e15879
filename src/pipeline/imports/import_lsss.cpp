// SPDX-License-Identifier: Apache-2.0
#include "pipeline/imports/import_lsss.h"

#include <fmt/format.h>

#include <cstddef>
#include <vector>

#include "base/number_text.h"
#include "io/lsss_work.h"

namespace sonar {

Result<void> import_lsss(const std::string& text, const std::string& file, const ImportPlace& place, Imported& imported,
                         const Work& work) {
  const auto schools = parse_lsss_work(text, file, place.lsss, &work);
  if (!schools) return pass_on(schools);
  std::vector<std::size_t> pings_placed(schools->size(), 0);
  for (const std::size_t index : place.observations) {
    const ObservationFiles& observation = place.survey->observations[index];
    std::vector<TimeNs> times;
    for (std::size_t i = 0; i < observation.pings.size(); ++i) times.push_back(place.survey->ping_time(observation, i));
    const auto cells = place_lsss(*schools, *observation.grid, observation.sample_count, times, file, &work);
    if (!cells) return pass_on(cells);
    for (const LsssCells& one : *cells) {
      ImportedSchool& school = imported.school(fmt::format("{}: {}", file, one.school), index);
      school.species = main_species((*schools)[one.school]);
      std::vector<RunKey>& runs = school.pings[one.ping_index];
      for (const LsssRun& run : one.runs) runs.push_back({run.channel, run.first_sample, run.count});
      ++pings_placed[one.school];
    }
  }
  for (std::size_t i = 0; i < schools->size(); ++i) {
    const std::size_t pings = (*schools)[i].pings.size();
    if (pings_placed[i] >= pings) continue;  // one that two observations have is placed in both
    imported.left_out.push_back(fmt::format("{}: school {}: {} that the survey does not have", printable(file), i + 1,
                                            count_of(pings - pings_placed[i], "ping")));
  }
  return {};
}

}  // namespace sonar
