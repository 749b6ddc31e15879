// SPDX-License-Identifier: Apache-2.0
#include "synth/scene.h"

#include "geo/geodesic.h"
#include "geo/sector.h"

namespace sonar::synth {

Scene empty_scene(int pings) {
  Scene scene;
  scene.pings = pings;
  scene.water.reverberation_sv_db = -300.0;
  scene.water.surface_db = -400.0;
  scene.water.seabed_db = -400.0;
  scene.noise.speckle = false;
  scene.noise.background_power_db = -300.0;
  scene.noise.background_spread_db = 0.0;
  scene.noise.ringing_power_db = -400.0;
  return scene;
}

Point<Enu> place_seen(const Scene& scene, double range_m, double elevation_deg, double azimuth_deg) {
  const Point<Sonar> seen = Sector::direction(rad_from_deg(elevation_deg), rad_from_deg(azimuth_deg)) * range_m;
  const PingNavigation n = navigation_at(scene, 0.0);
  Point<Enu> p = to_enu(seen, rad_from_deg(n.heading_deg)) + ship_at(scene, 0.0);
  p.z -= scene.ship.transducer_depth_m;
  return p;
}

}  // namespace sonar::synth
