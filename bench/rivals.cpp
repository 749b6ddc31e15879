// SPDX-License-Identifier: Apache-2.0
#include "rivals.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "naive_shader.h"
#include "render/gl/gl_renderer.h"
#include "render/reference/brute_force.h"

namespace sonar::bench {

void Rivals::beside(const SceneFiles& scene, const SceneName& name, const Times& ours, double ours_db,
                    const Image& reference) {
  if (driver_) beside_naive(scene, name, ours, ours_db, reference);
  beside_vtk(name, ours, ours_db, reference);
  tell(targets_);
}

std::optional<TimedPicture> Rivals::naive(const SceneFiles& scene, double step_samples, int frames) const {
  if (!driver_) return std::nullopt;
  NaiveFrame frame;
  const double step_m = step_samples * scene.volume->sector.range().spacing_m;
  const double wall_s = naive_frame(*scene.volume, scene.table, scene.view, step_m, frames, frame);
  if (!(wall_s > 0.0)) return std::nullopt;
  return TimedPicture{{wall_s, frame.cpu_s}, black(frame.picture)};
}

void Rivals::beside_naive(const SceneFiles& scene, const SceneName& name, const Times& ours, double ours_db,
                          const Image& reference) {
  const auto same_step = naive(scene, 1.0, std::min(frames_, 3));
  if (!same_step) {
    targets_.skip(name.text() + ", the paper's naive shader", "it does not run on this driver");
    return;
  }
  const double naive_db = psnr_db(same_step->picture, reference);
  report("the paper's naive shader", same_step->times, naive_db);
  const double ratio = same_step->times.cpu_s / ours.cpu_s;
  fmt::print("    ours is {:.1f} times as fast (cpu)\n", ratio);
  if (on_software()) {
    targets_.cpu_beside_naive(name.dense(), ratio, ours_db, naive_db);
  } else {
    targets_.skip(name.text() + ", our processor time beside the naive shader's",
                  "the driver is no software one: " + driver_->driver);
  }
  tell(targets_);
  // As many samples as it has time for in one of our frames: what a user would see who waits as long.
  if (const auto same_time = naive(scene, std::max(1.0, ratio), 1)) {
    report(fmt::format("the same in our time (step x {:.1f})", ratio), same_time->times,
           psnr_db(same_time->picture, reference));
    keep(same_time->picture, folder_, name, "naive_in_our_time");
  }
  beside_own_gl(scene, name, same_step->times, naive_db, reference);
}

void Rivals::beside_own_gl(const SceneFiles& scene, const SceneName& name, const Times& naive_times, double naive_db,
                           const Image& reference) {
  auto made = make_gl_renderer();
  if (!made || !(*made)->set_volume(scene.volume) || !(*made)->set_transfer(scene.table)) {
    targets_.skip(name.text() + ", our OpenGL back-end", "it does not run on this driver");
    return;
  }
  const Image first = black(drawn(**made, scene.view, {}, work_));
  const Times t = timed(std::min(frames_, 3), [&] { (void)drawn(**made, scene.view, {}, work_); });
  const double db = psnr_db(first, reference);
  report("our OpenGL back-end", t, db);
  // A graphics processor's work takes none of ours: there the clock on the wall tells.
  const double ratio = on_software() ? naive_times.cpu_s / t.cpu_s : naive_times.wall_s / t.wall_s;
  fmt::print("    it is {:.1f} times as fast as the naive shader ({})\n", ratio, on_software() ? "cpu" : "wall");
  targets_.gl_beside_naive(name.dense(), ratio, db, naive_db);
  tell(targets_);
}

void Rivals::beside_vtk(const SceneName& name, const Times& ours, double ours_db, const Image& reference) {
  bool found = false;
  std::ifstream csv(folder_ + "/vtk.csv");
  for (std::string line; std::getline(csv, line);) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    std::string view;
    std::string table;
    int size = 0;
    Times t;
    if (!(fields >> view >> table >> size >> t.wall_s >> t.cpu_s) || view != name.view || table != name.table) continue;
    const auto picture = read_rgb(fmt::format("{}/vtk_{}_{}_{}.rgb", folder_, view, table, size), reference.size);
    found = true;
    if (!picture) {
      targets_.skip(fmt::format("{}, VTK on {}^3 voxels", name.text(), size), "its picture cannot be read");
      continue;
    }
    const double db = psnr_db(*picture, reference);
    report(fmt::format("VTK's GPU mapper, {}^3 voxels", size), t, db);
    fmt::print("    ours is {:.1f} times as fast (cpu)\n", t.cpu_s / ours.cpu_s);
    targets_.cpu_beside_vtk(name.dense(), t.cpu_s / ours.cpu_s, ours_db, db);
    tell(targets_);
  }
  if (!found) targets_.skip(name.text() + ", VTK's GPU mapper", "no line in vtk.csv; vtk_volume.py writes it");
}

}  // namespace sonar::bench
