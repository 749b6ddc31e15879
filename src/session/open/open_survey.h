// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "base/task_thread.h"
#include "base/work.h"
#include "model/product.h"
#include "pipeline/journal/journal_place.h"
#include "pipeline/journal/state_product.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/survey/survey.h"
#include "pipeline/tasks/other_finds.h"
#include "pipeline/tasks/survey_numbers.h"
#include "session/change_queue.h"
#include "session/looks/choices.h"
#include "session/open/open_observation.h"

namespace sonar {

class Document;
enum class DocumentChange : std::uint8_t;

struct Progress {
  std::string stage;  ///< empty = nothing runs
  std::int64_t done = 0;
  std::int64_t total = 0;
};

/// "obs-0002 cannot be shown: the beams make no product grid: ...".
/// observation  has no grid
[[nodiscard]] std::string why_no_grid(const ObservationFiles& observation);

/// Of what is found in an observation by itself under a recipe.
[[nodiscard]] std::string key_of_find(const SurveyFiles& survey, const ObservationFiles& observation, Recipe recipe,
                                      const std::string& program_version);

using ProductPtr = std::shared_ptr<const ObservationProduct>;
using RefusedPtr = std::shared_ptr<const std::vector<RefusedEcho>>;
using EventsPtr = std::shared_ptr<const std::vector<PlacedEvent>>;

/// What reading a survey brings.
struct SurveyRead {
  Recipe recipe;                                      ///< what choices stand on
  std::shared_ptr<const SurveyFiles> files{};         ///< null = no survey is open
  std::vector<std::filesystem::path> named{};         ///< what Document::open() was given
  std::vector<std::filesystem::path> paths{};         ///< the raw files of those, and folders of them
  std::vector<std::filesystem::path> work_folders{};  ///< of runs, in which schools were found before
  std::set<std::size_t> found{};              ///< observations whose schools those have as detect() would find them
  std::map<std::size_t, OtherFind> others{};  ///< observations whose schools they have
  Result<JournalPlace> place = JournalPlace{};
  /// [observation] of results whose raw files are not here (SurveyFiles::raw_gone); empty = pings can be read.
  std::vector<ProductPtr> products{};
  std::optional<Recipe> recipe_before{};  ///< that the survey was open under until Document::use_recipe(); empty = none
};

/// One survey at work, from its opening until another takes its place: what is read and chosen of it, looked at and
/// measured in it. Its document alone knows it, and tells its callers what the members are for that have the same names
/// there.
/// threads  the window's
class OpenSurvey : public std::enable_shared_from_this<OpenSurvey> {
 public:
  /// The document outlives it, and what it runs there ends before it.
  OpenSurvey(Document& document, ChangeQueue& queue, SurveyRead read);
  /// What was measured is kept for the next time that the survey is opened.
  ~OpenSurvey();
  OpenSurvey(const OpenSurvey&) = delete;
  OpenSurvey& operator=(const OpenSurvey&) = delete;

  /// Looks at the first ping.
  /// back_to  observation and ping that it begins with; none, or one that is not there = where it was left
  void begin(const std::optional<std::pair<std::size_t, std::int64_t>>& back_to);
  bool grow(std::shared_ptr<const SurveyFiles> survey);
  [[nodiscard]] std::string nothing_shown() const;
  [[nodiscard]] Recipe measuring_recipe() const;
  [[nodiscard]] Progress activity() const;
  Result<void> show(std::size_t observation, std::int64_t ping = 0);
  /// With what waited for another survey that was being read and did not come.
  void go_on();
  [[nodiscard]] OpenObservationPtr open_observation(std::size_t index) const;
  void open_all();
  void look_at(std::int64_t ping_index);
  ActTicket act(std::size_t observation, std::int64_t ping_index, Command command, std::shared_ptr<JournalStep> step);
  void undo();
  void redo();
  void stop_propagation();
  [[nodiscard]] const JournalState& state(std::size_t observation) const;
  [[nodiscard]] bool busy() const { return choices_thread_ && choices_thread_->busy(); }
  /// as_made  shows what runs made as it is
  void detect(std::vector<std::size_t> observations, bool as_made = false);
  void take_schools(std::size_t observation, const ObservationProduct& found);
  [[nodiscard]] bool detected(std::size_t observation) const;
  [[nodiscard]] bool asks_for_schools(std::size_t observation) const;
  [[nodiscard]] bool lacks_detected(std::size_t observation) const;
  [[nodiscard]] RefusedPtr refused(std::size_t observation) const;
  [[nodiscard]] EventsPtr found_events(std::size_t observation) const;
  [[nodiscard]] ProductPtr product(std::size_t observation) const;
  [[nodiscard]] ProductPtr as_made(std::size_t observation) const;
  [[nodiscard]] bool all_measured() const;
  [[nodiscard]] const std::string& unmeasured() const;
  void keep_survey_numbers(std::vector<SurveyNumber> numbers);
  /// Returns when nothing of it runs or waits in the background.
  void wait();

 private:
  friend class Document;  // hands out what is shown

