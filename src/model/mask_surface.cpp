// SPDX-License-Identifier: Apache-2.0
#include "model/mask_surface.h"

#include <algorithm>
#include <cstddef>
#include <unordered_map>
#include <utility>

#include "base/array.h"

namespace sonar {
namespace {

constexpr double kLevel = 255.0 * kSurfaceConfidence;  ///< 127.5: no voxel lies on it

/// A mask's box of voxels with one node more on every side, where the confidence is none.
struct Nodes {
  std::array<int, 3> first{};  ///< fan, beam, sample of node 0
  Array3<std::uint8_t> confidence;
};

Nodes nodes_of(const PingMask& mask, int beams) {
  std::array<int, 3> low = {mask.runs.front().row / beams, beams, mask.runs.front().first_sample};
  std::array<int, 3> high = {0, 0, 0};
  for (const Run& run : mask.runs) {
    const std::array<int, 3> from = {run.row / beams, run.row % beams, run.first_sample};
    const std::array<int, 3> to = {from[0], from[1], run.end() - 1};
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], from[k]);
      high[k] = std::max(high[k], to[k]);
    }
  }
  Nodes nodes;
  nodes.first = {low[0] - 1, low[1] - 1, low[2] - 1};
  nodes.confidence = Array3<std::uint8_t>({high[0] - low[0] + 3, high[1] - low[1] + 3, high[2] - low[2] + 3});
  std::size_t voxel = 0;
  for (const Run& run : mask.runs) {
    const auto row = nodes.confidence.row(run.row / beams - nodes.first[0], run.row % beams - nodes.first[1]);
    for (int s = run.first_sample; s < run.end(); ++s) {
      row[static_cast<std::size_t>(s - nodes.first[2])] = mask.confidence[voxel++];
    }
  }
  return nodes;
}

using Node = std::array<int, 3>;  ///< among the nodes

class Mesher {
 public:
  Mesher(const Nodes& nodes, const Sector& sector) : nodes_(nodes), sector_(sector) {}

  SurfaceMesh<Sonar> made() {
    const Shape3& shape = nodes_.confidence.shape();
    for (int f = 0; f + 1 < shape.fans; ++f) {
      for (int b = 0; b + 1 < shape.beams; ++b) {
        for (int s = 0; s + 1 < shape.samples; ++s) {
          if (crosses({f, b, s})) add_cell({f, b, s});
        }
      }
    }
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] std::uint8_t value(const Node& n) const { return nodes_.confidence(n[0], n[1], n[2]); }
  [[nodiscard]] bool inside(const Node& n) const { return value(n) > kLevel; }

  /// Whether the eight corners of a cell differ.
  [[nodiscard]] bool crosses(const Node& at) const {
    const bool first = inside(at);
    for (int corner = 1; corner < 8; ++corner) {
      if (inside({at[0] + (corner >> 2), at[1] + ((corner >> 1) & 1), at[2] + (corner & 1)}) != first) return true;
    }
    return false;
  }

  /// Each order of the three axes is a way along edges from a cell's first corner to its last: a tetrahedron. Neighbouring
  /// cells share the diagonals of their faces, so that nothing gapes. Even orders are right-handed.
  void add_cell(const Node& at) {
    constexpr std::array<std::array<std::size_t, 3>, 6> kOrders = {
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    for (std::size_t i = 0; i < kOrders.size(); ++i) {
      std::array<Node, 4> corners = {at, at, at, at};
      for (std::size_t step = 0; step < 3; ++step) {
        for (std::size_t c = step + 1; c < 4; ++c) ++corners[c][kOrders[i][step]];
      }
      if (i >= 3) std::swap(corners[2], corners[3]);
      add_tetrahedron(corners);
    }
  }

  /// corners  right-handed: (1-0) x (2-0) . (3-0) > 0 in (fan, beam, sample), which is right-handed in the sonar's frame too
  void add_tetrahedron(std::array<Node, 4> corners) {
    // Those inside come first; every exchange turns the handedness round.
    bool flipped = false;
    for (std::size_t end = 3; end > 0; --end) {
      for (std::size_t i = 0; i < end; ++i) {
        if (inside(corners[i]) || !inside(corners[i + 1])) continue;
        std::swap(corners[i], corners[i + 1]);
        flipped = !flipped;
      }
    }
    const auto& [a, b, c, d] = corners;
    const auto within = std::count_if(corners.begin(), corners.end(), [&](const Node& n) { return inside(n); });
    if (within == 1) add_triangle(vertex(a, b), vertex(a, c), vertex(a, d), flipped);
    if (within == 3) add_triangle(vertex(d, a), vertex(d, b), vertex(d, c), flipped);
    if (within == 2) {
      const std::array<std::uint32_t, 4> quad = {vertex(a, c), vertex(a, d), vertex(b, d), vertex(b, c)};
      add_triangle(quad[0], quad[1], quad[2], flipped);
      add_triangle(quad[0], quad[2], quad[3], flipped);
    }
  }

  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool flipped) {
    mesh_.triangles.push_back(flipped ? std::array{a, c, b} : std::array{a, b, c});
  }

  /// Where the level lies on the edge between two nodes, of which one is inside.
  std::uint32_t vertex(Node a, Node b) {
    if (b < a) std::swap(a, b);
    const Shape3& shape = nodes_.confidence.shape();
    const std::size_t node =
        (static_cast<std::size_t>(a[0]) * static_cast<std::size_t>(shape.beams) + static_cast<std::size_t>(a[1])) *
            static_cast<std::size_t>(shape.samples) +
        static_cast<std::size_t>(a[2]);
    const auto way = static_cast<std::size_t>((b[0] - a[0]) * 4 + (b[1] - a[1]) * 2 + (b[2] - a[2]));
    const auto [known, added] =
        vertices_.try_emplace(node * 8 + way, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (added) mesh_.vertices.push_back(crossing(a, b));
    return known->second;
  }

  [[nodiscard]] Point<Sonar> crossing(const Node& a, const Node& b) const {
    const double part = (kLevel - value(a)) / (static_cast<double>(value(b)) - value(a));
    const auto index = [&](std::size_t k) { return nodes_.first[k] + a[k] + part * (b[k] - a[k]); };
    return sector_.place_at({index(0), index(1), index(2)});
  }

  const Nodes& nodes_;
  const Sector& sector_;
  SurfaceMesh<Sonar> mesh_;
  std::unordered_map<std::size_t, std::uint32_t> vertices_;  ///< by edge
};

}  // namespace

SurfaceMesh<Sonar> mask_surface(const PingMask& mask, const Sector& sector) {
  if (mask.empty() || sector.beams() == 0) return {};
  const Nodes nodes = nodes_of(mask, sector.beams());
  return Mesher(nodes, sector).made();
}

}  // namespace sonar
