// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "session/app_model.h"
#include "session/listening.h"
#include "session/live/live_picture.h"
#include "view/figures/figure_page.h"

namespace sonar {

/// A picture of the window that may go on the page.
struct FigureChoice {
  std::string id;  ///< of its dock
  std::string title;
  bool chosen = false;
  bool wide = false;  ///< has a row of its own
  friend bool operator==(const FigureChoice&, const FigureChoice&) = default;
};

/// Pictures that have been drawn for a page, and what they were drawn from.
class DrawnPanels;

/// Several pictures of the window on a page, as Workspace::figure has it: what a dialog shows and changes. The picture is
/// a preview of the page, fitted into its view; what is written is the page of the preview.
/// threads  the window's
class FigureModel : public LivePicture {
 public:
  /// The app outlives the model. While it lives the chosen pictures are drawn, whether their views are seen or not.
  explicit FigureModel(AppModel& app);
  ~FigureModel() override;
  FigureModel(const FigureModel&) = delete;
  FigureModel& operator=(const FigureModel&) = delete;

  /// All pictures of the window, those on the page first and in their order there.
  [[nodiscard]] std::vector<FigureChoice> choices() const;
  /// A picture that is chosen comes last.
  void choose(const std::string& id, bool on);
  void set_wide(const std::string& id, bool wide);
  /// Forwards or backwards among those on the page.
  /// by  -1: one earlier
  void move(const std::string& id, int by);

  /// The page of the preview, once it gets no better; null before, and where there is none.
  [[nodiscard]] const std::shared_ptr<const FrameDescription>& page() const { return page_; }
  /// What a user must know: what is still being drawn or read, or what was written.
  [[nodiscard]] std::string told() const;
  /// Asks for a file and writes page() into it: .png, .svg or .pdf. How it went is told.
  void ask_and_write();
  /// errors  none: it is told why nothing was written. Never where raw files lie
  void write(const std::filesystem::path& file);

 protected:
  [[nodiscard]] Build build(const PictureLook& look) override;
  void take(const std::shared_ptr<const void>& detail) override;

 private:
  [[nodiscard]] std::vector<FigurePanelName> chosen() const;
  void set_chosen(const std::vector<FigurePanelName>& names);
  void follow_parameters();
  void look_at_chosen();
  void again();
  void write(const std::shared_ptr<const FrameDescription>& page, const std::filesystem::path& file);
  [[nodiscard]] std::string source() const;
  [[nodiscard]] PictureOrigin origin(const std::vector<FigurePanelName>& names) const;

  AppModel& app_;
  FigureParams before_;
  bool legend_ = true;         ///< room for colour bars is kept
  bool legend_tried_ = false;  ///< without, as the page was first
  std::shared_ptr<DrawnPanels> drawn_;
  std::shared_ptr<const FrameDescription> page_;
  std::int64_t wishes_ = 0;  ///< number of the last one
  std::string written_;
  std::shared_ptr<bool> here_ = std::make_shared<bool>(true);
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