  /// What detection gave of one observation.
  struct Found {
    std::vector<SchoolMasks> schools;
    std::vector<RefusedEcho> refused;
    std::shared_ptr<const EarlierSchools> earlier;  ///< see earlier_found()
    EventsPtr events;
    ProductPtr as_made;  ///< see OtherFind; null = by this version under this recipe
  };
  /// schools  detected_schools() or decided_schools() of it
  [[nodiscard]] static Found found_in(const ObservationProduct& product, std::vector<SchoolMasks> schools,
                                      std::shared_ptr<const EarlierSchools> earlier = {});
  /// What was measured of an observation, in this session and, once read from the cache, before it.
  struct KeptMeasures {
    MeasuredPings measured;
    bool read = false;
  };
  struct Measuring {
    CancelToken token;
    std::shared_ptr<Work> work;
    void cancel() const {
      token.cancel();
      work->cancel();
    }
  };
  /// An observation that is open.
  struct AtWork {
    OpenObservationPtr chosen_on;  ///< under the recipe: what choices stand on
    OpenObservationPtr open;       ///< the same, or under a calibration that a human chose
    std::shared_ptr<KeptMeasures> kept = std::make_shared<KeptMeasures>();
    std::optional<Measuring> measuring;                     ///< begun last
    ProductPtr product;                                     ///< null before it is measured
    std::string unmeasured;                                 ///< why it cannot be; empty = it can, as far as is known
    std::optional<std::vector<RefusedEcho>> found_refused;  ///< as detection told them; none = it was not looked for
    RefusedPtr refused;                                     ///< those of them that are no school now
    EventsPtr found_events;                                 ///< as detection noted them; null = it was not looked for
    ProductPtr as_made;  ///< what a run made, which is shown as it is; null = this version's find
  };

  void tell(DocumentChange change);
  void tell(std::string notice);
  /// Brings a change into the window's turn, unless its job is cancelled or the survey is let go before.
  void post(const CancelToken& token, std::function<void()> change);
  void begin_where_it_was_left(std::size_t first);
  void await_schools();
  void take_choices(ChoicesShown shown);
  void take_step(std::size_t observation, std::int64_t ping_index, const PingMask& mask);
  AtWork& opened(std::size_t index);
  void take_ping(const Result<StagedPingPtr>& staged);
  void detect_one(const std::shared_ptr<const SurveyFiles>& survey, std::size_t index, bool as_made,
                  const std::shared_ptr<JournalStep>& step, Work& work, const CancelToken& token);
  void tell_as_made(const std::vector<std::size_t>& observations);
  void take_detected(std::size_t index, Found found, const std::shared_ptr<JournalStep>& step);
  void follow_refused(const ChoicesShown& before);
  void look_at_others();
  void rest_unless_shown(std::size_t observation);
  void tell_unseen(const ChoicesShown& before);
  void tell_beyond_reach();
  void tell_lacking(const std::vector<std::size_t>& observations);
  void measure_changed(const ChoicesShown& before);
  void measure(std::size_t index);
  [[nodiscard]] Result<void> measure_behind(const OpenObservationPtr& observation, const JournalState& state,
                                            const std::vector<JournalLine>& lines, const RefusedPtr& refused,
                                            const EventsPtr& events, const ProductPtr& as_made, KeptMeasures& kept,
                                            std::uint64_t memory_bytes, const CancelToken& token, Work& work);
  [[nodiscard]] std::string key_of(OpenObservation& observation) const;
  void keep_measures();
  [[nodiscard]] std::vector<IndexCache> kept_in() const;
  void take_measured();
  void take_unmeasured(std::size_t index, const std::string& line);
  void take_product(std::size_t observation, const ProductPtr& product);
  void follow_calibration();
  void replay_journal();
  [[nodiscard]] OpenObservationPtr calibrated(const OpenObservationPtr& chosen_on) const;

  Document& document_;
  ChangeQueue& queue_;
  SurveyRead read_;  ///< but for the place of its journal, which choices_thread_ has; the files grow
  std::filesystem::path journal_folder_;  ///< empty = the journal has none
  std::map<std::size_t, AtWork> open_;
  std::set<std::size_t> unreplayed_;     ///< of these the journal's lines wait until something is seen
  std::vector<std::size_t> undetected_;  ///< so does the detection that they ask for, and what runs found
  std::shared_ptr<const CalibrationParams> calibration_;
  OpenObservationPtr shown_;
  std::int64_t ping_ = 0;
  StagedPingPtr staged_;
  std::string unreadable_;  ///< why the ping that is looked at did not arrive; empty = it did, or may
  ChoicesShown choices_;
  std::chrono::steady_clock::time_point others_looked_at_;
  std::map<std::int64_t, PingMask> propagating_;
  std::vector<SurveyNumber> survey_numbers_;
  Progress following_;  ///< a propagation's pings
  Progress replaying_;  ///< the journal's lines
  std::optional<std::int64_t> followed_;
  std::int64_t measures_begun_ = 0;
  std::int64_t measures_done_ = 0;
  std::unique_ptr<Choices> choices_thread_;
  TaskThread measures_;  // the last members: they end first
};

}  // namespace sonar
