// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <utility>
#include <vector>

#include "io/recordings.h"
#include "publish/movies/movie.h"
#include "publish/movies/movie_file.h"
#include "publish/picture_output.h"
#include "render/draw_frame.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

/// Of all that is worked on for a picture only the movie's own progress is told.
class TotalProgress {
 public:
  explicit TotalProgress(Work& work) : work_(work), outer_(work.exchange_progress({})) {}
  ~TotalProgress() { work_.set_progress(std::move(outer_)); }
  TotalProgress(const TotalProgress&) = delete;
  TotalProgress& operator=(const TotalProgress&) = delete;
  void tell(std::size_t done, std::size_t total) const {
    if (outer_) outer_("movie", static_cast<std::int64_t>(done), static_cast<std::int64_t>(total));
  }

 private:
  Work& work_;
  Work::ProgressSink outer_;
};

std::string origin_of(const PictureOrigin& origin) {
  return fmt::format("Made by {}; recipe {}; data {}", origin.program, origin.recipe_hash, origin.data_time);
}

/// The file that can be made here, and why it is another than the one asked for.
Result<WrittenMovie> possible_file(const fs::path& asked) {
  if (!is_movie_file(asked)) {
    return fail(ErrorCode::usage, "expected a name that ends in .mp4 or .png (an animated PNG)", {asked.string()});
  }
  if (!has_ending(asked, ".mp4") || mp4_can_be_made()) return WrittenMovie{asked, 0, {}};
  fs::path instead = asked;
  instead.replace_extension(".png");
  std::error_code absent;
  if (fs::exists(instead, absent)) {
    return fail(
        ErrorCode::not_found,
        fmt::format("there is no program ffmpeg, which makes MP4 files, and {} is there already; install ffmpeg or "
                    "name a file that ends in .png",
                    instead.filename().string()),
        {asked.string()});
  }
  return WrittenMovie{instead, 0,
                      "there is no program ffmpeg, which makes MP4 files: the movie is an animated PNG instead"};
}

/// "movie-0007.png" beside the movie.
fs::path picture_file(const fs::path& movie, std::size_t index) {
  return movie.parent_path() / fmt::format("{}-{:04}.png", movie.stem().string(), index);
}

/// Under other names until the movie is whole: one that is stopped leaves the pictures of an earlier one as they were.
class SinglePictures {
 public:
  explicit SinglePictures(const fs::path& movie) : movie_(movie) {}
  ~SinglePictures() {
    std::error_code gone;
    for (const fs::path& file : written_) fs::remove(file, gone);
  }
  SinglePictures(const SinglePictures&) = delete;
  SinglePictures& operator=(const SinglePictures&) = delete;
  Result<void> write(const FrameDescription& frame, std::size_t index, double scale) {
    fs::path file = picture_file(movie_, index);
    file.replace_filename("." + file.filename().string());
    if (auto written = write_picture(frame, file, scale); !written) return written;
    written_.push_back(std::move(file));
    return {};
  }
  Result<void> keep() {
    for (std::size_t i = 0; i < written_.size(); ++i) {
      std::error_code error;
      const fs::path file = picture_file(movie_, i);
      fs::rename(written_[i], file, error);
      if (error) return fail(ErrorCode::io, error.message(), {file.string()});
    }
    written_.clear();
    return {};
  }

 private:
  fs::path movie_;
  std::vector<fs::path> written_;
};

Result<std::unique_ptr<MovieFile>> movie_file(const fs::path& file, MovieFormat format, Work& work) {
  if (has_ending(file, ".png")) return animated_png(file, std::move(format));
  return mp4(file, std::move(format), [&work] { return work.cancelled(); });
}

}  // namespace

bool is_movie_file(const fs::path& file) { return has_ending(file, ".mp4") || has_ending(file, ".png"); }

fs::path default_movie(const fs::path& without_ending) {
  return without_ending.string() + (mp4_can_be_made() ? ".mp4" : ".png");
}

Result<WrittenMovie> write_movie(PictureSource& source, const std::string& observation, const PictureOptions& options,
                                 const fs::path& file, Work& work) {
  auto written = possible_file(file);
  if (!written) return written;
  if (auto outside = source.require_outside_raw(written->file); !outside) return pass_on(outside);
  const auto movie = Movie::of(source, observation, options, work);
  if (!movie) return pass_on(movie);
  const TotalProgress progress(work);
  const std::size_t pictures = movie->steps().size();
  SinglePictures single(written->file);
  std::unique_ptr<MovieFile> to;
  for (; written->pictures < pictures; ++written->pictures) {
    progress.tell(written->pictures, pictures);
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    const auto frame = movie->picture(written->pictures, work);
    if (!frame) return pass_on(frame);
    const auto image = draw_frame(*frame, options.scale);
    if (!image) return pass_on(image);
    if (!to) {
      MovieFormat format{image->size, pictures, options.kind.movie.pictures_per_second, frame->title,
                         origin_of(frame->origin)};
      auto made = movie_file(written->file, std::move(format), work);
      if (!made) return pass_on(made);
      to = std::move(*made);
    }
    if (auto added = to->add(*image); !added) return pass_on(added);
    if (!options.kind.movie.each_picture) continue;
    if (auto one = single.write(*frame, written->pictures, options.scale); !one) return pass_on(one);
  }
  progress.tell(pictures, pictures);
  if (auto finished = to->finish(); !finished) return pass_on(finished);
  if (auto kept = single.keep(); !kept) return pass_on(kept);
  return written;
}

}  // namespace sonar
