// SPDX-License-Identifier: Apache-2.0
#include "io/product_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netcdf.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <thread>

#include "base/test_full_disk.h"
#include "io/atomic_file.h"
#include "io/product_example.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Product : public testing::Test {
 protected:
  Product() : folder_(fs::temp_directory_path() / ("sonar_product_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~Product() override { fs::remove_all(folder_); }
  Product(const Product&) = delete;
  Product& operator=(const Product&) = delete;
  [[nodiscard]] fs::path at(const std::string& name) const { return folder_ / name; }

  static ObservationProduct sample() {
    ObservationProduct p = example::empty("obs-0001", 5);
    example::add_school(p, 1, 0, 3, example::block(1, 1, 2, 20, 8, 200));
    example::add_school(p, 2, 2, 4, example::block(0, 0, 3, 40, 5));
    p.pings[2].bad = true;
    p.diagnostics.push_back({DiagnosticCode::file_truncated, "a file.raw", 17, -1, "text, with \"quotes\""});
    p.rejected = {{.ping_index = 1,
                   .echo_id = 1,
                   .channel = 7,
                   .sample = 30,
                   .depth_m = 20.0,
                   .range_m = 59.0,
                   .n_beams = 1,
                   .n_fans = 2,
                   .level_db = -50.0,
                   .judge = "size",
                   .figure = 1.0,
                   .limit = 2.0,
                   .limit_unit = "beams"}};
    p.background_db.assign(5, std::vector<float>(12, -150.0F));
    p.background_db[3].clear();
    for (std::size_t row = 0; row < 12; ++row) p.background_db[0][row] = -140.0F - static_cast<float>(row);
    return p;
  }

  fs::path folder_;
};

void set_version(const fs::path& path, long long version) {
  int id = -1;
  ASSERT_EQ(nc_open(path.c_str(), NC_WRITE, &id), NC_NOERR);
  ASSERT_EQ(nc_put_att_longlong(id, NC_GLOBAL, "product_version", NC_INT64, 1, &version), NC_NOERR);
  ASSERT_EQ(nc_close(id), NC_NOERR);
}

TEST_F(Product, reads_back_what_was_written) {
  const ObservationProduct p = sample();
  ASSERT_TRUE(write_product(p, at("a.nc")));
  const auto back = read_product(at("a.nc"));
  ASSERT_TRUE(back) << to_line(back.error());
  EXPECT_EQ(back->observation, "obs-0001");
  EXPECT_EQ(back->recipe_json, p.recipe_json);
  EXPECT_EQ(back->input_files, p.input_files);
  ASSERT_TRUE(back->grid);
  EXPECT_EQ(back->grid->grid, p.grid->grid);
  EXPECT_EQ(back->grid->psi_used_db, p.grid->psi_used_db);
  EXPECT_EQ(back->grid->range, p.grid->range);
  EXPECT_EQ(back->grid->sample_count, p.grid->sample_count);
  ASSERT_EQ(back->pings.size(), 5U);
  EXPECT_EQ(back->pings[3].time, p.pings[3].time);
  EXPECT_EQ(back->pings[3].transducer, p.pings[3].transducer);
  EXPECT_TRUE(back->pings[2].bad);
  EXPECT_TRUE(std::isnan(back->pings[2].distance_nmi));
  EXPECT_EQ(back->background_db, p.background_db);
  ASSERT_EQ(back->masks.size(), p.masks.size());
  for (std::size_t i = 0; i < p.masks.size(); ++i) {
    EXPECT_EQ(back->masks[i].school_id, p.masks[i].school_id);
    EXPECT_EQ(back->masks[i].ping_index, p.masks[i].ping_index);
    EXPECT_EQ(back->masks[i].mask, p.masks[i].mask);
  }
  ASSERT_EQ(back->schools.size(), 2U);
  EXPECT_EQ(back->schools[1].comment, p.schools[1].comment);
  EXPECT_EQ(back->schools[1].first_time_utc, p.schools[1].first_time_utc);
  EXPECT_TRUE(std::isnan(back->schools[1].speed_mps));
  ASSERT_EQ(back->school_pings.size(), 7U);
  EXPECT_EQ(back->school_pings[6].latitude, p.school_pings[6].latitude);
  EXPECT_EQ(back->school_pings[6].time_utc, p.school_pings[6].time_utc);
  ASSERT_EQ(back->rejected.size(), 1U);
  EXPECT_EQ(back->rejected[0].sample, 30);
  EXPECT_EQ(back->rejected[0].judge, "size");
  EXPECT_EQ(back->rejected[0].limit_unit, "beams");
  EXPECT_EQ(back->rejected[0].limit, 2.0);
  EXPECT_TRUE(std::isnan(back->rejected[0].latitude));
  ASSERT_EQ(back->diagnostics.size(), 1U);
  EXPECT_EQ(back->diagnostics[0].code, DiagnosticCode::file_truncated);
  EXPECT_EQ(back->diagnostics[0].offset, 17);
  EXPECT_EQ(back->next_school_id, 3);  // one above what is there
  EXPECT_EQ(back->cut_after, 0);
}

TEST_F(Product, remembers_numbers_that_were_given_and_what_it_was_cut_from) {
  ObservationProduct p = sample();
  p.next_school_id = 9;
  p.cut_after = example::kStart - kSecondNs;
  ASSERT_TRUE(write_product(p, at("a.nc")));
  const auto back = read_product(at("a.nc"));
  ASSERT_TRUE(back) << to_line(back.error());
  EXPECT_EQ(back->next_school_id, 9);
  EXPECT_EQ(back->cut_after, example::kStart - kSecondNs);
  const auto key = read_product_key(at("a.nc"));
  ASSERT_TRUE(key);
  EXPECT_EQ(key->pings, 5U);
  EXPECT_EQ(key->first_time, p.pings.front().time);
  EXPECT_EQ(key->last_time, p.pings.back().time);
  p.next_school_id = -4;
  EXPECT_TRUE(write_product(p, at("b.nc")));  // counts as unknown
  EXPECT_EQ(read_product(at("b.nc"))->next_school_id, 3);
}

TEST_F(Product, two_writes_and_a_save_load_save_give_the_same_bytes) {
  ASSERT_TRUE(write_product(sample(), at("a.nc")));
  ASSERT_TRUE(write_product(sample(), at("b.nc")));
  const auto back = read_product(at("a.nc"));
  ASSERT_TRUE(back);
  ASSERT_TRUE(write_product(*back, at("c.nc")));
  EXPECT_EQ(*read_file(at("a.nc")), *read_file(at("b.nc")));
  EXPECT_EQ(*read_file(at("a.nc")), *read_file(at("c.nc")));
}

// Faults are known of every voxel or not at all; a file without them is one of before.
TEST_F(Product, faults_of_members_are_kept) {
  ObservationProduct p = sample();
  for (std::size_t m = 0; m < p.masks.size(); ++m) {
    for (std::size_t v = 0; v < p.masks[m].mask.voxels(); ++v) p.masks[m].fault.push_back(v % (m + 2) == 0);
  }
  ASSERT_TRUE(write_product(p, at("a.nc")));
  const auto back = read_product(at("a.nc"));
  ASSERT_TRUE(back) << to_line(back.error());
  ASSERT_EQ(back->masks.size(), p.masks.size());
  for (std::size_t m = 0; m < p.masks.size(); ++m) EXPECT_EQ(back->masks[m].fault, p.masks[m].fault);
  ASSERT_TRUE(write_product(*back, at("b.nc")));
  EXPECT_EQ(*read_file(at("a.nc")), *read_file(at("b.nc")));

  p.masks[1].fault.clear();
  ASSERT_TRUE(write_product(p, at("unknown.nc")));
  const auto unknown = read_product(at("unknown.nc"));
  ASSERT_TRUE(unknown) << to_line(unknown.error());
  EXPECT_TRUE(unknown->masks[0].fault.empty());

  p.masks[1].fault = {true};
  const auto few = write_product(p, at("few.nc"));
  ASSERT_FALSE(few);
  EXPECT_THAT(to_line(few.error()), HasSubstr("faults and voxels differ"));
}

TEST_F(Product, a_fault_that_is_neither_0_nor_1_is_refused) {
  ObservationProduct p = sample();
  for (SchoolMask& m : p.masks) m.fault.assign(m.mask.voxels(), false);
  ASSERT_TRUE(write_product(p, at("a.nc")));
  int id = -1;
  int mask = -1;
  int fault = -1;
  ASSERT_EQ(nc_open(at("a.nc").c_str(), NC_WRITE, &id), NC_NOERR);
  ASSERT_EQ(nc_inq_grp_ncid(id, "mask", &mask), NC_NOERR);
  ASSERT_EQ(nc_inq_varid(mask, "fault", &fault), NC_NOERR);
  const std::size_t third = 2;
  const unsigned char two = 2;
  ASSERT_EQ(nc_put_var1_uchar(mask, fault, &third, &two), NC_NOERR);
  ASSERT_EQ(nc_close(id), NC_NOERR);
  const auto back = read_product(at("a.nc"));
  ASSERT_FALSE(back);
  EXPECT_THAT(to_line(back.error()), HasSubstr("'fault' of voxel 2 of the mask is 2"));
}

TEST_F(Product, runs_stand_in_the_order_of_channels) {
  ASSERT_TRUE(write_product(sample(), at("a.nc")));
  int id = -1;
  int mask = -1;
  int channel = -1;
  ASSERT_EQ(nc_open(at("a.nc").c_str(), NC_NOWRITE, &id), NC_NOERR);
  ASSERT_EQ(nc_inq_grp_ncid(id, "mask", &mask), NC_NOERR);
  ASSERT_EQ(nc_inq_varid(mask, "channel", &channel), NC_NOERR);
  std::array<int, 17> channels{};
  ASSERT_EQ(nc_get_var_int(mask, channel, channels.data()), NC_NOERR);
  nc_close(id);
  // The first school lies in rows 5 and 6; the example's channel is 11 - row.
  EXPECT_EQ(channels[0], 5);
  EXPECT_EQ(channels[1], 6);
}

TEST_F(Product, without_grid_and_without_schools) {
  ObservationProduct p = example::empty("obs-0002", 3);
  p.grid.reset();
  p.input_files.clear();
  p.title.clear();
  ASSERT_TRUE(write_product(p, at("a.nc")));
  const auto back = read_product(at("a.nc"));
  ASSERT_TRUE(back) << to_line(back.error());
  EXPECT_FALSE(back->grid);
  EXPECT_EQ(back->pings.size(), 3U);
  EXPECT_TRUE(back->schools.empty());
  EXPECT_TRUE(back->masks.empty());
  EXPECT_TRUE(back->input_files.empty());
}

TEST_F(Product, without_pings) {
  ASSERT_TRUE(write_product(example::empty("obs-0003", 0), at("a.nc")));
  const auto back = read_product(at("a.nc"));
  ASSERT_TRUE(back) << to_line(back.error());
  EXPECT_TRUE(back->pings.empty());
}

TEST_F(Product, refuses_other_versions_by_name) {
  ASSERT_TRUE(write_product(sample(), at("a.nc")));
  set_version(at("a.nc"), kProductVersion + 1);
  const auto newer = read_product(at("a.nc"));
  ASSERT_FALSE(newer);
  EXPECT_EQ(newer.error().code, ErrorCode::newer_version);
  EXPECT_THAT(to_line(newer.error()), HasSubstr("product_version 3"));
  set_version(at("a.nc"), kOldestProductVersion - 1);
  const auto older = read_product(at("a.nc"));
  ASSERT_FALSE(older);
  EXPECT_EQ(older.error().code, ErrorCode::older_version);
  EXPECT_THAT(to_line(older.error()), HasSubstr("run again"));
}

TEST_F(Product, refuses_masks_that_do_not_fit) {
  ObservationProduct p = sample();
  p.masks[0].mask.runs[0].first_sample = 55;
  EXPECT_EQ(write_product(p, at("a.nc")).error().code, ErrorCode::bad_parameter);
  p = sample();
  p.masks[0].mask.confidence.pop_back();
  EXPECT_EQ(write_product(p, at("a.nc")).error().code, ErrorCode::bad_parameter);
  p = sample();
  p.masks[0].ping_index = 9;
  EXPECT_EQ(write_product(p, at("a.nc")).error().code, ErrorCode::bad_parameter);
  EXPECT_TRUE(fs::is_empty(folder_)) << "a refused product leaves nothing behind";
}

// Whatever part of the file the disk has no room for: one line, the old file stays, nothing else lies there.
TEST_F(Product, a_full_disk_leaves_what_was_there) {
  ASSERT_TRUE(write_product(sample(), at("a.nc")));
  const std::string before = *read_file(at("a.nc"));
  ObservationProduct other = sample();
  other.title += " again";
  for (std::size_t room = 0; room < before.size(); room += before.size() / 23) {
    const auto written = [&] {
      const FullDisk disk(room);
      return write_product(other, at("a.nc"));
    }();
    ASSERT_FALSE(written) << room;
    EXPECT_EQ(written.error().code, ErrorCode::no_space) << to_line(written.error());
    EXPECT_THAT(to_line(written.error()), testing::StartsWith(at("a.nc").string() + ": cannot write"));
    EXPECT_EQ(to_line(written.error()).find('\n'), std::string::npos);
    EXPECT_EQ(*read_file(at("a.nc")), before) << room;
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1) << room;
  }
  ASSERT_TRUE(write_product(other, at("a.nc")));
  EXPECT_EQ(read_product(at("a.nc"))->title, other.title);
}

