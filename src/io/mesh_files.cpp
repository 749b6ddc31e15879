// SPDX-License-Identifier: Apache-2.0
#include "io/mesh_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "base/number_text.h"

namespace sonar {
namespace {

void put_u32(std::string& out, std::uint32_t value) {
  for (unsigned shift = 0; shift < 32; shift += 8) out += static_cast<char>((value >> shift) & 0xFFU);
}

void put_f32(std::string& out, double value) { put_u32(out, std::bit_cast<std::uint32_t>(static_cast<float>(value))); }

/// glTF's parts begin at multiples of four bytes.
void pad(std::string& out, char with) {
  while (out.size() % 4 != 0) out += with;
}

Point<Enu> y_up(const Point<Enu>& p) { return {p.x, p.z, -p.y}; }

/// What a viewer needs to frame the mesh: glTF asks for it of every position.
struct Bounds {
  std::array<float, 3> low;
  std::array<float, 3> high;
};
Bounds bounds_of(const SurfaceMesh<Enu>& mesh) {
  constexpr float kFar = std::numeric_limits<float>::max();
  Bounds out{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  for (const Point<Enu>& v : mesh.vertices) {
    const Point<Enu> p = y_up(v);
    const std::array<float, 3> at = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    for (std::size_t k = 0; k < 3; ++k) {
      out.low[k] = std::min(out.low[k], at[k]);
      out.high[k] = std::max(out.high[k], at[k]);
    }
  }
  return out;
}

std::string joined(std::string text, const std::string& more) { return (text.empty() ? "" : text + ",") + more; }

/// The lists of a glTF document as they grow.
struct GltfLists {
  std::string nodes;
  std::string meshes;
  std::string accessors;
  std::string views;
  std::string scene;
  std::string bytes;

  void add(const NamedMesh& one, std::size_t i) {
    const std::size_t places = bytes.size();
    for (const Point<Enu>& v : one.mesh.vertices) {
      const Point<Enu> p = y_up(v);
      for (const double value : {p.x, p.y, p.z}) put_f32(bytes, value);
    }
    const std::size_t corners = bytes.size();
    for (const auto& triangle : one.mesh.triangles) {
      for (const std::uint32_t corner : triangle) put_u32(bytes, corner);
    }
    const Bounds bounds = bounds_of(one.mesh);
    views = joined(views, fmt::format(R"({{"buffer":0,"byteOffset":{},"byteLength":{},"target":34962}})", places,
                                      corners - places));
    views = joined(views, fmt::format(R"({{"buffer":0,"byteOffset":{},"byteLength":{},"target":34963}})", corners,
                                      bytes.size() - corners));
    accessors =
        joined(accessors,
               fmt::format(R"({{"bufferView":{},"componentType":5126,"count":{},"type":"VEC3","min":[{}],"max":[{}]}})",
                           2 * i, one.mesh.vertices.size(), fmt::join(bounds.low, ","), fmt::join(bounds.high, ",")));
    accessors = joined(accessors, fmt::format(R"({{"bufferView":{},"componentType":5125,"count":{},"type":"SCALAR"}})",
                                              2 * i + 1, 3 * one.mesh.triangles.size()));
    meshes = joined(
        meshes,
        fmt::format(R"({{"name":"{}","primitives":[{{"attributes":{{"POSITION":{}}},"indices":{},"material":0}}]}})",
                    one.name, 2 * i, 2 * i + 1));
    nodes = joined(nodes, fmt::format(R"({{"name":"{}","mesh":{}}})", one.name, i));
    scene = joined(scene, std::to_string(i));
  }
};

}  // namespace

std::string ply_bytes(const NamedMesh& mesh, const Geographic& origin) {
  std::string out = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment {}\ncomment metres: x east, y north, z up, 0 = sea surface\n"
      "comment origin latitude {} longitude {} WGS 84\ncomment surface where the confidence is {}\n"
      "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
      mesh.name, degrees_text(origin.latitude_deg), degrees_text(origin.longitude_deg), kSurfaceConfidence,
      mesh.mesh.vertices.size(), mesh.mesh.triangles.size());
  for (const Point<Enu>& v : mesh.mesh.vertices) {
    for (const double value : {v.x, v.y, v.z}) put_f32(out, value);
  }
  for (const auto& triangle : mesh.mesh.triangles) {
    out += static_cast<char>(3);
    for (const std::uint32_t corner : triangle) put_u32(out, corner);
  }
  return out;
}

std::string glb_bytes(std::span<const NamedMesh> meshes, const Geographic& origin) {
  GltfLists lists;
  for (std::size_t i = 0; i < meshes.size(); ++i) lists.add(meshes[i], i);
  std::string json = fmt::format(
      R"({{"asset":{{"version":"2.0","generator":"Sonar Explorer"}},"scene":0,"scenes":[{{"nodes":[{}],"extras":{{)"
      R"("axes":"metres: x east, y up, z south; y 0 = sea surface","origin_latitude_deg":{},"origin_longitude_deg":{},)"
      R"("surface_confidence":{}}}}}],"nodes":[{}],"meshes":[{}],"materials":[{{"name":"school","pbrMetallicRoughness":)"
      R"({{"baseColorFactor":[0.8,0.45,0.1,1],"metallicFactor":0,"roughnessFactor":0.8}}}}],)"
      R"("accessors":[{}],"bufferViews":[{}],"buffers":[{{"byteLength":{}}}]}})",
      lists.scene, degrees_text(origin.latitude_deg), degrees_text(origin.longitude_deg), kSurfaceConfidence,
      lists.nodes, lists.meshes, lists.accessors, lists.views, lists.bytes.size());
  pad(json, ' ');
  pad(lists.bytes, '\0');
  constexpr std::uint32_t kMagic = 0x46546C67;  ///< "glTF"
  constexpr std::uint32_t kJson = 0x4E4F534A;
  constexpr std::uint32_t kBinary = 0x004E4942;
  std::string out;
  for (const std::uint32_t word : {kMagic, 2U, static_cast<std::uint32_t>(28 + json.size() + lists.bytes.size()),
                                   static_cast<std::uint32_t>(json.size()), kJson}) {
    put_u32(out, word);
  }
  out += json;
  put_u32(out, static_cast<std::uint32_t>(lists.bytes.size()));
  put_u32(out, kBinary);
  return out + lists.bytes;
}

}  // namespace sonar
