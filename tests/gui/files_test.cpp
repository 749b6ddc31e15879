// SPDX-License-Identifier: Apache-2.0
// What comes into the window and what goes out of it. Dialogs are answered by the test.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QCheckBox>
#include <QClipboard>
#include <QDialog>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QDropEvent>
#include <QLineEdit>
#include <QMimeData>
#include <QProcess>
#include <QProgressBar>
#include <QPushButton>
#include <QSpinBox>
#include <QStatusBar>
#include <QToolButton>
#include <QUrl>
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <utility>

#include "gui/action_menus.h"
#include "publish/picture_options.h"
#include "publish/picture_source.h"
#include "render/draw_frame.h"
#include "session/listening.h"
#include "session/playing/playback.h"
#include "session/test_run.h"
#include "window_at_work.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

/// Programs are looked for in this folder alone, for as long as this lives.
class OtherPath {
 public:
  explicit OtherPath(const fs::path& folder) { ::setenv("PATH", folder.c_str(), 1); }
  ~OtherPath() { before_.empty() ? ::unsetenv("PATH") : ::setenv("PATH", before_.c_str(), 1); }
  OtherPath(const OtherPath&) = delete;
  OtherPath& operator=(const OtherPath&) = delete;

 private:
  std::string before_ = std::getenv("PATH") == nullptr ? "" : std::getenv("PATH");
};

/// As the chunk acTL tells it (APNG specification 1.0: its first four bytes, the highest first); 0 where there is none.
int frames_of_animated_png(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const std::size_t at = bytes.find("acTL");
  if (at == std::string::npos || at + 8 > bytes.size()) return 0;
  int frames = 0;
  for (std::size_t i = at + 4; i < at + 8; ++i) frames = 256 * frames + static_cast<unsigned char>(bytes[i]);
  return frames;
}

class Files : public WindowAtWork {
 protected:
  void SetUp() override {
    WindowAtWork::SetUp();
    real_parameters_ = std::exchange(app_->dialogs.parameters, [](const auto&, const auto&) { return true; });
    app_->dialogs.folder_to_save = [this](const std::string&, const std::string&) { return out_.string(); };
    app_->dialogs.file_to_save = [this](const std::string&, const std::string&, const std::string& name) {
      saved_ = out_ / name;
      return saved_.string();
    };
  }
  /// What a menu's entry does.
  void trigger(const std::string& id) {
    find_action(*window_, id)->trigger();
    settle();
  }
  const std::string& told() { return document().notices().back(); }
  static std::vector<std::string> lines_of(const fs::path& file) {
    std::ifstream in(file);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
  }
  static void keep_dialog(QDialog& dialog) {
    const QString folder = qEnvironmentVariable("SONAR_GUI_PICTURES");
    if (!folder.isEmpty()) dialog.grab().save(folder + "/dialog.png");
  }
  void follow_a_school() {
    const Target target = look_at_school();
    double_click("top_slice", place_in("top_slice", target.voxel));
    ASSERT_GT(masks().size(), 2U);
  }

  /// Lets a folder go over the window.
  void drop(const fs::path& folder) {
    QMimeData dropped;
    dropped.setUrls({QUrl::fromLocalFile(QString::fromStdString(folder.string()))});
    QDragEnterEvent enter(QPoint(200, 200), Qt::CopyAction, &dropped, Qt::LeftButton, {});
    QApplication::sendEvent(window_.get(), &enter);
    EXPECT_TRUE(enter.isAccepted());
    QDropEvent drop(QPointF(200, 200), Qt::CopyAction, &dropped, Qt::LeftButton, {});
    QApplication::sendEvent(window_.get(), &drop);
    settle();
  }

  fs::path saved_;  ///< under the name that was offered
  fs::path out_ = TestSurvey::easy().fresh();
  decltype(Dialogs::parameters) real_parameters_;
};

TEST_F(Files, APictureIsAskedForItsSizeInADialog) {
  app_->dialogs.parameters = real_parameters_;
  const auto asks = [this] { trigger("picture.slice-plane"); };
  with_dialog(asks, [this](QDialog& dialog) {
    EXPECT_EQ(dialog.objectName(), "parameters");
    auto* width = dialog.findChild<QSpinBox*>("width_px");
    ASSERT_NE(width, nullptr);
    width->setFocus();
    width->selectAll();
    QTest::keyClicks(width, "640");
    keep_dialog(dialog);
    QTest::keyClick(width, Qt::Key_Return);
    EXPECT_EQ(workspace().picture_file.values().paper.width_px, 640);
  });
  const auto picture = read_png(saved_);
  ASSERT_TRUE(picture) << told();
  EXPECT_EQ(picture->size.width, 640);
  fs::remove(saved_);
  with_dialog(asks, [](QDialog& dialog) {
    dialog.findChild<QSpinBox*>("width_px")->setValue(999);
    QTest::mouseClick(dialog.findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Cancel), Qt::LeftButton);
  });
  EXPECT_EQ(workspace().picture_file.values().paper.width_px, 640);
  EXPECT_FALSE(fs::exists(saved_));
}

