// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QMenu>
#include <QNativeGestureEvent>
#include <QPainter>
#include <QWidget>
#include <functional>
#include <utility>

#include "session/listening.h"
#include "session/live/live_picture.h"
#include "session/open/workspace.h"

namespace sonar {

/// Shows a live picture, lays its overlays on top, and hands pointers on.
class PictureView : public QWidget {
 public:
  /// Picture and switch outlive the view.
  /// latencies  whether the time of the last picture is written over it
  PictureView(LivePicture& picture, Shared<bool>& latencies, QWidget* parent = nullptr);
  ~PictureView() override;
  PictureView(const PictureView&) = delete;
  PictureView& operator=(const PictureView&) = delete;
  [[nodiscard]] LivePicture& picture() { return picture_; }
  /// What stands there while there is no picture and nothing wrong.
  void set_idle_text(std::function<QString()> text) { idle_text_ = std::move(text); }
  /// What a screen reader says of the picture, asked for each time.
  void set_sentence(std::function<QString()> sentence) { sentence_ = std::move(sentence); }
  [[nodiscard]] QString sentence() const { return sentence_ ? sentence_() : QString(); }
  /// What a right click opens; it outlives the view.
  void set_menu(QMenu* menu);
  /// Whether its dock is in front of others that share its place.
  void set_uncovered(bool uncovered);
  [[nodiscard]] QSize sizeHint() const override { return {480, 360}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {160, 120}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  bool event(QEvent* event) override;

 private:
  void show_size();
  void show_shape();
  void draw_overlays(QPainter& painter);
  void pinch(const QNativeGestureEvent& event);
  void draw_focus(QPainter& painter);
  void tell_screen_reader();
  /// A place of the view in the picture's pixels.
  [[nodiscard]] PixelPoint pixel_at(QPointF at) const;
  void forward(QMouseEvent* event, PointerAction action);

  LivePicture& picture_;
  Shared<bool>& latencies_;
  std::function<QString()> idle_text_;
  std::function<QString()> sentence_;
  std::int64_t told_ = 0;  ///< the picture that a screen reader knows of
  QMenu* menu_ = nullptr;
  bool menu_open_ = false;
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
