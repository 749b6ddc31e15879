// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/task_thread.h"
#include "base/work.h"
#include "session/change_queue.h"
#include "session/listeners.h"
#include "session/listening.h"
#include "session/looks/picture_look.h"
#include "view/frame_description.h"
#include "view/image.h"
#include "view/pointer_event.h"

namespace sonar {

template <class T>
class Shared;
struct Workspace;

/// Something light that a widget lays over a picture at once: the linked cursor, a rubber band, a brush.
struct Overlay {
  std::vector<PixelPoint> line;         ///< a polyline, or empty
  std::optional<PixelPoint> cross;      ///< a cross-hair
  std::optional<PixelPoint> circle_at;  ///< a ring round a place
  double circle_px = 0.0;
  bool muted = false;               ///< thin and pale: it tells where something lies, and hides nothing
  bool dashed = false;              ///< the line
  std::optional<PixelRect> clip{};  ///< what it must not leave
  std::string text{};               ///< lines to stand beside a rectangle, light on dark; or empty
  PixelRect beside{};
};

/// What the pointer looks like over a picture.
enum class PointerShape : std::uint8_t { arrow, cross };

/// A picture of the document that stays right while the document changes: its model half. Pictures are built and drawn
/// behind the window, the latest wish wins, and the last picture stays until the next one is ready. A picture that is
/// switched off or not seen costs nothing.
/// threads  the window's, but for what build() returns
class LivePicture {
 public:
  /// The workspace outlives the picture.
  explicit LivePicture(Workspace& workspace);
  virtual ~LivePicture();
  LivePicture(const LivePicture&) = delete;
  LivePicture& operator=(const LivePicture&) = delete;

  /// Size on the screen in the window's units; scale = pixels of the screen a unit: 2 where it is dense.
  void resize(PixelSize units, double scale);
  [[nodiscard]] PixelSize units() const { return units_; }
  [[nodiscard]] double scale() const { return scale_; }
  /// In pixels of the screen. Whatever is drawn is drawn for them, and pointers, overlays and hints speak of them, so that
  /// nothing is enlarged; what has a size for eyes and hands (text, lines, how far a pointer reaches) is times scale().
  [[nodiscard]] PixelSize size() const { return size_; }
  /// Off or hidden: nothing is built. Shown again: built anew where something changed meanwhile.
  void set_seen(bool seen);
  [[nodiscard]] bool seen() const { return seen_; }

  /// The picture as it was last drawn, of size(); empty before the first.
  [[nodiscard]] const Image& image() const { return image_; }
  /// Why there is no picture; empty where there is one.
  [[nodiscard]] const std::string& problem() const { return problem_; }
  /// Time from the wish to the last picture, ms, for the developer's overlay.
  [[nodiscard]] double latency_ms() const { return latency_ms_; }
  /// What the developer's overlay says: "12.3 ms".
  [[nodiscard]] virtual std::string timing() const;
  /// Rises with every picture that is put on show.
  [[nodiscard]] std::int64_t pictures() const { return pictures_; }
  /// Called when image() or overlays() have changed.
  [[nodiscard]] Listeners<>& changed() { return changed_; }

  /// What this picture would show now, drawn elsewhere: each one that is shown is better than the one before.
  /// threads  any one
  using ShowPanel = std::function<void(FrameDescription frame, double scale)>;
  using Panel = std::function<Result<void>(const CancelToken& token, const ShowPanel& show)>;
  /// The picture as a panel of a page, with what the view shows now: zoomed, turned and chosen as there. Empty = there is
  /// nothing to show.
  [[nodiscard]] Panel panel(const PictureLook& look);
  /// A page shows the picture, whether its view is seen or not: what it needs is read.
  void set_on_page(bool on);
  [[nodiscard]] bool on_page() const { return on_page_; }
  /// Rises whenever the picture would show something else, whether anybody sees it or not.
  [[nodiscard]] std::int64_t version() const { return version_; }
  [[nodiscard]] Listeners<>& outdated() { return outdated_; }
  /// What is still being read for it, "the timeline is still being read"; empty = it has all.
  [[nodiscard]] virtual std::string incomplete() const { return {}; }
  /// Whether better pictures follow the first.
  [[nodiscard]] virtual bool refines() const { return false; }

