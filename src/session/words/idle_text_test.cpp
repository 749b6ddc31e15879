// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>

#include "session/test_app.h"

namespace sonar {
namespace {

using testing::HasSubstr;

// Until something can be shown, the first view says what goes on, how far it is, and what ends it.
TEST(IdleText, TellsHowFarTheFirstSurveyIsAndEscapeEndsIt) {
  ChangeQueue queue;
  AppModel app(queue, TestSurvey::options(TestSurvey::easy().fresh()));
  Document& document = app.workspace.document;
  EXPECT_THAT(idle_text(app, "top_slice"), HasSubstr("Open a survey"));
  for (const char* instrument : {"MS70", "ME70", "EK60", "EK80"}) {
    EXPECT_THAT(idle_text(app, "top_slice"), HasSubstr(instrument)) << "what leads to schools, and what does not yet";
  }
  std::promise<void> seen;
  std::promise<bool> ended;
  document.open({TestSurvey::easy().folder()}, [&](Work& work) -> Result<void> {
    work.progress("simulate", 5, 20);
    seen.get_future().wait();
    ended.set_value(work.cancelled());
    return fail(ErrorCode::cancelled, "stopped on request");
  });
  while (document.progress().stage.empty()) {
    queue.wait();
    queue.drain();
  }
  EXPECT_EQ(idle_text(app, "top_slice"), "Making the simulated survey, 25 %.\nEsc, or Cancel below, stops it.");
  EXPECT_EQ(idle_text(app, "side_slice"), "");
  app.actions.find("tool.cancel")->run();
  seen.set_value();
  EXPECT_TRUE(ended.get_future().get());
  document.settle();
  EXPECT_THAT(idle_text(app, "top_slice"), HasSubstr("Open a survey"));
  EXPECT_THAT(document.notices().back(), HasSubstr("stopped"));
}

TEST(IdleText, NamesTheFolderInWhichThereAreNoPings) {
  ChangeQueue queue;
  AppModel app(queue, TestSurvey::options(TestSurvey::easy().fresh()));
  const auto empty = TestSurvey::easy().fresh();
  app.workspace.document.open({empty});
  app.workspace.document.settle();
  const std::string text = app.workspace.document.survey() == nullptr ? app.workspace.document.notices().back()
                                                                      : idle_text(app, "top_slice");
  EXPECT_THAT(text, HasSubstr(empty.string()));
}

// What the journal says is carried out anew after opening: line by line, and told so.
TEST(IdleText, AJournalThatIsReadAtOpeningShowsHowFarItIs) {
  const auto journal = TestSurvey::easy().fresh();
  ChangeQueue queue;
  for (const bool again : {false, true}) {
    Document document(queue, TestSurvey::options(journal));
    std::vector<std::int64_t> totals;
    const Listening heard_of(document.changes(), [&](DocumentChange change) {
      const Progress now = document.activity();
      if (change == DocumentChange::progress && now.stage == "reading the journal") totals.push_back(now.total);
    });
    document.open({TestSurvey::easy().folder()});
    document.settle();
    if (again) {
      EXPECT_THAT(totals, testing::Contains(3));
    }
    EXPECT_EQ(document.activity().stage, "") << "and then it is done";
    for (int i = 0; i < 3 && !again; ++i) {
      document.act(EventCommand{"trawl", document.shown()->context().times[static_cast<std::size_t>(i)], ""});
    }
    document.settle();
  }
}

}  // namespace
}  // namespace sonar
