// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace sonar::bench {

/// The renderer's targets, each against what one run has measured. Ratios within a run are guarded, since other work on
/// the machine slows both sides; of times only that of a frame whose size is chosen by its time; others are set beside
/// their target. What could not be compared is kept with its reason, so that a run that passed says how much it looked at.
class Targets {
 public:
  /// Fails unless measured >= least; NaN fails. Says what was measured, and whether the target is met or MISSED.
  void at_least(const std::string& what, double least, double measured);
  /// Fails unless measured <= most; NaN fails. Says so likewise.
  void at_most(const std::string& what, double most, double measured);
  /// Never fails.
  void beside(const std::string& what, double target, double measured);
  void require(bool holds, const std::string& what);
  void skip(const std::string& what, const std::string& why);

  /// The processor's back-end against the naive shader: 12 times as fast where the water is mostly clear, with the better
  /// picture, else 8 times at 54 dB.
  void cpu_beside_naive(bool dense, double times_as_fast, double psnr_db, double naive_psnr_db);
  /// Against VTK's mapper: the better picture, and 25 times as fast where the water is mostly clear.
  void cpu_beside_vtk(bool dense, double times_as_fast, double psnr_db, double vtk_psnr_db);
  /// The OpenGL back-end: four times as fast as the naive shader in clear water, with the better picture; elsewhere never
  /// slower, at 54 dB.
  void gl_beside_naive(bool dense, double times_as_fast, double psnr_db, double naive_psnr_db);
  /// A frame while something moves, by the clock on the wall: 65 ms.
  void dragging(double wall_s);

  /// Lines since the last call.
  [[nodiscard]] std::vector<std::string> news();
  [[nodiscard]] bool hold() const { return failed_ == 0; }
  /// The last word: how many targets were guarded, which failed, and each comparison that was not made.
  [[nodiscard]] std::vector<std::string> verdict() const;

 private:
  void compare(bool met, const std::string& line);
  void better(const std::string& whose, double psnr_db, const std::string& rival, double rival_psnr_db);

  int guarded_ = 0;
  int failed_ = 0;
  std::vector<std::string> news_;
  std::vector<std::string> skipped_;
};

}  // namespace sonar::bench
