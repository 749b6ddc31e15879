// SPDX-License-Identifier: Apache-2.0
// sonar_bench_render FOLDER [FRAMES [REFERENCE_STEP]]: both ray-casters on the four scenes of make_scene.py, beside the
// paper's naive shader (where OpenGL can be had) and VTK's GPU mapper (where vtk_volume.py has left vtk.csv in FOLDER).
// Every answer is checked before it is timed; ratios within the run are guarded by the targets. Ends with 1 where a check
// or a guard fails, and says which comparisons were not made. Pictures are left in FOLDER.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "measured.h"
#include "render/draw_frame.h"
#include "render/gl/capabilities.h"
#include "render/gl/context_egl.h"
#include "render/reference/brute_force.h"
#include "render/refinement.h"
#include "rivals.h"
#include "scene_files.h"
#include "targets.h"

namespace sonar::bench {
namespace {

/// Samples, segments and leaps of a frame at default quality, as recorded when the benchmark was made: no more than
/// 5 % above. The numbers do not depend on the machine.
struct Recorded {
  SceneName scene;
  std::int64_t samples;
  std::int64_t segments;
  std::int64_t leaps;
};
constexpr std::array<Recorded, 4> kRecorded{{{{"overview", "schools"}, 14677676, 76268, 3145348},
                                             {{"closeup", "schools"}, 48117443, 431536, 15176416},
                                             {{"overview", "haze"}, 14758108, 8943294, 0},
                                             {{"closeup", "haze"}, 48469714, 38043011, 0}}};

class Bench {
 public:
  Bench(std::string folder, int frames, double reference_step)
      : folder_(std::move(folder)), frames_(frames), reference_step_(reference_step) {}

  bool run() {
    const auto context = ContextEgl::make();
    std::optional<GlCapabilities> driver;
    if (context && context->make_current()) {
      driver.emplace();
      if (auto found = capabilities()) driver = std::move(*found);
    } else {
      targets_.skip("the naive shader and our OpenGL back-end", "no OpenGL context can be had here");
      tell();
    }
    Rivals rivals(folder_, frames_, std::move(driver), targets_, work_);
    for (const Recorded& recorded : kRecorded) {
      const auto scene = read_scene(folder_, recorded.scene.view, recorded.scene.table);
      if (!scene) {
        fmt::print(stderr, "{}: no scene; make_scene.py writes one\n", folder_);
        return false;
      }
      fmt::print("\n{}\n", recorded.scene.text());
      one_scene(*scene, recorded, rivals);
    }
    along_the_beams(rivals);
    fmt::print("\n");
    for (const std::string& line : targets_.verdict()) fmt::print("{}\n", line);
    return targets_.hold();
  }

 private:
  void expect(bool ok, const std::string& what) {
    targets_.require(ok, what);
    tell();
  }

  void tell() { bench::tell(targets_); }

  void one_scene(const SceneFiles& scene, const Recorded& recorded, Rivals& rivals) {
    const auto r = make_cpu_renderer();
    if (!r->set_volume(scene.volume) || !r->set_transfer(scene.table)) std::exit(EXIT_FAILURE);
    verify(*r, scene);
    const Image reference = black(drawn(*r, scene.view, {1, reference_step_, 0.0, 0}, work_));
    const RayImage still = drawn(*r, scene.view, {}, work_);
    const double quality_db = psnr_db(black(still), reference);
    const Times full = timed(frames_, [&] { (void)drawn(*r, scene.view, {}, work_); });
    report(r->name(), full, quality_db);
    counts(still.counts, recorded);
    const double tile = worst_tile_psnr_db(black(still), black(drawn(*r, scene.view, {1, 1.0, 0.0, 0}, work_)));
    fmt::print("  worst 64 x 64 tile against no thin cells {:.1f} dB\n", tile);
    expect(tile >= 48.0, "a tile below 48 dB against no thin cells");
    at_rest(*r, scene);
    interaction(*r, scene);
    dragging(*r, scene, reference);
    keep(black(still), folder_, recorded.scene, "ours");
    keep(reference, folder_, recorded.scene, "reference");
    rivals.beside(scene, recorded.scene, full, quality_db, reference);
  }