TEST_F(Files, ResultsOpenWithoutTheirRawFilesUntilTheseAreFound) {
  auto plan = run_easy(out_);
  ASSERT_TRUE(plan);
  plan->survey = {(out_ / "gone").string()};
  std::ofstream(out_ / "plan.json") << plan_text(*plan);
  drop(out_);
  EXPECT_EQ(document().staged(), nullptr);
  EXPECT_EQ(document().state().schools.size(), 2U);
  raise("survey_map");
  EXPECT_GT(app_->picture("survey_map")->image().size.width, 0);
  EXPECT_THAT(idle_text(*app_, "top_slice"), testing::HasSubstr("the raw files are not here"));
  keep_picture(testing::UnitTest::GetInstance()->current_test_info()->name());
  app_->dialogs.folder_to_open = [] { return TestSurvey::easy().folder().string(); };
  key(Qt::Key_O, Qt::ControlModifier | Qt::AltModifier);
  EXPECT_NE(document().staged(), nullptr);
  EXPECT_EQ(document().state().schools.size(), 2U);
}

TEST_F(Files, ASurveyIsReopenedWhereAndAsItWasLeft) {
  app_->preferences.path = out_ / "preferences.json";
  key(Qt::Key_D);
  const std::size_t schools = document().state().schools.size();
  ASSERT_GT(schools, 0U);
  key(Qt::Key_Home);
  for (int i = 0; i < 4; ++i) key(Qt::Key_Right);
  key(Qt::Key_Plus);
  const double rate = app_->playback->rate();
  key(Qt::Key_2, Qt::AltModifier);
  window_->resize(1500, 940);
  settle();
  window_->close();
  const auto kept = Preferences::load(out_ / "preferences.json");
  EXPECT_EQ(kept.notice, "");
  close();
  survey_.clear();
  open();
  app_->preferences = kept.preferences;  // as the program begins
  app_->preferences.apply(workspace());
  window_->take_layout(app_->preferences.window_layout);
  document().open({TestSurvey::easy().folder()});
  settle();
  EXPECT_EQ(document().ping(), 4);
  EXPECT_EQ(document().state().schools.size(), schools);
  EXPECT_EQ(app_->playback->rate(), rate);
  EXPECT_TRUE(dock("side_slice")->isHidden());
  EXPECT_EQ(window_->size(), QSize(1500, 940));
}

TEST_F(Files, FilesAreOpenedByTheirDialogAndByDropping) {
  std::vector<fs::path> raw;
  for (const auto& entry : fs::directory_iterator(survey_)) {
    if (entry.path().extension() == ".raw") raw.push_back(entry.path());
  }
  ASSERT_FALSE(raw.empty());
  std::sort(raw.begin(), raw.end());
  app_->dialogs.files_to_open = [&raw] { return std::vector{raw.front().string()}; };
  trigger("file.open_files");
  EXPECT_EQ(document().paths(), std::vector{raw.front()});
  EXPECT_TRUE(document().staged());
  drop(raw.back());
  EXPECT_EQ(document().paths(), std::vector{raw.back()});
  EXPECT_TRUE(document().staged());
}

// Found by its name, changed and used, by hand; what is saved on the way is a recipe that a run reads.
TEST_F(Files, ARecipeIsChangedInItsDialog) {
  const auto changes = [this](QDialog& dialog) {
    keep_dialog(dialog);
    QTest::keyClicks(dialog.findChild<QLineEdit*>("words"), "detect.tolerance");
    auto* box = dialog.findChild<QDoubleSpinBox*>("detect.tolerance_db.box");
    ASSERT_NE(box, nullptr);
    EXPECT_EQ(dialog.findChild<QWidget*>("background.quantile.box"), nullptr) << "only what was looked for";
    box->setFocus();
    box->selectAll();
    QTest::keyClicks(box, "7");
    QTest::keyClick(box, Qt::Key_Return);
    // What is not the default says so, and a button brings the default back.
    auto* usual = dialog.findChild<QToolButton*>("detect.tolerance_db.default");
    QApplication::processEvents();
    pump_->queue().drain();
    EXPECT_TRUE(usual->isVisible());
    keep_dialog(dialog);
    QTest::mouseClick(usual, Qt::LeftButton);
    pump_->queue().drain();
    EXPECT_EQ(box->value(), Recipe{}.detect.tolerance_db);
    EXPECT_FALSE(usual->isVisible());
    box->setFocus();
    box->selectAll();
    QTest::keyClicks(box, "7");
    QTest::keyClick(box, Qt::Key_Return);
    QTest::mouseClick(dialog.findChild<QPushButton*>("save"), Qt::LeftButton);
    QTest::mouseClick(dialog.findChild<QCheckBox*>("changed"), Qt::LeftButton);
    EXPECT_NE(dialog.findChild<QDoubleSpinBox*>("detect.tolerance_db.box"), nullptr);
    QTest::mouseClick(dialog.findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Ok), Qt::LeftButton);
  };
  with_dialog([this] { trigger("file.recipe"); }, changes);
  EXPECT_EQ(document().recipe().detect.tolerance_db, 7.0) << told();
  EXPECT_TRUE(document().staged()) << "the survey is there again";
  const auto saved = read_recipe(saved_.string());
  ASSERT_TRUE(saved) << to_line(saved.error());
  EXPECT_EQ(saved->detect.tolerance_db, 7.0);
  EXPECT_TRUE(saved->automatic);
}

