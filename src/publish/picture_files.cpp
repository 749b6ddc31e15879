// SPDX-License-Identifier: Apache-2.0
#include "publish/picture_files.h"

#include <algorithm>
#include <cctype>
#include <string>

#include "render/draw_frame.h"

namespace sonar {

Result<void> write_picture(const FrameDescription& frame, const std::filesystem::path& file, double scale) {
  return write_frame(frame, file, scale);
}

Result<void> write_pixels(const Image& image, const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending != ".png") return fail(ErrorCode::usage, "expected a name that ends in .png", {file.string()});
  return write_png(image, file);
}

}  // namespace sonar
