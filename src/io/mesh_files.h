// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "model/mask_surface.h"

namespace sonar {

/// A mesh with what it is of: letters, digits and the like, no quotes and no line breaks.
struct NamedMesh {
  std::string name;
  SurfaceMesh<Enu> mesh;  ///< m east, north and up of the origin, whose height is the sea surface
};

/// Binary PLY (little-endian): x east, y north, z up, float32. Comments tell the name, axes and origin.
[[nodiscard]] std::string ply_bytes(const NamedMesh& mesh, const Geographic& origin);

/// Binary glTF 2.0 with one node a mesh. glTF's y is up: x east, y up, z south; `extras` of the scene tell so, and the origin.
/// meshes  each with triangles; at least one
[[nodiscard]] std::string glb_bytes(std::span<const NamedMesh> meshes, const Geographic& origin);

}  // namespace sonar
