// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "base/describe.h"
#include "base/time.h"
#include "base/units.h"
#include "geo/frames.h"
#include "model/navigation.h"
#include "synth/beam_pattern.h"
#include "synth/beam_table.h"
#include "synth/body.h"
#include "synth/voyage.h"

namespace sonar::synth {

/// What is in the water besides fish.
struct Water {
  double reverberation_sv_db = -85.0;  ///< everywhere
  double surface_db = -45.0;           ///< backscatter of the sea surface per m^2; below -200 = none
  double seabed_db = -5.0;             ///< Lambert constant of the seabed; below -200 = none
  double seabed_depth_m = 260.0;       ///< at the scene's origin
  double seabed_slope_east = 0.0;      ///< metres deeper per metre
  double seabed_slope_north = 0.0;
  double seabed_relief_m = 0.0;           ///< standard deviation of the depth about that plane
  double seabed_relief_length_m = 150.0;  ///< the shortest hills from crest to crest; the longest are four times that
};

template <class Visitor>
void describe(Visitor& v, Water& p) {
  v.field("reverberation_sv_db", p.reverberation_sv_db,
          {.unit = "dB re 1 m-1",
           .min = -300,
           .max = 0,
           .text = "Sv of the water itself, everywhere. Raise it to test water with plankton, in which weak schools "
                   "hardly rise above the background."});
  v.field("surface_db", p.surface_db,
          {.unit = "dB",
           .min = -400,
           .max = 0,
           .text = "Backscatter of the sea surface per square metre. Raise it for a rough sea whose echo hides shallow "
                   "schools; set it below -200 for no surface."});
  v.field("seabed_db", p.seabed_db,
          {.unit = "dB",
           .min = -400,
           .max = 0,
           .text = "Backscatter of the seabed (Lambert constant). Lower it for soft ground, raise it to test schools "
                   "close to a strong seabed echo; below -200 there is no seabed."});
  v.field("seabed_depth_m", p.seabed_depth_m,
          {.unit = "m",
           .min = 20,
           .max = 12000,
           .text = "Water depth at the start. Lower it to bring the seabed echo to the ranges of the schools; raise it "
                   "for deep water whose seabed is out of reach."});
  v.field("seabed_slope_east", p.seabed_slope_east,
          {.unit = "1",
           .min = -0.5,
           .max = 0.5,
           .text = "How much deeper the seabed becomes per metre to the east. Raise or lower it from 0 to test that "
                   "the seabed is followed on a slope."});
  v.field("seabed_slope_north", p.seabed_slope_north,
          {.unit = "1",
           .min = -0.5,
           .max = 0.5,
           .text = "How much deeper the seabed becomes per metre to the north. Raise or lower it from 0 to test that "
                   "the seabed is followed on a slope."});
  v.field("seabed_relief_m", p.seabed_relief_m,
          {.unit = "m",
           .min = 0,
           .max = 100,
           .text = "Standard deviation of the depth over hills and hollows. Raise it to test that the seabed is told "
                   "from schools on uneven ground; set it to 0 for an even seabed."});
  v.field("seabed_relief_length_m", p.seabed_relief_length_m,
          {.unit = "m",
           .min = 20,
           .max = 5000,
           .text = "Shortest distance from crest to crest of the seabed's hills. Lower it to test steep, narrow hills "
                   "that may look like schools; raise it for gentle ones."});
}

/// What the sonar adds. Levels are powers, rates are mean numbers of events in a ping.
struct Noise {
  bool speckle = true;               ///< false: every sample is its expected value
  double speckle_correlation = 0.5;  ///< of the amplitude from sample to sample; the filter is as long as the pulse
  double background_power_db = -170.0;
  double background_spread_db = 2.0;  ///< standard deviation over the beams
  double ringing_power_db = -80.0;    ///< at range 0; below -200 none
  double ringing_decay_db_per_m = 6.5;
  double corrupted_packets = 0.0;
  double interference = 0.0;
  double impulse_noise = 0.0;
  double dropouts = 0.0;
  double side_lobe_db = -400.0;  ///< energy of the side lobes (four times the main lobe's width); below -200 none
  double scale = 1.0;            ///< multiplies every noise's power and every rate
};

template <class Visitor>
void describe(Visitor& v, Noise& p) {
  v.field("speckle", p.speckle,
          {.text = "Whether echoes vary at random from sample to sample, as those of many fish do. Turn it off to see "
                   "expected values alone, when looking for a systematic error."});
  v.field("speckle_correlation", p.speckle_correlation,
          {.unit = "1",
           .min = 0,
           .max = 0.95,
           .text = "Correlation of the echo amplitudes of neighbouring samples. Raise it to test filters on speckle "
                   "that varies slowly along range; set it to 0 for independent samples."});
  v.field("background_power_db", p.background_power_db,
          {.unit = "dB re 1 W",
           .min = -300,
           .max = -50,
           .text = "Background noise power in every sample. Raise it to test how far away schools are detected from a "
                   "noisy ship; lower it for a quiet ship."});
  v.field("background_spread_db", p.background_spread_db,
          {.unit = "dB",
           .min = 0,
           .max = 10,
           .text = "Standard deviation of the background noise over the beams. Raise it to test that noisy and quiet "
                   "beams are treated alike; set it to 0 for equal beams."});
  v.field("ringing_power_db", p.ringing_power_db,
          {.unit = "dB re 1 W",
           .min = -400,
           .max = 0,
           .text = "Power of the transducer's ringing at range 0. Raise it to test how much near field must be left "
                   "out; set it below -200 for no ringing."});
  v.field("ringing_decay_db_per_m", p.ringing_decay_db_per_m,
          {.unit = "dB m-1",
           .min = 0.1,
           .max = 100,
           .text = "How fast the transducer's ringing weakens with range. Lower it to test ringing that reaches the "
                   "nearest schools."});
  v.field("corrupted_packets", p.corrupted_packets,
          {.unit = "ping-1",
           .min = 0,
           .max = 100,
           .text = "Mean number of stretches of corrupted packets that begin in a ping. Raise it to test how they are "
                   "flagged, and schools that they cross; set it to 0 for none."});
  v.field("interference", p.interference,
          {.unit = "ping-1",
           .min = 0,
           .max = 20,
           .text = "Mean number of shells of interference at constant range in a ping, as from another vessel's "
                   "sounder. Raise it to test how they are flagged; set it to 0 for none."});
  v.field("impulse_noise", p.impulse_noise,
          {.unit = "ping-1",
           .min = 0,
           .max = 600,
           .text = "Mean number of peaks of impulse noise in a ping, each 1 to 3 samples of one beam. Raise it to test "
                   "how they are flagged and removed; set it to 0 for none."});
  v.field("dropouts", p.dropouts,
          {.unit = "ping-1",
           .min = 0,
           .max = 100,
           .text = "Mean number of dropouts that begin in a ping, each of 1 to 10 channels for up to 3 pings. Raise it "
                   "to test schools with missing beams; set it to 0 for none."});
  v.field("side_lobe_db", p.side_lobe_db,
          {.unit = "dB",
           .min = -400,
           .max = -10,
           .text = "Energy of the beams' side lobes. Raise it to test strong schools with side-lobe echoes around "
                   "them; set it below -200 for none."});
  v.field("scale", p.scale,
          {.unit = "1",
           .min = 0,
           .max = 10,
           .text = "Factor on the power and rate of all noise, with reverberation and surface echo. Raise it to find "
                   "the noise in which detection fails; set it to 0 for clean water."});
}

/// A fault placed on purpose.
struct CorruptedStretch {
  int ping = 0;
  int channel = 0;
  int first_sample = 0;
  int count = 0;
  double power_db = -110.0;
};
struct Interference {
  int ping = 0;
  int first_sample = 0;
  int count = 3;
  double power_db = -115.0;
  int fan = -1;  ///< -1 = all beams (without a grid always all)
};
/// One voxel lit, without beam pattern, pulse or speckle.
struct VoxelTarget {
  int ping = 0;
  int channel = 0;
  int sample = 0;
  double sv_db = -20.0;
};

/// Everything that one synthetic observation is made of. Plain values; SyntheticSonar (synth/sonar.h) renders it.
struct Scene : Voyage {
  std::vector<Beam> beams = ms70_beams();
  BeamPattern beam_pattern = BeamPattern::gaussian;
  Water water;
  Noise noise;
  std::vector<Body> bodies;
  std::vector<CorruptedStretch> corrupted_packets;
  std::vector<Interference> interference;
  std::vector<VoxelTarget> voxel_targets;
  std::uint64_t seed = 1;
  std::uint32_t observation = 0;  ///< part of every random stream's key
};

/// A scene without any noise, speckle, surface, seabed or reverberation, to place bodies or voxels in exactly.
[[nodiscard]] Scene empty_scene(int pings = 1);
/// The centre of a body that the ship sees, at time 0, at this range, elevation and azimuth clockwise from the bow.
[[nodiscard]] Point<Enu> place_seen(const Scene& scene, double range_m, double elevation_deg, double azimuth_deg);

}  // namespace sonar::synth
