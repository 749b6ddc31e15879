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
    {"area_m2", "area that the mask covers, seen from above"},
    {"axis_deg", "bearing of the length, clockwise from true north, 0 to 180"},
    {"backscatter_calibration_se_db", "standard error of the backscatter by that of the calibration"},
    {"backscatter_m2", "total backscattering cross-section of the mask: sum of sigma_bs, no factor 4 pi"},
    {"backscatter_psi_error_db", "by how much the backscatter would rise with the equivalent beam angle of the widths"},
    {"backscatter_total_m2",
     "total backscattering cross-section of the whole school: sum of sigma_bs over the mask widened by the beam"},
    {"backscatter_total_se_m2", "standard error of backscatter_total_m2"},
    {"bearing_deg", "bearing of the centre from the vessel, clockwise from true north"},
    {"bottom_depth_m", "depth of the seabed below the centre", "sea_floor_depth_below_sea_surface"},
    {"bottom_distance_m", "depth of the seabed below the centre less the greatest depth of a member"},
    {"box_bearing_deg", "bearing of the oriented box's length, clockwise from true north, 0 to 180"},
    {"box_length_m", "longest side of the oriented box round the cells"},
    {"box_thickness_m", "shortest side of the oriented box"},
    {"box_tilt_deg", "elevation of the oriented box's length towards box_bearing_deg, positive up"},
    {"box_width_m", "middle side of the oriented box"},
    {"channel", "number of the channel, from 0"},
    {"comment", "comment of an operator"},
    {"continues", "observation and school that this one continues"},
    {"core_edge_db", "mean Sv of the core less that of the other members"},
    {"course_away_deg", "angle between the course over ground and the direction away from the ship, 0 = straight away"},
    {"course_deg", "course over ground, clockwise from true north"},
    {"course_se_deg", "standard error of the course over ground"},
    {"course_smoothed_deg", "course over ground about the ping, clockwise from true north"},
    {"course_water_deg", "course through the water, clockwise from true north"},
    {"course_water_se_deg", "standard error of the course through the water"},
    {"course_water_smoothed_deg", "course through the water about the ping, clockwise from true north"},
    {"cpa_m", "horizontal distance at the ship's closest point of approach"},
    {"current_east_mps", "eastward velocity of the water along the track", "eastward_sea_water_velocity"},
    {"current_north_mps", "northward velocity of the water along the track", "northward_sea_water_velocity"},
    {"current_se_mps", "standard error of the velocity of the water, each way"},
    {"decided_utc", "time of an operator's decision, UTC"},
    {"depth_error_m", "depth along the bent ray minus depth along the straight path, at the centre"},
    {"depth_m", "depth of the centre below the sea surface", "depth"},
    {"depth_max_m", "greatest depth of a member"},
    {"depth_min_m", "least depth of a member"},
    {"diner_nb_across", "Diner's relative size Nb across the beam: below 1.5 the beam decides the width that is seen"},
    {"diner_nb_height", "Diner's relative size Nb upright: below 1.5 the beam decides the height that is seen"},
    {"echo_id", "number of the echo, from 1, the same in all pings"},
    {"edge_flags", "where the mask is cut off", "", kEdges, true},
    {"edge_fraction", "share of the mask's outer faces that lie where it is cut off"},
    {"ended_at_reach", "ends of a propagation by hand that was asked no farther: first, last or both"},
    {"equivalent_radius_m", "radius of the sphere of volume_m3"},
    {"extinction_corrected", "1 = the figures are those without extinction, 0 = as heard"},
    {"extinction_loss_db", "largest two-way loss by extinction up to the far side of a member"},
    {"extinction_share", "share of the school's echo lost by extinction"},
    {"extinction_share_high", "the same at the upper end of the ratio's interval"},
    {"extinction_share_low", "the same at the lower end of the ratio's interval"},
    {"figure", "the figure that the judge found"},
    {"first_time_utc", "time of the first ping, UTC"},
    {"height_corrected_m", "height, beam taken out"},
    {"height_m", "apparent height: greatest minus least depth"},
    {"horizontal_range_m", "horizontal distance of the centre from the transducer"},
    {"incidence_deg", "angle between the beam to the centre and the length, beam taken out: 0 end on, 90 broadside"},
    {"judge", "the judge that refused the echo"},
    {"last_time_utc", "time of the last ping, UTC"},
    {"latitude", "latitude of the centre, WGS 84", "latitude"},
    {"length_corrected_m", "length, beam and pulse taken out"},
    {"length_m", "apparent length along the longer horizontal axis"},
    {"level_db", "reference Sv of the echo", kSv},
    {"limit", "the limit that the judge asks for"},
    {"limit_unit", "unit of figure and limit"},
    {"longitude", "longitude of the centre, WGS 84", "longitude"},
    {"mass_depth_m", "depth of the centre of mass below the sea surface, weighted by sv"},
    {"mass_latitude", "latitude of the centre of mass, weighted by sv, WGS 84"},
    {"mass_longitude", "longitude of the centre of mass, weighted by sv, WGS 84"},
    {"n_beams", "number of different azimuths"},
    {"n_fans", "number of different fans"},
    {"n_nuclei", "number of dense parts, with half the echo or less between any two"},
    {"n_pings", "number of pings in which the school was seen"},
    {"n_pings_whole", "number of these pings in which it touches no edge"},
    {"n_schools", "number of schools"},
    {"n_vacuoles", "number of voids that members enclose on all sides, as long as the pulse or longer"},
    {"n_voxels", "number of members"},
    {"name", "name given by an operator"},
    {"nasc_m2_nmi2", "nautical area scattering coefficient over area_m2: 4 pi 1852^2 backscatter_m2 / area_m2"},
    {"observation", "name of the observation"},
    {"observation_starts.n_pings", "number of pings of the observation"},
    {"observations.n_pings", "number of pings of the observation"},
    {"operator", "operator who decided last"},
    {"origin", "manual or automatic"},
    {"ping_index", "number of the ping in its observation, from 0"},
    {"provisional", "1 = pings to come may change this row", "", kNoYes},
    {"range_extent_m", "extent along range"},
    {"range_m", "slant range of the centre from the transducer"},
    {"relative_bearing_deg", "bearing of the centre from the bow, positive to starboard"},
    {"roughness", "surface over that of a smooth ellipsoid of the same volume and spread"},
    {"sample", "number of the sample, from 0"},
    {"school_id", "number of the school in its observation"},
    {"ship_speed_mps", "speed of the ship over ground"},
    {"snr_db", "signal-to-noise ratio: mean Sv over the background"},
    {"species", "species, given by an operator"},
    {"speed_away_mps", "speed over ground away from the ship, horizontally"},
    {"speed_away_se_mps", "standard error of speed_away_mps"},
    {"speed_away_water_mps", "speed through the water away from the ship, horizontally"},
    {"speed_mps", "speed over ground"},
    {"speed_se_mps", "standard error of the speed"},
    {"speed_smoothed_mps", "speed over ground about the ping, of a line through the centres of movement_window_s"},
    {"speed_smoothed_se_mps", "standard error of speed_smoothed_mps"},
    {"speed_water_mps", "speed through the water"},
    {"speed_water_se_mps", "standard error of the speed through the water"},
    {"speed_water_smoothed_mps", "speed through the water about the ping"},
    {"sphericity", "surface of the sphere of the same volume over the surface"},
    {"status", "unreviewed, accepted, corrected or rejected"},
    {"surface_distance_m", "depth of the shallowest member: distance to the sea surface"},
    {"surface_m2", "area of the outer surface"},
    {"survey_school", "number of the school in the survey, from 1; 0 = not merged yet"},
    {"sv_corrected_db", "volume backscattering strength, beam and pulse taken out of the volume", kSv},
    {"sv_kurtosis", "excess kurtosis of sv over the valid members: 6 for fading alone"},
    {"sv_max_db", "highest Sv of a single voxel", kSv},
    {"sv_mean_db", "mean volume backscattering strength Sv of the valid members, background subtracted", kSv},
    {"sv_p50_db", "median of Sv", kSv},
    {"sv_p5_db", "5th percentile of Sv", kSv},
    {"sv_p95_db", "95th percentile of Sv", kSv},
    {"sv_robust_mean_db",
     "robust mean Sv: of sv between its 5th and 95th percentile, over the share of Rayleigh fading there", kSv},
    {"sv_skewness", "skewness of sv over the valid members: 2 for fading alone"},
    {"sv_variation", "coefficient of variation of sv over the valid members: 1 for fading alone"},
    {"swept.n_pings", "number of pings of the observation"},
    {"threshold_db", "least Sv of a member"},
    {"time_to_cpa_s", "time to the ship's closest point of approach, negative = past"},
    {"time_utc", "time of the ping, UTC"},
    {"tortuosity", "length of the path over the distance from its beginning to its end"},
    {"tortuosity_se", "standard error of the tortuosity"},
    {"touches_edge", "1 = the mask is cut off by the sector, the seabed or the surface", "", kNoYes},
    {"touches_edge_fraction", "share of pings in which the mask is cut off"},
    {"vacuole_fraction", "share of the vacuoles in the volume within the outer surface"},
    {"valid_fraction", "share of the volume without faulty samples"},
    {"vertical_speed_mps", "vertical speed, positive downwards"},
    {"vertical_speed_se_mps", "standard error of the vertical speed"},
    {"vertical_speed_smoothed_mps", "vertical speed about the ping, positive downwards"},
    {"vessel_track.n_pings", "number of pings of the observation"},
    {"volume_corrected_m3", "volume, beam and pulse taken out"},
    {"volume_m3", "apparent volume: sum of the members' cells, beam width included"},
    {"wake_distance_m", "horizontal distance to where the ship sailed in the last ten minutes"},
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
