// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "publish/movies/movie_plan.h"
#include "publish/movies/track_camera.h"
#include "publish/picture_options.h"
#include "publish/picture_source.h"
#include "view/frame_description.h"

namespace sonar {

/// A movie of one observation, made ready: its pictures can be drawn in any order, each by itself.
class Movie {
 public:
  /// source       outlives the movie
  /// observation  empty = the first
  /// options      options.kind.movie says what moves; the ping of its own is a turntable's
  /// errors       as validate_movie(), with_ping_to_see(), movie_pings() and TrackCamera::along()
  [[nodiscard]] static Result<Movie> of(PictureSource& source, const std::string& observation,
                                        const PictureOptions& options, Work& work);

  [[nodiscard]] const std::vector<MovieStep>& steps() const { return steps_; }
  /// With a line below it: which ping, how fast the movie runs, and whether the picture is interpolated.
  /// errors  as picture_frame()
  [[nodiscard]] Result<FrameDescription> picture(std::size_t index, Work& work) const;

 private:
  Movie(PictureSource& source, DrawnObservation& observation, PictureOptions options)
      : source_(&source), observation_(&observation), options_(std::move(options)) {}
  [[nodiscard]] Result<void> prepare_camera();
  [[nodiscard]] Result<std::int64_t> eye_ping() const;
  [[nodiscard]] PictureOptions options_of(const MovieStep& step) const;
  [[nodiscard]] double caption_px() const;
  void add_caption(FrameDescription& page, std::size_t index) const;
  [[nodiscard]] std::string pace() const;

  PictureSource* source_;
  DrawnObservation* observation_;
  PictureOptions options_;
  MoviePings pings_;
  std::vector<MovieStep> steps_;
  std::optional<TrackCamera> track_;
};

/// What became of a movie.
struct WrittenMovie {
  std::filesystem::path file;
  std::size_t pictures = 0;
  std::string note;  ///< where the file is another than the one that was asked for: why; else empty
};

/// Draws a movie into a file: .mp4 through ffmpeg, .png as an animated PNG. Without ffmpeg an animated PNG of that name is
/// written instead, unless there is one. Progress is the movie's alone: pictures done of all.
/// errors  usage: another ending, a file among the raw files; as Movie and MovieFile; cancelled, and then no file is there
[[nodiscard]] Result<WrittenMovie> write_movie(PictureSource& source, const std::string& observation,
                                               const PictureOptions& options, const std::filesystem::path& file,
                                               Work& work);

/// Whether the ending is one that write_movie() knows, in any case of letters.
[[nodiscard]] bool is_movie_file(const std::filesystem::path& file);
/// The movie's name under an ending that can be made here: .mp4, or .png without ffmpeg.
[[nodiscard]] std::filesystem::path default_movie(const std::filesystem::path& without_ending);

}  // namespace sonar