  /// A small picture at the reference's step against the reference by brute force.
  void verify(VolumeRenderer& r, const SceneFiles& scene) {
    VolumeView small = scene.view;
    small.size = {40, 30};
    const Image truth = black(brute_force(*scene.volume, scene.table, {}, small, 0.125, work_));
    const double fine = psnr_db(black(drawn(r, small, {1, 0.125, 0.0, 0}, work_)), truth);
    fmt::print("  against brute force, both at 1/8 of a sample: {:.1f} dB\n", fine);
    expect(fine >= 58.0, "another picture than brute force");
  }

  void counts(const RayCounts& c, const Recorded& recorded) {
    fmt::print("  rays {}  samples {} ({})  segments {} ({})  leaps {} ({})\n", c.rays, c.samples, recorded.samples,
               c.segments, recorded.segments, c.leaps, recorded.leaps);
    const auto grown = [](std::int64_t now, std::int64_t then) {
      return static_cast<double>(now) > 1.05 * static_cast<double>(then) + 1000.0;
    };
    expect(
        !grown(c.samples, recorded.samples) && !grown(c.segments, recorded.segments) && !grown(c.leaps, recorded.leaps),
        "counts grew by more than 5 %");
  }

  /// Sixteen rays in each pixel of a view, averaged: the picture four times as large, as it is without jitter. Frames of a first
  /// hit and of a maximum leave the samples along their rays where they are (moves_samples()).
  Image sixteen_rays(VolumeRenderer& r, const VolumeView& view) {
    constexpr int kSide = 4;
    VolumeView fine = view;
    fine.size = {kSide * view.size.width, kSide * view.size.height};
    const RayImage rays = drawn(r, fine, {}, work_);
    RayImage mean{view.size, std::vector<std::array<float, 4>>(view.size.count()), {}};
    const auto width = static_cast<std::size_t>(fine.size.width);
    for (std::size_t i = 0; i < rays.rgba.size(); ++i) {
      const std::size_t x = i % width / kSide;
      const std::size_t y = i / width / kSide;
      auto& to = mean.rgba[y * static_cast<std::size_t>(view.size.width) + x];
      for (std::size_t c = 0; c < 4; ++c) to[c] += rays.rgba[i][c] / (kSide * kSide);
    }
    return black(mean);
  }

  /// The mean of as many frames against sixteen rays a pixel, where edges are sharp.
  void at_rest(VolumeRenderer& r, const SceneFiles& scene) {
    for (const RayMode mode : {RayMode::first_hit, RayMode::maximum}) {
      VolumeView view = scene.view;
      view.mode = mode;
      Refinement refinement(r, {.most_frames = 16});
      refinement.restart(view);
      const auto mean = refinement.converged(work_);
      if (!mean) std::exit(EXIT_FAILURE);
      const Image frames = black(mean->image);
      const Image truth = sixteen_rays(r, view);
      const std::string what = fmt::format("{} at rest, {} frames against 16 rays a pixel, dB",
                                           mode == RayMode::maximum ? "maximum" : "first hit", mean->averaged);
      targets_.at_least(what, 45.0, psnr_db(frames, truth));
      targets_.at_least(what + " of the worst tile", 35.0, worst_tile_psnr_db(frames, truth));
      tell();
    }
  }

  void interaction(VolumeRenderer& r, const SceneFiles& scene) {
    const DrawQuality half{2, 1.0, 0.03, 0};
    (void)drawn(r, scene.view, half, work_);
    const Times drag = timed(frames_, [&] { (void)drawn(r, scene.view, half, work_); });
    VolumeView point = scene.view;
    point.size = {1, 1};
    const Times edit = timed(frames_, [&] {
      (void)r.set_transfer(scene.table);
      (void)drawn(r, point, {}, work_);
    });
    const Times ping = timed(frames_, [&] { (void)r.set_volume(scene.volume); });
    fmt::print(
        "  half resolution {:.1f} ms wall, {:.1f} ms cpu; table edit {:.1f} ms wall, {:.1f} ms cpu; new ping {:.1f} ms "
        "cpu\n",
        1e3 * drag.wall_s, 1e3 * drag.cpu_s, 1e3 * edit.wall_s, 1e3 * edit.cpu_s, 1e3 * ping.cpu_s);
    targets_.beside("half resolution, ms wall (at most)", 65.0, 1e3 * drag.wall_s);
    tell();
  }

