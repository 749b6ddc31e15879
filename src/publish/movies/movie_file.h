// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "view/image.h"

namespace sonar {

/// What is known of a movie before its first picture.
struct MovieFormat {
  PixelSize size;  ///< of every picture
  std::size_t pictures = 0;
  double pictures_per_second = 5.0;
  std::string title;
  std::string origin;  ///< program, recipe and time of the data in a sentence
};

/// A movie that takes one picture after another, so that memory does not grow with it. It appears under its name when
/// finish() was called; whoever stops before leaves nothing behind.
class MovieFile {
 public:
  virtual ~MovieFile() = default;
  /// errors  mismatch: another size than the format's, or one picture more; io; no_space; cancelled
  [[nodiscard]] virtual Result<void> add(const Image& picture) = 0;
  /// errors  mismatch: pictures are missing; io; no_space; cancelled
  [[nodiscard]] virtual Result<void> finish() = 0;
};

/// An animated PNG (APNG 1.0), which browsers and picture viewers play in a loop.
/// file    ends in .png
/// errors  usage: no pictures, another ending; as AtomicFile
[[nodiscard]] Result<std::unique_ptr<MovieFile>> animated_png(const std::filesystem::path& file, MovieFormat format);

/// An MP4 with H.264, by the program ffmpeg. Sides that are odd are widened by a pixel.
/// stop    whether to stop: asked while ffmpeg is waited for
/// errors  usage: no pictures, another ending; not_found: no ffmpeg in PATH; io: what ffmpeg complains about; as AtomicFile
[[nodiscard]] Result<std::unique_ptr<MovieFile>> mp4(const std::filesystem::path& file, MovieFormat format,
                                                     std::function<bool()> stop);
/// Whether mp4() finds the program it needs.
[[nodiscard]] bool mp4_can_be_made();

}  // namespace sonar
