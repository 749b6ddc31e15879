// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "view/image.h"

namespace sonar {

inline constexpr PixelSize kThumbnail{192, 120};

/// The middle of a picture in so many pixels, each the mean of those that it stands for.
[[nodiscard]] Image reduced(const Image& image, PixelSize size);

/// Where a small picture of a survey, or of something in it, is kept: a PNG.
/// cache   the user's; empty = there is none
/// survey  as it was named
/// of      what in it
/// returns empty without a cache
[[nodiscard]] std::filesystem::path thumbnail_file(const std::filesystem::path& cache,
                                                   const std::vector<std::filesystem::path>& survey,
                                                   std::string_view of = {});

}  // namespace sonar
