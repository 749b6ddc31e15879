// SPDX-License-Identifier: Apache-2.0
#include "pipeline/exports/export_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "io/atomic_file.h"
#include "io/mesh_files.h"
#include "model/local_frame.h"
#include "model/strongest_ping.h"
#include "pipeline/stages/placements.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

struct Meshes {
  Geographic origin;
  std::vector<NamedMesh> meshes;
};

SurfaceMesh<Enu> moved(const SurfaceMesh<Sonar>& surface, const LocalFrame::Ping& into) {
  SurfaceMesh<Enu> out;
  for (const Point<Sonar>& v : surface.vertices) out.vertices.push_back(into.place(v));
  // East, north, up is right-handed as bow, starboard, down is: the same way round stays outward.
  out.triangles = surface.triangles;
  return out;
}

Result<Meshes> meshes_of(const ObservationProduct& product, const Work& work) {
  Meshes out;
  const auto frame = LocalFrame::of(product);
  if (!frame || !product.grid) return out;
  out.origin = frame->origin();
  const Sector sector = product.grid->grid.sector(product.grid->range);
  const ProductPlacements placements(product);
  for (const SchoolRow& school : product.schools) {
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    if (school.status == "rejected") continue;
    const SchoolPingRow* row =
        strongest_ping(product, [&](const SchoolRow& one) { return one.school_id == school.school_id; });
    if (row == nullptr) continue;
    const auto mask = std::ranges::find_if(product.masks, [&](const SchoolMask& m) {
      return m.school_id == row->school_id && m.ping_index == row->ping_index;
    });
    // A mask lies in a ping that is there; a row of a table may name any.
    if (mask == product.masks.end()) continue;
    const PingNavigation& ping = product.pings[static_cast<std::size_t>(mask->ping_index)];
    const auto into = frame->ping(ping, placements.of(ping));
    if (!into) continue;
    SurfaceMesh<Enu> mesh = moved(mask_surface(mask->mask, sector), *into);
    if (mesh.triangles.empty()) continue;
    out.meshes.push_back(
        {fmt::format("{}-school-{}-ping-{}", product.observation, row->school_id, row->ping_index), std::move(mesh)});
  }
  return out;
}

}  // namespace

Result<std::vector<fs::path>> export_ply(const ObservationProduct& product, const fs::path& dest, const Work& work) {
  const auto meshes = meshes_of(product, work);
  if (!meshes) return pass_on(meshes);
  std::vector<fs::path> files;
  for (const NamedMesh& one : meshes->meshes) {
    files.push_back(dest / (one.name + ".ply"));
    if (auto written = write_file(files.back(), ply_bytes(one, meshes->origin)); !written) return pass_on(written);
  }
  return files;
}

Result<std::vector<fs::path>> export_glb(const ObservationProduct& product, const fs::path& dest, const Work& work) {
  const auto meshes = meshes_of(product, work);
  if (!meshes) return pass_on(meshes);
  std::vector<fs::path> files;
  if (meshes->meshes.empty()) return files;
  files.push_back(dest / (product.observation + ".glb"));
  const std::string bytes = glb_bytes(meshes->meshes, meshes->origin);
  if (bytes.size() > std::numeric_limits<std::uint32_t>::max()) {
    return fail(ErrorCode::unsupported, "the surfaces need more than the 4 GB of a .glb; ply has a file for each",
                {.file = files.back().string()});
  }
  if (auto written = write_file(files.back(), bytes); !written) return pass_on(written);
  return files;
}

}  // namespace sonar
