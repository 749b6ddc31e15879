// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geo/frames.h"
#include "geo/sector.h"
#include "model/mask.h"

namespace sonar {

/// Triangles in metres; seen from outside, their corners go round counter-clockwise in a right-handed frame.
template <class Frame>
struct SurfaceMesh {
  std::vector<Point<Frame>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// The confidence at which a mask's surface lies: there a voxel belongs to the school as likely as not.
inline constexpr double kSurfaceConfidence = 0.5;

/// The surface on which a mask's confidence is one half, between the centres of voxels and of those next to the mask, where
/// it is none. Around a mask of voxels that are certain it is the border of their cells, with bevelled edges. It is closed:
/// every edge belongs to two triangles, one in each direction. A hole within the school has a surface of its own.
/// out     vertices on rays from the transducer, each once; empty where no voxel is that sure
/// threads pure
/// source  marching tetrahedra: Doi and Koide 1991, IEICE Trans. E74; six tetrahedra round a cell's diagonal, after Kuhn 1960
[[nodiscard]] SurfaceMesh<Sonar> mask_surface(const PingMask& mask, const Sector& sector);

/// Volume that closed surfaces enclose, m^3; negative where they are seen from inside.
template <class Frame>
[[nodiscard]] double enclosed_volume_m3(const SurfaceMesh<Frame>& mesh) {
  double six = 0.0;
  for (const auto& t : mesh.triangles) {
    // About a corner of the mesh, not about a far origin, so that no digits are lost.
    const Point<Frame> a = mesh.vertices[t[0]] - mesh.vertices.front();
    const Point<Frame> b = mesh.vertices[t[1]] - mesh.vertices.front();
    const Point<Frame> c = mesh.vertices[t[2]] - mesh.vertices.front();
    six += a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
  }
  return six / 6.0;
}

}  // namespace sonar