TEST_F(Product, damage_gives_an_error) {
  ASSERT_TRUE(write_product(sample(), at("a.nc")));
  const std::string sound = *read_file(at("a.nc"));
  const auto read_bytes = [&](const std::string& bytes) {
    std::ofstream(at("b.nc"), std::ios::binary) << bytes;
    return read_product(at("b.nc"));
  };
  // Cut within the seal, it is a whole file without one.
  for (std::size_t cut = 0; cut + 64 < sound.size(); cut += 997) {
    EXPECT_FALSE(read_bytes(sound.substr(0, cut))) << cut;
  }
  for (std::size_t flip = 0; flip < sound.size(); flip += 499) {
    std::string bytes = sound;
    bytes[flip] = static_cast<char>(bytes[flip] ^ 0x10);
    const auto result = read_bytes(bytes);
    // A flip in the seal's label leaves a whole file without a seal.
    if (flip + 64 < sound.size()) {
      EXPECT_FALSE(result) << flip;
    }
  }
  EXPECT_FALSE(read_bytes("not a product"));
  EXPECT_EQ(read_product(at("none.nc")).error().code, ErrorCode::not_found);
}

TEST_F(Product, damage_without_a_seal_never_breaks_the_program) {
  ASSERT_TRUE(write_product(sample(), at("a.nc")));
  std::string sound = *read_file(at("a.nc"));
  sound.resize(sound.rfind("\nsonar-explorer"));
  const auto read_bytes = [&](const std::string& bytes) {
    std::ofstream(at("b.nc"), std::ios::binary) << bytes;
    return read_product(at("b.nc"));
  };
  EXPECT_TRUE(read_bytes(sound)) << "a file without a seal is read";
  std::uint64_t state = 1;
  for (int n = 0; n < 20; ++n) {
    std::string bytes = sound;
    for (int flips = 0; flips <= n % 4; ++flips) {
      state = state * 6364136223846793005ULL + 1442695040888963407ULL;
      bytes[(state >> 33U) % bytes.size()] = static_cast<char>(state >> 24U);
    }
    static_cast<void>(read_bytes(bytes));
  }
  EXPECT_TRUE(read_product(at("a.nc")));
}