TEST_F(Files, ResultsAreAsARunWritesThem) {
  follow_a_school();
  key(Qt::Key_E, Qt::ControlModifier);
  EXPECT_THAT(told(), testing::HasSubstr("written: 2 observations"));
  Work work(1);
  const std::vector<fs::path> paths{out_};
  const auto source = PictureSource::open(paths, std::nullopt, work);
  ASSERT_TRUE(source);
  ASSERT_EQ((*source)->products().size(), 2U);
  const ObservationProduct& product = (*source)->products()[0];
  ASSERT_EQ(product.schools.size(), 1U);
  ASSERT_EQ(product.masks.size(), masks().size());
  for (std::size_t i = 0; i < masks().size(); ++i) {
    EXPECT_EQ(product.masks[i].mask, masks()[i].mask) << "the masks on the screen, bit for bit";
  }
  EXPECT_EQ(lines_of(out_ / "schools.csv").size(), 2U) << "titles and one school";
  EXPECT_EQ(lines_of(out_ / "school_pings.csv").size(), 1U + masks().size());
  EXPECT_EQ(lines_of(out_ / "survey.gpkg").at(0).substr(0, 15), "SQLite format 3");
}

TEST_F(Files, TheProgramItselfMakesTheSameMasksOfTheJournal) {
  const char* program = std::getenv("SONARX");
  if (program == nullptr) GTEST_SKIP() << "SONARX, the command-line program, is not given";
  follow_a_school();
  key(Qt::Key_E, Qt::ControlModifier);
  const fs::path run = TestSurvey::easy().fresh() / "run";
  QProcess process;
  process.start(program, {"run", QString::fromStdString(survey_.string()), "--session",
                          QString::fromStdString(document().journal_path().string()), "--out",
                          QString::fromStdString(run.string())});
  ASSERT_TRUE(process.waitForFinished(-1));
  ASSERT_EQ(process.exitCode(), 0) << process.readAllStandardError().toStdString();
  Work work(1);
  const std::vector<fs::path> window_paths{out_};
  const std::vector<fs::path> run_paths{run};
  const auto window = PictureSource::open(window_paths, std::nullopt, work);
  const auto ran = PictureSource::open(run_paths, std::nullopt, work);
  ASSERT_TRUE(window && ran);
  const auto& masks_of_window = (*window)->products()[0].masks;
  const auto& masks_of_run = (*ran)->products()[0].masks;
  ASSERT_EQ(masks_of_run.size(), masks_of_window.size());
  for (std::size_t i = 0; i < masks_of_run.size(); ++i) EXPECT_EQ(masks_of_run[i].mask, masks_of_window[i].mask);
}

TEST_F(Files, TheMovieOfASchoolIsOnePictureAPing) {
  follow_a_school();
  trigger("export.movie");
  EXPECT_NE(told().find("written: " + std::to_string(masks().size()) + " picture"), std::string::npos) << told();
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(out_)) files.push_back(entry.path());
  ASSERT_EQ(files.size(), 1U);
  EXPECT_EQ(files.front().stem(), "movie");
  EXPECT_TRUE(files.front().extension() == ".mp4" || read_png(files.front())) << files.front();
}

