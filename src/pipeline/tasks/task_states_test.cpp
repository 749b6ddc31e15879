// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tasks/task_states.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "io/product_example.h"
#include "io/product_file.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

class TaskStates : public testing::Test {
 protected:
  TaskStates() : out_(fs::temp_directory_path() / ("sonar_tasks_" + std::to_string(::getpid()))) {
    fs::create_directories(out_ / "products");
    for (const char* name : {"obs-0001", "obs-0002", "obs-0003", "obs-0004", "obs-0005"}) {
      PlanTask task;
      task.observation = name;
      task.key = std::string("key of ") + name;
      plan_.tasks.push_back(task);
    }
  }
  ~TaskStates() override { fs::remove_all(out_); }
  TaskStates(const TaskStates&) = delete;
  TaskStates& operator=(const TaskStates&) = delete;

  void make_product(const std::string& name, const std::string& key) const {
    ObservationProduct product = example::empty(name, 3);
    product.input_hash = key;
    ASSERT_TRUE(write_product(product, out_ / "products" / (name + ".nc")));
  }
  void record(const std::string& name, const std::string& host, const std::string& error) const {
    TaskRecord record = record_of_this_process(0);
    record.host = host;
    record.error = error;
    ASSERT_TRUE(write_record(out_, name, record));
  }
  [[nodiscard]] std::string states() const {
    std::string text;
    for (const TaskStatus& task : task_states(plan_, out_, [](const TaskRecord& r) -> std::optional<bool> {
           if (r.host == "gone") return false;
           return r.host == "here" ? std::optional<bool>(true) : std::nullopt;
         })) {
      text += std::string(kTaskStateNames[static_cast<std::size_t>(task.state)]) + " ";
    }
    return text;
  }

  fs::path out_;
  Plan plan_;
};

TEST_F(TaskStates, AreToldByProductsAndRecords) {
  EXPECT_EQ(states(), "waiting waiting waiting waiting waiting ");
  make_product("obs-0001", "key of obs-0001");
  make_product("obs-0002", "of other files");
  record("obs-0003", "here", "");
  record("obs-0004", "gone", "");
  record("obs-0005", "here", "disk is full");
  EXPECT_EQ(states(), "done waiting running lost failed ");
  record("obs-0004", "where nobody can look", "");
  EXPECT_EQ(states(), "done waiting running running failed ");
  record("obs-0001", "gone", "");  // its product was written all the same
  remove_record(out_, "obs-0005");
  EXPECT_EQ(states(), "done waiting running running waiting ");
}

TEST_F(TaskStates, AProcessOfThisHostIsAliveOrNot) {
  const TaskRecord own = record_of_this_process(0);
  EXPECT_EQ(is_alive(own), true);
  TaskRecord other = own;
  other.host += "-not";
  EXPECT_FALSE(is_alive(other).has_value());
  TaskRecord none = own;
  none.process = 0;
  EXPECT_FALSE(is_alive(none).has_value());
}

TEST_F(TaskStates, RecordsReadBackAndBrokenOnesAreNone) {
  TaskRecord record = record_of_this_process(kSecondNs);
  record.slurm_job = "12_3";
  record.error = "no such file";
  ASSERT_TRUE(write_record(out_, "obs-0001", record));
  const auto back = read_record(out_, "obs-0001");
  ASSERT_TRUE(back);
  EXPECT_EQ(back->slurm_job, "12_3");
  EXPECT_EQ(back->error, "no such file");
  EXPECT_EQ(back->since_utc, "1970-01-01T00:00:01.000Z");
  EXPECT_EQ(back->process, ::getpid());
  EXPECT_FALSE(read_record(out_, "obs-0002"));
}

TEST(IndexList, ShortensNeighbours) {
  EXPECT_EQ(index_list({}), "");
  EXPECT_EQ(index_list({4}), "4");
  EXPECT_EQ(index_list({0, 1, 2, 3, 7, 9, 10}), "0-3,7,9-10");
}

}  // namespace
}  // namespace sonar
