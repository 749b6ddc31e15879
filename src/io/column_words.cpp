// SPDX-License-Identifier: Apache-2.0
#include "io/column_words.h"

#include <algorithm>
#include <array>

#include "io/cf_attributes.h"

namespace sonar {
namespace {

constexpr std::string_view kEdges = "fore aft top_fan bottom_fan near far seabed surface flagged_data";
constexpr std::string_view kNoYes = "no yes";
constexpr std::string_view kSv = cf::kVolumeBackscattering;

// Names of the CF standard name table (version 79 and later for those of platforms).
constexpr auto kWords = std::to_array<ColumnWords>({
    {"above_water", "evidence: standard deviations by which the echo lies above its background"},
    {"axis_deg", "bearing of the length, clockwise from true north, 0 to 180"},
    {"backscatter_calibration_se_db", "standard error of the backscatter by that of the calibration"},
    {"backscatter_m2", "total backscattering cross-section of the mask: sum of sigma_bs, no factor 4 pi"},
    {"backscatter_psi_error_db", "by how much the backscatter would rise with the equivalent beam angle of the widths"},
    {"backscatter_total_m2",
     "total backscattering cross-section of the whole school: sum of sigma_bs over the mask widened by the beam"},
    {"backscatter_total_se_m2", "standard error of backscatter_total_m2"},
    {"bearing_deg", "bearing of the centre from the vessel, clockwise from true north"},
    {"bottom_depth_m", "depth of the seabed below the centre", "sea_floor_depth_below_sea_surface"},
    {"channel", "number of the channel, from 0"},
    {"comment", "comment of an operator"},
    {"continues", "observation and school that this one continues"},
    {"course_deg", "course over ground, clockwise from true north"},
    {"decided_utc", "time of an operator's decision, UTC"},
    {"depth_error_m", "depth along the bent ray minus depth along the straight path, at the centre"},
    {"depth_m", "depth of the centre below the sea surface", "depth"},
    {"depth_max_m", "greatest depth of a member"},
    {"depth_min_m", "least depth of a member"},
    {"echo_id", "number of the echo, from 1, the same in all pings"},
    {"edge_flags", "where the mask is cut off", "", kEdges, true},
    {"edge_fraction", "share of the mask's outer faces that lie where it is cut off"},
    {"ended_at_reach", "ends of a propagation by hand that was asked no farther: first, last or both"},
    {"figure", "the figure that the judge found"},
    {"first_time_utc", "time of the first ping, UTC"},
    {"height_corrected_m", "height, beam taken out"},
    {"height_m", "apparent height: greatest minus least depth"},
    {"judge", "the judge that refused the echo"},
    {"last_time_utc", "time of the last ping, UTC"},
    {"latitude", "latitude of the centre, WGS 84", "latitude"},
    {"length_corrected_m", "length, beam and pulse taken out"},
    {"length_m", "apparent length along the longer horizontal axis"},
    {"level_db", "reference Sv of the echo", kSv},
    {"limit", "the limit that the judge asks for"},
    {"limit_unit", "unit of figure and limit"},
    {"longitude", "longitude of the centre, WGS 84", "longitude"},
    {"n_beams", "number of different azimuths"},
    {"n_fans", "number of different fans"},
    {"n_pings", "number of pings in which the school was seen"},
    {"n_pings_whole", "number of these pings in which it touches no edge"},
    {"n_schools", "number of schools"},
    {"n_voxels", "number of members"},
    {"name", "name given by an operator"},
    {"observation", "name of the observation"},
    {"observation_starts.n_pings", "number of pings of the observation"},
    {"observations.n_pings", "number of pings of the observation"},
    {"operator", "operator who decided last"},
    {"origin", "manual or automatic"},
    {"ping_index", "number of the ping in its observation, from 0"},
    {"provisional", "1 = pings to come may change this row", "", kNoYes},
    {"range_extent_m", "extent along range"},
    {"range_m", "slant range of the centre from the transducer"},
    {"sample", "number of the sample, from 0"},
    {"school_id", "number of the school in its observation"},
    {"snr_db", "signal-to-noise ratio: mean Sv over the background"},
    {"species", "species, given by an operator"},
    {"speed_mps", "speed over ground"},
    {"speed_se_mps", "standard error of the speed"},
    {"status", "unreviewed, accepted, corrected or rejected"},
    {"survey_school", "number of the school in the survey, from 1; 0 = not merged yet"},
    {"sv_corrected_db", "volume backscattering strength, beam and pulse taken out of the volume", kSv},
    {"sv_max_db", "highest Sv of a single voxel", kSv},
    {"sv_mean_db", "mean volume backscattering strength Sv of the valid members, background subtracted", kSv},
    {"sv_p95_db", "95th percentile of Sv", kSv},
    {"swept.n_pings", "number of pings of the observation"},
    {"threshold_db", "least Sv of a member"},
    {"time_utc", "time of the ping, UTC"},
    {"touches_edge", "1 = the mask is cut off by the sector, the seabed or the surface", "", kNoYes},
    {"touches_edge_fraction", "share of pings in which the mask is cut off"},
    {"valid_fraction", "share of the volume without faulty samples"},
    {"vertical_speed_mps", "vertical speed, positive downwards"},
    {"vessel_track.n_pings", "number of pings of the observation"},
    {"volume_corrected_m3", "volume, beam and pulse taken out"},
    {"volume_m3", "apparent volume: sum of the members' cells, beam width included"},
    {"width_corrected_m", "width, beam and pulse taken out"},
    {"width_m", "apparent width along the shorter horizontal axis"},
});
static_assert(std::ranges::is_sorted(kWords, {}, &ColumnWords::name));

}  // namespace

std::vector<std::int64_t> ColumnWords::flags() const {
  std::vector<std::int64_t> out;
  if (meanings.empty()) return out;
  for (std::int64_t i = 0; i <= std::ranges::count(meanings, ' '); ++i) out.push_back(bits ? std::int64_t{1} << i : i);
  return out;
}

const ColumnWords* words_of(std::string_view name) {
  const auto* const found = std::ranges::lower_bound(kWords, name, {}, &ColumnWords::name);
  return found == kWords.end() || found->name != name ? nullptr : found;
}

}  // namespace sonar
