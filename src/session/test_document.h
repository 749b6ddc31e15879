// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

#include "session/test_survey.h"

namespace sonar {

/// A document of the small simulated survey; what lies beside its journal and in its cache is there at the next opening.
class TestDocument : public testing::Test {
 protected:
  [[nodiscard]] DocumentOptions options() const {
    DocumentOptions options = TestSurvey::options(folder_);
    options.cache.folder = folder_ / "cache";
    return options;
  }
  /// Lets go of what is open, which keeps its figures, and opens it again.
  void open() { open(options()); }
  void open(const DocumentOptions& options) {
    document_.reset();
    document_ = std::make_unique<Document>(queue_, options);
    document_->open({TestSurvey::easy().folder()});
    document_->settle();
  }
  void detect() {
    document_->detect({0});
    document_->settle();
  }
  [[nodiscard]] const ObservationFiles& observation() const { return document_->survey()->observations[0]; }

  std::filesystem::path folder_ = TestSurvey::easy().fresh();
  ChangeQueue queue_;
  std::unique_ptr<Document> document_;
};

}  // namespace sonar