  virtual void pointer(const PointerEvent& /*event*/) {}
  /// Ends a drag that has done nothing yet; it will not, wherever the button is let go.
  /// out  false = there is none
  virtual bool cancel_drag() { return false; }
  /// Whether two fingers on a touch pad move what is shown now; where they do not, they turn the wheel.
  [[nodiscard]] virtual bool pans() const { return false; }
  /// A menu opens at a place: what lies there becomes what its acts are about.
  /// out  false where acts on the selected school are not meant: it lies elsewhere
  virtual bool aim(PixelPoint /*at*/) { return true; }
  [[nodiscard]] virtual std::vector<Overlay> overlays() const { return {}; }
  [[nodiscard]] virtual PointerShape pointer_shape() const { return PointerShape::arrow; }
  /// What a tooltip says at a place; empty = nothing.
  [[nodiscard]] virtual std::string hint(PixelPoint /*at*/) const { return {}; }

  /// Returns when the picture of the last wish is on its way through the queue; for tests.
  virtual void wait() { background_.wait(); }

 protected:
  /// What a build brings back: a description to draw, or (for volumes) pixels that are drawn already, and something for
  /// pointers. More may come: a build may show() several pictures, each better than the one before.
  struct Built {
    FrameDescription frame;
    std::optional<Image> image;          ///< instead of drawing the frame
    std::shared_ptr<const void> detail;  ///< handed to take()
    double scale = 1.0;                  ///< pixels a unit of the frame
  };
  using Show = std::function<void(Built)>;
  /// Runs behind the window on copies of everything it needs. The token is cancelled once a later wish came: a build goes on to
  /// its first picture all the same, so that something is seen while wishes come faster than pictures, and ends then.
  using Build = std::function<Result<void>(PixelSize size, const CancelToken& token, const Show& show)>;

  /// What is to be built now; empty = there is nothing to show. Called in the window's thread.
  /// look  of the view, or of a panel of a page; a panel's is built while the view's own may be
  [[nodiscard]] virtual Build build(const PictureLook& look) = 0;
  /// A picture is put on show.
  virtual void take(const std::shared_ptr<const void>& /*detail*/) {}

  /// No page shows the picture any more: what is drawn for one may end.
  virtual void left_page() {}

  /// The picture is not seen any more: what only pictures need may be let go.
  virtual void hidden() {}

  /// Something changed that the picture shows.
  void update();
  /// Carried out where pictures are built, after the one under way, unless a later wish comes before it.
  void behind(std::function<void()> job);
  /// For the end: nothing more is built, and `last` has been carried out where pictures were built.
  void end_behind(const std::function<void()>& last);
  [[nodiscard]] ChangeQueue& queue() { return queue_; }

 private:
  void put(const Built& built, Image image, double asked_s);
  void fail_with(std::string line);

  ChangeQueue& queue_;
  const Shared<bool>& dark_;         ///< the window's
  const Shared<Units>& units_read_;  ///< that numbers are read in
  PixelSize units_;
  double scale_ = 1.0;
  PixelSize size_;
  bool seen_ = false;
  bool stale_ = true;
  Image image_;
  std::string problem_;
  double latency_ms_ = 0.0;
  std::int64_t pictures_ = 0;
  std::int64_t version_ = 0;
  bool on_page_ = false;
  Listeners<> changed_;
  Listeners<> outdated_;
  std::shared_ptr<bool> alive_ =
      std::make_shared<bool>(true);  ///< of pictures on their way: once it is another, they are dropped
  std::optional<CancelToken> wish_;
  Listening units_heard_;
  TaskThread background_;  // the last member: it ends first
};

}  // namespace sonar
