// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "base/work.h"
#include "measured.h"
#include "render/gl/capabilities.h"
#include "scene_files.h"
#include "targets.h"

namespace sonar::bench {

/// A picture with what it took.
struct TimedPicture {
  Times times;
  Image picture;
};

/// What our frame by the processor stands beside: the paper's naive shader and our OpenGL back-end where OpenGL can be had,
/// and VTK's GPU mapper where vtk_volume.py has left vtk.csv in the folder of the scenes.
class Rivals {
 public:
  /// driver  empty = no OpenGL
  Rivals(std::string folder, int frames, std::optional<GlCapabilities> driver, Targets& targets, Work& work)
      : folder_(std::move(folder)), frames_(frames), driver_(std::move(driver)), targets_(targets), work_(work) {}

  /// reference  the converged picture that PSNR is against
  void beside(const SceneFiles& scene, const SceneName& name, const Times& ours, double ours_db,
              const Image& reference);
  /// The paper's naive shader; empty where it does not run.
  [[nodiscard]] std::optional<TimedPicture> naive(const SceneFiles& scene, double step_samples, int frames) const;

 private:
  /// Only on a software driver are the naive shader's processor seconds its cost.
  [[nodiscard]] bool on_software() const { return driver_ && draws_by_software(driver_->driver); }
  void beside_naive(const SceneFiles& scene, const SceneName& name, const Times& ours, double ours_db,
                    const Image& reference);
  void beside_own_gl(const SceneFiles& scene, const SceneName& name, const Times& naive_times, double naive_db,
                     const Image& reference);
  void beside_vtk(const SceneName& name, const Times& ours, double ours_db, const Image& reference);

  std::string folder_;
  int frames_;
  std::optional<GlCapabilities> driver_;
  Targets& targets_;
  Work& work_;
};

}  // namespace sonar::bench
