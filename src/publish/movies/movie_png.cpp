// SPDX-License-Identifier: Apache-2.0
// Animated PNG (APNG 1.0): the chunks of single pictures, each behind a chunk that says when it is shown.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "io/atomic_file.h"
#include "io/recordings.h"
#include "publish/movies/movie_file.h"
#include "render/draw_frame.h"
#include "render/png_chunks.h"

namespace sonar {
namespace {

/// fcTL: the whole picture, shown so long, over what was there.
std::string frame_control(std::uint32_t sequence, std::string_view header, double picture_s) {
  constexpr std::uint32_t kPerSecond = 1000;
  const auto delay = static_cast<std::uint32_t>(std::clamp(std::lround(picture_s * kPerSecond), 1L, 65535L));
  return png_number(sequence) + std::string(header.substr(0, 8)) + png_number(0) + png_number(0) +
         png_number(delay, 2) + png_number(kPerSecond, 2) + std::string(2, '\0');
}

/// A text chunk, not compressed, of no language.
void add_text(std::string& to, const std::string& keyword, const std::string& text) {
  if (!text.empty()) add_png_chunk(to, "iTXt", keyword + std::string(5, '\0') + text);
}

class AnimatedPng : public MovieFile {
 public:
  AnimatedPng(AtomicFile file, MovieFormat format) : file_(std::move(file)), format_(std::move(format)) {}

  Result<void> add(const Image& picture) override {
    if (picture.size != format_.size || added_ == format_.pictures) {
      return fail(ErrorCode::mismatch, "another size than the pictures before, or one picture more",
                  {file_.target().string()});
    }
    const auto png = png_bytes(picture);
    if (!png) return pass_on(png);
    const auto chunks = png_chunks(*png, file_.target().string());
    if (!chunks) return pass_on(chunks);
    const std::string_view header = chunks->front().data;
    std::string out;
    if (added_ == 0) {
      header_ = std::string(header);
      begin(out);
    } else if (header != header_) {
      return fail(ErrorCode::mismatch, "other pixels than the pictures before", {file_.target().string()});
    }
    add_png_chunk(out, "fcTL", frame_control(sequence_++, header, 1.0 / format_.pictures_per_second));
    for (const PngChunk& chunk : *chunks) {
      if (chunk.type != "IDAT") continue;
      // The first picture is a plain one, for programs that know nothing of movies.
      added_ == 0 ? add_png_chunk(out, "IDAT", chunk.data)
                  : add_png_chunk(out, "fdAT", png_number(sequence_++) + std::string(chunk.data));
    }
    ++added_;
    return file_.write(out);
  }

  Result<void> finish() override {
    if (added_ != format_.pictures) {
      return fail(ErrorCode::mismatch, "pictures of the movie are missing", {file_.target().string()});
    }
    std::string out;
    add_png_chunk(out, "IEND", {});
    if (auto written = file_.write(out); !written) return written;
    return file_.commit();
  }

 private:
  void begin(std::string& out) const {
    out = std::string(kPngSignature);
    add_png_chunk(out, "IHDR", header_);
    add_png_chunk(out, "acTL", png_number(static_cast<std::uint32_t>(format_.pictures)) + png_number(0));
    add_text(out, "Title", format_.title);
    add_text(out, "Description", format_.origin);
  }

  AtomicFile file_;
  MovieFormat format_;
  std::string header_;
  std::size_t added_ = 0;
  std::uint32_t sequence_ = 0;
};

}  // namespace

Result<std::unique_ptr<MovieFile>> animated_png(const std::filesystem::path& file, MovieFormat format) {
  if (format.pictures == 0) return fail(ErrorCode::usage, "a movie needs pictures", {file.string()});
  if (!has_ending(file, ".png")) return fail(ErrorCode::usage, "expected a name that ends in .png", {file.string()});
  auto made = AtomicFile::create(file);
  if (!made) return pass_on(made);
  return std::unique_ptr<MovieFile>(std::make_unique<AnimatedPng>(std::move(*made), std::move(format)));
}

}  // namespace sonar
