// SPDX-License-Identifier: Apache-2.0
#include "publish/picture_output.h"

#include <string>

#include "io/atomic_file.h"
#include "io/recordings.h"
#include "render/draw_frame.h"

namespace sonar {

Result<Image> painted(const FrameDescription& frame, double scale) { return draw_frame(frame, scale); }

Result<void> write_picture(const FrameDescription& frame, const std::filesystem::path& file, double scale) {
  const auto bytes = picture_bytes(frame, file, scale);
  if (!bytes) return fail(bytes.error().code, bytes.error().text, {file.string()});
  return write_file(file, *bytes);
}

Result<void> write_pixels(const Image& image, const std::filesystem::path& file) {
  if (!has_ending(file, ".png")) return fail(ErrorCode::usage, "expected a name that ends in .png", {file.string()});
  const auto bytes = png_bytes(image);
  if (!bytes) return fail(bytes.error().code, bytes.error().text, {file.string()});
  return write_file(file, *bytes);
}

}  // namespace sonar
