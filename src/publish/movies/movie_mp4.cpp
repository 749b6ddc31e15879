// SPDX-License-Identifier: Apache-2.0
// MP4 by ffmpeg, a program of its own: pictures go to it as plain pixels, and it writes the file.
#include <fmt/format.h>

#include "io/atomic_file.h"
#include "io/fed_command.h"
#include "io/recordings.h"
#include "publish/movies/movie_file.h"

namespace sonar {
namespace {

int even(int side) { return side + side % 2; }

/// Red, green, blue of every pixel; what was added to make the sides even has the colour of its neighbour.
std::string pixels_of(const Image& picture) {
  const PixelSize size{even(picture.size.width), even(picture.size.height)};
  std::string out;
  out.reserve(3 * size.count());
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const Rgba8 c = picture.at(std::min(x, picture.size.width - 1), std::min(y, picture.size.height - 1));
      out += {static_cast<char>(c.r), static_cast<char>(c.g), static_cast<char>(c.b)};
    }
  }
  return out;
}

/// H.264 that every player knows, its colours told apart from those of old television, its index in front, and nothing in
/// it but the movie: the same pictures are the same file. "file:" keeps a name with a colon from being a protocol's.
std::vector<std::string> words_for(const std::string& program, const MovieFormat& format,
                                   const std::filesystem::path& to) {
  const std::string rate = fmt::format("{:.6g}", format.pictures_per_second);
  const std::string size = fmt::format("{}x{}", even(format.size.width), even(format.size.height));
  return {program, "-hide_banner", "-loglevel", "error", "-nostdin", "-y",
          // what comes
          "-f", "rawvideo", "-pixel_format", "rgb24", "-video_size", size, "-framerate", rate, "-i", "pipe:0",
          // what is made of it
          "-an", "-vf", "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p", "-colorspace", "bt709",
          "-color_primaries", "bt709", "-color_trc", "bt709", "-color_range", "tv", "-c:v", "libx264", "-preset",
          "medium", "-crf", "16", "-threads", "4", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-movflags",
          "+faststart", "-metadata", "title=" + format.title, "-metadata", "comment=" + format.origin, "-f", "mp4",
          "file:" + to.string()};
}

class Mp4 : public MovieFile {
 public:
  Mp4(AtomicFile file, FedCommand ffmpeg, MovieFormat format, std::function<bool()> stop)
      : file_(std::move(file)), ffmpeg_(std::move(ffmpeg)), format_(std::move(format)), stop_(std::move(stop)) {}

  Result<void> add(const Image& picture) override {
    if (picture.size != format_.size || added_ == format_.pictures) {
      return fail(ErrorCode::mismatch, "another size than the pictures before, or one picture more",
                  {file_.target().string()});
    }
    ++added_;
    return told(ffmpeg_.feed(pixels_of(picture), stop_));
  }

  Result<void> finish() override {
    if (added_ != format_.pictures) {
      return fail(ErrorCode::mismatch, "pictures of the movie are missing", {file_.target().string()});
    }
    if (auto ended = told(ffmpeg_.end(stop_)); !ended) return ended;
    return file_.commit();
  }

 private:
  [[nodiscard]] Result<void> told(Result<void> done) const {
    if (!done && done.error().code != ErrorCode::cancelled) done.error().where.file = file_.target().string();
    return done;
  }

  AtomicFile file_;  // removed after ffmpeg is gone
  FedCommand ffmpeg_;
  MovieFormat format_;
  std::function<bool()> stop_;
  std::size_t added_ = 0;
};

}  // namespace

bool mp4_can_be_made() { return program_in_path("ffmpeg").has_value(); }

Result<std::unique_ptr<MovieFile>> mp4(const std::filesystem::path& file, MovieFormat format,
                                       std::function<bool()> stop) {
  if (format.pictures == 0) return fail(ErrorCode::usage, "a movie needs pictures", {file.string()});
  if (!has_ending(file, ".mp4")) return fail(ErrorCode::usage, "expected a name that ends in .mp4", {file.string()});
  const auto program = program_in_path("ffmpeg");
  if (!program) return fail(ErrorCode::not_found, "there is no program ffmpeg, which makes MP4 files", {file.string()});
  auto made = AtomicFile::create(file);
  if (!made) return pass_on(made);
  auto ffmpeg = FedCommand::start(words_for(program->string(), format, made->temporary()));
  if (!ffmpeg) return pass_on(ffmpeg);
  return std::unique_ptr<MovieFile>(
      std::make_unique<Mp4>(std::move(*made), std::move(*ffmpeg), std::move(format), std::move(stop)));
}

}  // namespace sonar