// Without ffmpeg: one line, which says where the movie is and why it is no MP4, and a bar that counts pictures up to all.
TEST_F(Files, WithoutFfmpegAMovieIsAnAnimatedPngAndItsPicturesAreCounted) {
  follow_a_school();
  const fs::path nothing = TestSurvey::easy().fresh();
  const OtherPath path(nothing);
  const auto& bar = *window_->statusBar()->findChild<QProgressBar*>();
  const int pictures = static_cast<int>(masks().size());
  std::vector<int> counted;
  const Listening listening(document().changes(), [&](DocumentChange change) {
    if (change != DocumentChange::progress || document().progress().stage != "movie") return;
    EXPECT_EQ(document().progress().total, pictures);
    counted.push_back(static_cast<int>(document().progress().done));
    EXPECT_EQ(std::pair(bar.value(), bar.maximum()), std::pair(counted.back(), pictures)) << "the bar follows";
  });
  const std::size_t before = document().notices().size();
  find_action(*window_, "export.movie")->trigger();
  const auto told_of_it = [&] { return document().notices().size() > before; };
  while (!told_of_it()) QApplication::processEvents(QEventLoop::WaitForMoreEvents);
  settle();
  EXPECT_TRUE(std::is_sorted(counted.begin(), counted.end()));
  EXPECT_GT(counted.size(), 1U) << "it is seen to go on";
  EXPECT_EQ(document().notices().size(), before + 1) << "one line";
  const fs::path file = out_ / "movie.png";
  EXPECT_EQ(told(), "written: " + std::to_string(pictures) + " pictures in " + file.string() +
                        "; with the program ffmpeg it would be an MP4");
  EXPECT_EQ(frames_of_animated_png(file), pictures);
}

TEST_F(Files, APictureOfTheViewInUseIsWhatItShows) {
  click("side_slice", {10.0, 10.0});
  const QSize size = view("side_slice")->size();
  key(Qt::Key_S, Qt::ControlModifier);
  EXPECT_EQ(view("side_slice")->size(), size) << "a notice pushes nothing about";
  const auto kept = read_png(saved_);
  ASSERT_TRUE(kept) << told();
  EXPECT_EQ(saved_.filename(), "obs-0001-ping-0000-side_slice.png");
  EXPECT_EQ(*kept, app_->picture("side_slice")->image());
  key(Qt::Key_C, Qt::ControlModifier | Qt::AltModifier);
  const QImage copied = QApplication::clipboard()->image().convertToFormat(QImage::Format_RGBA8888);
  const Image& shown = app_->picture("side_slice")->image();
  ASSERT_EQ(copied.size(), QSize(shown.size.width, shown.size.height));
  for (int y = 0; y < copied.height(); y += 7) {
    for (int x = 0; x < copied.width(); x += 7) {
      const Rgba8 c = shown.at(x, y);
      ASSERT_EQ(copied.pixelColor(x, y), QColor(c.r, c.g, c.b, c.a)) << x << ", " << y;
    }
  }
}

TEST_F(Files, APictureOfAnyKindIsMadeFromTheMenu) {
  follow_a_school();
  for (const PictureKindInfo& kind : picture_kinds()) {
    if (kind.name == "movie") continue;
    EXPECT_NE(find_action(*window_, "picture." + std::string(kind.name)), nullptr) << kind.name;
  }
  for (const char* kind : {"slice-top", "survey-map"}) {
    trigger(std::string("picture.") + kind);
    EXPECT_TRUE(read_png(saved_)) << told();
  }
}

TEST_F(Files, CtrlOAndADroppedFolderOpenASurvey) {
  app_->dialogs.folder_to_open = [this] { return survey_.string(); };
  int opened = 0;
  const Listening heard_of(document().changes(),
                           [&](DocumentChange change) { opened += change == DocumentChange::survey ? 1 : 0; });
  key(Qt::Key_O, Qt::ControlModifier);
  EXPECT_EQ(opened, 1);
  drop(survey_);
  EXPECT_EQ(opened, 2);
  EXPECT_EQ(document().shown()->name(), "obs-0001");
}

TEST_F(Files, ADroppedFolderOfResultsOpensItsSurveyWithTheirSchools) {
  ASSERT_TRUE(run_easy(out_));
  drop(out_);
  EXPECT_EQ(document().paths(), std::vector<fs::path>{survey_});
  ASSERT_EQ(document().named(), std::vector<fs::path>{out_});
  EXPECT_TRUE(document().detected(0) && document().detected(1));
  EXPECT_GE(app_->rows("schools")->rows(), 2U);
}

TEST_F(Files, AFolderWithoutPingsAndOneThatIsNotThereSaySo) {
  app_->dialogs.folder_to_open = [this] { return out_.string(); };
  key(Qt::Key_O, Qt::ControlModifier);
  const std::string empty = told();
  EXPECT_THAT(empty, testing::Not(testing::IsEmpty()));
  app_->dialogs.folder_to_open = [this] { return (out_ / "nowhere").string(); };
  key(Qt::Key_O, Qt::ControlModifier);
  EXPECT_THAT(told(), testing::HasSubstr("nowhere"));
  app_->dialogs.folder_to_open = [this] { return survey_.string(); };
  key(Qt::Key_O, Qt::ControlModifier);
  EXPECT_TRUE(document().staged()) << "and work goes on";
}

}  // namespace
}  // namespace sonar