TEST_F(Product, another_netcdf_file_is_refused) {
  int id = -1;
  ASSERT_EQ(nc_create(at("x.nc").c_str(), NC_NETCDF4, &id), NC_NOERR);
  ASSERT_EQ(nc_close(id), NC_NOERR);
  const auto result = read_product(at("x.nc"));
  ASSERT_FALSE(result);
  EXPECT_THAT(to_line(result.error()), HasSubstr("is no product"));
}

TEST_F(Product, two_threads_write_two_hundred_times) {
  const ObservationProduct p = sample();
  const auto write_many = [&](const std::string& name) {
    for (int i = 0; i < 100; ++i) {
      ASSERT_TRUE(write_product(p, at(name)));
      if (i % 10 == 0) {
        ASSERT_TRUE(read_product(at(name)));
      }
    }
  };
  std::thread first(write_many, "one.nc");
  std::thread second(write_many, "two.nc");
  first.join();
  second.join();
  EXPECT_EQ(*read_file(at("one.nc")), *read_file(at("two.nc")));
}

TEST_F(Product, key_is_read_alone) {
  ASSERT_TRUE(write_product(sample(), at("a.nc")));
  const auto key = read_product_key(at("a.nc"));
  ASSERT_TRUE(key);
  EXPECT_EQ(key->input_hash, "abcobs-0001");
  EXPECT_EQ(key->stage_versions, "median 1");
}

}  // namespace
}  // namespace sonar