  /// What Refinement shows first while the camera turns, as the desktop asks for it: a size chosen by the time that
  /// earlier frames took. Its PSNR is against the converged picture of the last place.
  void dragging(VolumeRenderer& r, const SceneFiles& scene, const Image& reference) {
    Refinement refinement(r);
    VolumeView view = scene.view;
    RayImage image;
    DrawQuality quality;
    const auto frame = [&](double turned_rad) {
      view.camera = orbited(scene.view.camera, turned_rad, 0.0);
      refinement.restart(view);
      auto next = refinement.next(work_);
      if (!next) std::exit(EXIT_FAILURE);
      image = std::move(next->image);
      quality = next->quality;
    };
    for (int i = 0; i < 4; ++i) frame(0.01 * i);  // learns the pace
    double turned_rad = 0.05;
    const Times t = timed(2 * frames_ + 1, [&] { frame(turned_rad -= 0.01); });
    frame(0.0);
    fmt::print("  while dragging: 1/{} of the resolution, {:.1f} ms wall, {:.1f} ms cpu, PSNR {:.1f} dB\n",
               quality.divisor, 1e3 * t.wall_s, 1e3 * t.cpu_s, psnr_db(black(image), reference));
    targets_.dragging(t.wall_s);
    tell();
  }

  /// Where the paper saw artefacts: rays that run along the beams, close to the transducer. Quality only.
  void along_the_beams(const Rivals& rivals) {
    auto scene = read_scene(folder_, "closeup", "haze");
    const auto r = make_cpu_renderer();
    if (!scene || !r->set_volume(scene->volume) || !r->set_transfer(scene->table)) std::exit(EXIT_FAILURE);
    const Sector& sector = scene->volume->sector;
    scene->view.camera.target = sector.centre(sector.fans() / 2, sector.beams() / 2, 200);
    scene->view.camera.eye = scene->view.camera.target * -0.3 + Point<Sonar>{0.0, 0.0, -6.0};
    fmt::print("\nalong the beams, from 23 m behind the transducer\n");
    const Image step = black(drawn(*r, scene->view, {}, work_));
    const Image exact = black(drawn(*r, scene->view, {1, 1.0, 0.0, 0}, work_));
    const double tile = worst_tile_psnr_db(step, exact);
    fmt::print("  ours against no thin cells: {:.1f} dB, worst 64 x 64 tile {:.1f} dB\n", psnr_db(step, exact), tile);
    expect(psnr_db(step, exact) >= 60.0 && tile >= 54.0, "less than 60 dB, or a tile below 54 dB, along the beams");
    const double halved = worst_tile_psnr_db(step, black(drawn(*r, scene->view, {1, 0.5, 0.0, 0}, work_)));
    fmt::print("  worst 64 x 64 tile between step and half step {:.1f} dB\n", halved);
    expect(halved >= 48.0, "a tile below 48 dB along the beams");
    const SceneName name{"along", "haze"};
    keep(step, folder_, name, "ours");
    const auto coarse = rivals.naive(*scene, 1.0, 1);
    const auto fine = rivals.naive(*scene, 0.5, 1);
    if (!coarse || !fine) return;
    fmt::print("  the paper's naive shader: {:.1f} dB\n", worst_tile_psnr_db(coarse->picture, fine->picture));
    keep(coarse->picture, folder_, name, "naive");
  }

  std::string folder_;
  int frames_;
  double reference_step_;
  Work work_{2};
  Targets targets_;
};

}  // namespace
}  // namespace sonar::bench

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: sonar_bench_render FOLDER [FRAMES [REFERENCE_STEP]]\n");
    return 2;
  }
  const int frames = argc > 2 ? std::max(1, std::atoi(argv[2])) : 5;
  const double step = argc > 3 ? std::atof(argv[3]) : 0.125;
  return sonar::bench::Bench(argv[1], frames, step).run() ? EXIT_SUCCESS : EXIT_FAILURE;
}
