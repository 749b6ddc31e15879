// SPDX-License-Identifier: Apache-2.0
#include "window_at_work.h"

#include <QScreen>
#include <QTimer>
#include <QToolButton>
#include <QWheelEvent>
#include <algorithm>
#include <set>

#include "pipeline/stages/observe.h"

namespace sonar {
namespace {

constexpr QSize kSize{1600, 1000};

}  // namespace

void WindowAtWork::open() {
  pump_ = std::make_unique<QueuePump>([this] { gate_.pass(); });
  DocumentOptions options = TestSurvey::options(journal_);
  options.recipe = recipe_;
  options.cache.folder = cache_;
  app_ = std::make_unique<AppModel>(pump_->queue(), std::move(options));
  app_->preferences = preferences_;
  // A volume at rest is the mean of many pictures; one is enough for whoever does not look at it.
  VolumeParams quick;
  quick.frames = 1;
  workspace().volume.assign(quick);
  // The same room on every screen that has it.
  window_ = std::make_unique<MainWindow>(*app_, kSize.boundedTo(QApplication::primaryScreen()->availableSize()));
  window_->show();
  window_->activateWindow();  // keys go to the window that is active
  ASSERT_TRUE(QTest::qWaitForWindowActive(window_.get()));
  if (!survey_.empty()) document().open({survey_});
  settle();
}

void WindowAtWork::close() {
  gate_.open();
  window_.reset();
  app_.reset();
  pump_.reset();
}

void WindowAtWork::keep_picture(const std::string& name) {
  const QString folder = qEnvironmentVariable("SONAR_GUI_PICTURES");
  if (folder.isEmpty() || !window_) return;
  window_->grab().save(folder + "/" + QString::fromStdString(name) + ".png");
}

bool WindowAtWork::shows_something(const QPixmap& picture) {
  const QImage image = picture.toImage();
  std::set<QRgb> colours;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) colours.insert(image.pixel(x, y));
  }
  return colours.size() > 20;
}

void WindowAtWork::settle_jobs() {
  for (int quiet = 0; quiet < 3; ++quiet) {
    QApplication::sendPostedEvents();
    QApplication::processEvents();
    document().settle();
    for (PictureDock& dock : app_->pictures) dock.picture->wait();
    app_->transfer->wait();
    app_->seed_tool->wait();
    if (pump_->queue().drain() > 0) quiet = -1;
  }
}

void WindowAtWork::settle() {
  do {
    while (app_->animations.running()) QApplication::processEvents(QEventLoop::WaitForMoreEvents);
    settle_jobs();
  } while (app_->animations.running());
}

void WindowAtWork::wheel(const std::string& dock, PixelPoint at, int steps, Qt::KeyboardModifiers keys) {
  QWidget* on = view(dock);
  const QPointF place(at.x, at.y);
  QWheelEvent event(place, on->mapToGlobal(place), {}, {0, 120 * steps}, Qt::NoButton, keys, Qt::NoScrollPhase, false);
  QApplication::sendEvent(on, &event);
  settle();
}

void WindowAtWork::with_dialog(const std::function<void()>& opens, const std::function<void(QDialog&)>& hands) {
  QTimer looks;
  QObject::connect(&looks, &QTimer::timeout, window_.get(), [&looks, &hands] {
    auto* dialog = qobject_cast<QDialog*>(QApplication::activeModalWidget());
    if (dialog == nullptr || !dialog->isVisible()) return;  // not yet
    looks.stop();
    hands(*dialog);
    EXPECT_FALSE(dialog->isVisible()) << "nothing ended it";
    if (dialog->isVisible()) dialog->reject();
  });
  looks.start(0);
  opens();
  EXPECT_FALSE(looks.isActive()) << "no dialog was opened";
}

void WindowAtWork::unfold(const char* section) {
  for (auto* fold : view("controls")->findChildren<QToolButton*>()) {
    if (fold->text() == section && !fold->isChecked()) QTest::mouseClick(fold, Qt::LeftButton);
  }
  settle();
}

PixelPoint WindowAtWork::place_in(const std::string& dock, const Voxel& voxel) {
  const auto* slice = dynamic_cast<SliceModel*>(app_->picture(dock));
  EXPECT_NE(slice, nullptr);
  const auto place = slice->picture()->place_of(voxel);
  EXPECT_TRUE(place);
  return place.value_or(PixelPoint{});
}

WindowAtWork::Target WindowAtWork::look_at_school() {
  Work work;
  const auto found = observe(*document().survey(), document().shown()->files(), Recipe{}, {{}, {}, "test"}, work);
  EXPECT_TRUE(found && !found->masks.empty());
  Target target;
  const SchoolMask& mask = found->masks[found->masks.size() / 4];
  target.ping = mask.ping_index;
  auto left = std::max_element(mask.mask.confidence.begin(), mask.mask.confidence.end()) - mask.mask.confidence.begin();
  for (const sonar::Run& run : mask.mask.runs) {
    if (left < run.count) {
      const int beams = document().shown()->sector().beams();
      target.voxel = {run.row / beams, run.row % beams, run.first_sample + static_cast<int>(left)};
      break;
    }
    left -= run.count;
  }
  document().look_at(target.ping);
  app_->workspace.slices.set({target.voxel.fan, target.voxel.beam, target.voxel.sample});
  settle();
  return target;
}

}  // namespace sonar
