// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "view/volume/context_scene.h"

namespace sonar {
namespace {

constexpr Rgba8 kHull{176, 44, 40, 255};
constexpr Rgba8 kDeck{150, 160, 150, 255};
constexpr Rgba8 kHouse{245, 245, 240, 255};
constexpr Rgba8 kMast{235, 190, 60, 255};

void add_quad(std::vector<SceneTriangle>& mesh, const std::array<Point<Sonar>, 4>& c, Rgba8 colour) {
  mesh.push_back({{c[0], c[1], c[2]}, colour});
  mesh.push_back({{c[0], c[2], c[3]}, colour});
}

/// Half breadth at a station from stern (0) to bow (1), as a share of the largest.
double half_breadth(double station) {
  const double run = std::min(1.0, 0.75 + station);               // the stern is broad
  const double entrance = std::min(1.0, (1.0 - station) / 0.35);  // the bow runs out
  return run * std::sqrt(std::max(0.0, entrance * (2.0 - entrance)));
}

/// Hull from keel to deck in strips between stations; the sheer lifts the bow.
void add_hull(std::vector<SceneTriangle>& mesh, double length) {
  constexpr int kStations = 16;
  const double beam = 0.21 * length;
  const double draught = 0.08 * length;
  struct Station {
    double x, half, deck_z;
  };
  std::vector<Station> stations;
  for (int i = 0; i <= kStations; ++i) {
    const double s = static_cast<double>(i) / kStations;
    stations.push_back({(s - 0.5) * length, 0.5 * beam * half_breadth(s), -length * (0.06 + 0.05 * s * s)});
  }
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    const Station& a = stations[i];
    const Station& b = stations[i + 1];
    for (const double side : {-1.0, 1.0}) {
      const Point<Sonar> a_deck{a.x, side * a.half, a.deck_z};
      const Point<Sonar> b_deck{b.x, side * b.half, b.deck_z};
      const Point<Sonar> a_bilge{a.x, side * 0.75 * a.half, draught};
      const Point<Sonar> b_bilge{b.x, side * 0.75 * b.half, draught};
      const Point<Sonar> a_keel{a.x, 0.0, draught};
      const Point<Sonar> b_keel{b.x, 0.0, draught};
      // Outwards: the order turns with the side.
      if (side > 0) {
        add_quad(mesh, {a_deck, a_bilge, b_bilge, b_deck}, kHull);
        add_quad(mesh, {a_bilge, a_keel, b_keel, b_bilge}, kHull);
      } else {
        add_quad(mesh, {a_deck, b_deck, b_bilge, a_bilge}, kHull);
        add_quad(mesh, {a_bilge, b_bilge, b_keel, a_keel}, kHull);
      }
    }
    add_quad(mesh,
             {Point<Sonar>{a.x, -a.half, a.deck_z},
              {a.x, a.half, a.deck_z},
              {b.x, b.half, b.deck_z},
              {b.x, -b.half, b.deck_z}},
             kDeck);
  }
  const Station& stern = stations.front();
  add_quad(mesh,
           {Point<Sonar>{stern.x, stern.half, stern.deck_z},
            {stern.x, -stern.half, stern.deck_z},
            {stern.x, -0.75 * stern.half, draught},
            {stern.x, 0.75 * stern.half, draught}},
           kHull);
}

void add_box(std::vector<SceneTriangle>& mesh, const Point<Sonar>& low, const Point<Sonar>& high, Rgba8 colour) {
  const auto at = [&](bool x, bool y, bool z) {
    return Point<Sonar>{x ? high.x : low.x, y ? high.y : low.y, z ? high.z : low.z};
  };
  add_quad(mesh, {at(false, false, false), at(false, true, false), at(true, true, false), at(true, false, false)},
           colour);
  add_quad(mesh, {at(false, false, true), at(true, false, true), at(true, true, true), at(false, true, true)}, colour);
  add_quad(mesh, {at(false, false, false), at(false, false, true), at(false, true, true), at(false, true, false)},
           colour);
  add_quad(mesh, {at(true, false, false), at(true, true, false), at(true, true, true), at(true, false, true)}, colour);
  add_quad(mesh, {at(false, false, false), at(true, false, false), at(true, false, true), at(false, false, true)},
           colour);
  add_quad(mesh, {at(false, true, false), at(false, true, true), at(true, true, true), at(true, true, false)}, colour);
}

}  // namespace

std::vector<SceneTriangle> ship_mesh(double length_m) {
  std::vector<SceneTriangle> mesh;
  const double l = std::max(1.0, length_m);
  add_hull(mesh, l);
  add_box(mesh, {-0.05 * l, -0.085 * l, -0.15 * l}, {0.22 * l, 0.085 * l, -0.06 * l}, kHouse);  // accommodation
  add_box(mesh, {0.06 * l, -0.095 * l, -0.2 * l}, {0.2 * l, 0.095 * l, -0.15 * l}, kHouse);     // bridge
  add_box(mesh, {-0.02 * l, -0.03 * l, -0.24 * l}, {0.04 * l, 0.03 * l, -0.15 * l}, kMast);     // funnel
  add_box(mesh, {0.12 * l, -0.008 * l, -0.33 * l}, {0.136 * l, 0.008 * l, -0.2 * l}, kMast);    // mast
  add_box(mesh, {-0.45 * l, -0.09 * l, -0.16 * l}, {-0.43 * l, -0.07 * l, -0.06 * l}, kMast);   // stern gantry
  add_box(mesh, {-0.45 * l, 0.07 * l, -0.16 * l}, {-0.43 * l, 0.09 * l, -0.06 * l}, kMast);
  add_box(mesh, {-0.45 * l, -0.09 * l, -0.18 * l}, {-0.43 * l, 0.09 * l, -0.16 * l}, kMast);
  return mesh;
}

}  // namespace sonar
