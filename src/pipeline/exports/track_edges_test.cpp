// SPDX-License-Identifier: Apache-2.0
#include "pipeline/exports/track_edges.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/product_example.h"
#include "school/track/track.h"

namespace sonar {
namespace {

TEST(TrackEdges, events_are_read_as_they_are_told) {
  for (const TrackEvent& event :
       {TrackEvent{TrackEventKind::birth, 0, 12, 0}, TrackEvent{TrackEventKind::death, 7, 1, 0},
        TrackEvent{TrackEventKind::split, 12, 4, 2}, TrackEvent{TrackEventKind::merge, 100, 40, 7}}) {
    const auto read = event_from_text(to_text(event));
    ASSERT_TRUE(read) << to_text(event);
    EXPECT_EQ(read->kind, event.kind);
    EXPECT_EQ(read->ping_index, event.ping_index);
    EXPECT_EQ(read->school_id, event.school_id);
    EXPECT_EQ(read->other_id, event.other_id);
  }
  for (const char* text : {"", "ping 1: school", "ping 1: school 2 first seen, as it seems", "ping 1: school 2 left"}) {
    EXPECT_FALSE(event_from_text(text)) << text;
  }
}

/// School 1 is unseen in pings 3 and 4 and swallows 3 after ping 5; 2 splits from it in ping 6 and stays to the end; 4 is
/// noted to have split from a school that a human has removed since.
TEST(TrackEdges, of_each_kind) {
  ObservationProduct p = example::empty("obs-0002", 10);
  const PingMask mask = example::block(0, 0, 3, 10, 12);
  example::add_school(p, 1, 0, 2, mask);
  example::add_school(p, 1, 5, 8, mask);
  example::add_school(p, 2, 6, 9, mask);
  example::add_school(p, 3, 2, 5, mask);
  example::add_school(p, 4, 1, 1, mask);
  for (const TrackEvent& event :
       {TrackEvent{TrackEventKind::split, 6, 2, 1}, TrackEvent{TrackEventKind::merge, 6, 3, 1},
        TrackEvent{TrackEventKind::split, 1, 4, 9}}) {
    Diagnostic note;
    note.code = DiagnosticCode::track_event;
    note.text = to_text(event);
    p.diagnostics.push_back(note);
  }
  std::vector<std::string> told;
  for (const TrackEdgeRow& edge : track_edges(p)) {
    told.push_back(std::to_string(edge.school_id) + " " + edge.event + " " + std::to_string(edge.ping_index) + " " +
                   edge.other_school);
    EXPECT_EQ(edge.time_utc, p.pings[static_cast<std::size_t>(edge.ping_index)].time);
  }
  EXPECT_EQ(told,
            (std::vector<std::string>{"1 born 0 ", "1 lost 2 ", "1 refound 5 ", "1 lost 8 ", "2 split 6 obs-0002/1",
                                      "3 born 2 ", "3 merged 5 obs-0002/1", "4 born 1 ", "4 lost 1 "}));
}

/// School 2 merges into 1, comes out again, and in the end it only leaves.
TEST(TrackEdges, of_a_school_that_comes_out_of_another_again) {
  ObservationProduct p = example::empty("obs-0002", 10);
  const PingMask mask = example::block(0, 0, 3, 10, 12);
  example::add_school(p, 1, 0, 9, mask);
  example::add_school(p, 2, 0, 2, mask);
  example::add_school(p, 2, 5, 7, mask);
  Diagnostic note;
  note.code = DiagnosticCode::track_event;
  note.text = to_text(TrackEvent{TrackEventKind::merge, 3, 2, 1});
  p.diagnostics.push_back(note);
  std::vector<std::string> told;
  for (const TrackEdgeRow& edge : track_edges(p)) {
    if (edge.school_id == 2) told.push_back(edge.event + " " + std::to_string(edge.ping_index));
  }
  EXPECT_EQ(told, (std::vector<std::string>{"born 0", "merged 2", "refound 5", "lost 7"}));
}

}  // namespace
}  // namespace sonar
